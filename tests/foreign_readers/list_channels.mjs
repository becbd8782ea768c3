// Reads MCAP files with the reader that Foxglove and others use: per file and channel its encodings and number of
// messages, and of JSON channels every message parsed and held against the `required` of the channel's schema.
// Usage: node list_channels.mjs FILE...; prints JSON, and ends with 1 at the first thing that is not as it should be.
import { text, withReader } from './readable.mjs';

function checkJson(topic, required, data) {
  const message = JSON.parse(text.decode(data));
  for (const key of required) {
    if (!(key in message)) throw new Error(`${topic}: a message lacks ${key}, which its schema requires`);
  }
}

async function channelsOf(reader) {
  const channels = {};
  const required = {};
  for (const { id, topic, messageEncoding, schemaId } of reader.channelsById.values()) {
    const schema = reader.schemasById.get(schemaId);
    channels[topic] = { encoding: messageEncoding, schema: schema.encoding, messages: 0 };
    if (messageEncoding === 'json') required[id] = JSON.parse(text.decode(schema.data)).required;
  }
  for await (const message of reader.readMessages()) {
    const { topic } = reader.channelsById.get(message.channelId);
    channels[topic].messages += 1;
    if (required[message.channelId]) checkJson(topic, required[message.channelId], message.data);
  }
  return { indexed: reader.chunkIndexes.length > 0, channels };
}

const found = {};
for (const file of process.argv.slice(2)) found[file.split('/').pop()] = await withReader(file, channelsOf);
console.log(JSON.stringify(found));
