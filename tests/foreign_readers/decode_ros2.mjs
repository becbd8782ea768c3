// Decodes every message of a `liana log export --ros2` by its own schema, with the packages that Foxglove uses.
// Usage: node decode_ros2.mjs FILE; prints JSON: profile, and per topic type, encodings, quality of service, number of
// messages, first and last message and their times in ns. Ends with 1 at the first thing that is not as it should be.
import { parse } from '@foxglove/rosmsg';
import { MessageReader } from '@foxglove/rosmsg2-serialization';
import { text, withReader } from './readable.mjs';

// Numbers and texts as JSON has them: typed arrays as lists, NaN as null.
const plain = (_, value) => (ArrayBuffer.isView(value) ? Array.from(value) : typeof value === 'bigint' ? Number(value) : value);

const found = await withReader(process.argv[2], async (reader) => {
  const topics = {};
  const readers = {};
  let newest = 0n;
  for (const { id, topic, messageEncoding, schemaId, metadata } of reader.channelsById.values()) {
    const schema = reader.schemasById.get(schemaId);
    readers[id] = new MessageReader(parse(text.decode(schema.data), { ros2: true }));
    topics[topic] = {
      type: schema.name, schema: schema.encoding, encoding: messageEncoding,
      qos: metadata.get('offered_qos_profiles'), messages: 0,
    };
  }
  for await (const message of reader.readMessages()) {
    const topic = topics[reader.channelsById.get(message.channelId).topic];
    const value = readers[message.channelId].readMessage(message.data);
    if (message.logTime < newest) throw new Error(`${message.logTime}: comes after ${newest}`);
    newest = message.logTime;
    const entry = { time_ns: String(message.logTime), value };
    topic.first ??= entry;
    topic.last = entry;
    topic.messages += 1;
  }
  return { profile: reader.header.profile, metadata: reader.metadataIndexes.map((each) => each.name), topics };
});
console.log(JSON.stringify(found, plain));
