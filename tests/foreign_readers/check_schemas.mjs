// Holds every message of a `liana log export --mcap` against the JSON schema that Foxglove publishes under the name of
// its schema. Usage: node check_schemas.mjs FILE; prints JSON: per topic schema, number of messages, frames it knows.
// Ends with 1 at the first thing that is not as it should be.
import published from '@foxglove/schemas/dist/jsonschema.js';
import { text, withReader } from './readable.mjs';

const isOf = {
  object: (value) => typeof value === 'object' && value !== null && !Array.isArray(value),
  array: Array.isArray,
  string: (value) => typeof value === 'string',
  boolean: (value) => typeof value === 'boolean',
  number: (value) => typeof value === 'number',
  integer: Number.isInteger,
};

// Members that the schema does not name are a mistake, too: somebody misspelt them.
function check(value, schema, where) {
  if (schema.oneOf !== undefined) {
    if (!schema.oneOf.some((each) => each.const === value)) throw new Error(`${where}: ${value} is none of its values`);
    return;
  }
  if (!isOf[schema.type](value)) throw new Error(`${where}: is no ${schema.type}: ${JSON.stringify(value)}`);
  if (schema.type === 'array') value.forEach((each, i) => check(each, schema.items, `${where}[${i}]`));
  if (schema.type !== 'object') return;
  for (const name of schema.required ?? []) if (!(name in value)) throw new Error(`${where}: lacks ${name}`);
  for (const [name, each] of Object.entries(value)) {
    const known = schema.properties?.[name];
    if (known === undefined) throw new Error(`${where}: ${name} is not known there`);
    check(each, known, `${where}.${name}`);
  }
}

const topics = await withReader(process.argv[2], async (reader) => {
  const found = {};
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    const { name } = reader.schemasById.get(channel.schemaId);
    const topic = (found[channel.topic] ??= { schema: name, messages: 0 });
    topic.messages += 1;
    const value = JSON.parse(text.decode(message.data));
    if (name.startsWith('foxglove.')) check(value, published[name.slice('foxglove.'.length)], channel.topic);
    if (channel.topic === '/tf') topic.frames = value.transforms.map((each) => each.child_frame_id);
    if (channel.topic === '/scene') topic.frames = value.entities.map((each) => each.frame_id);
  }
  return found;
});
console.log(JSON.stringify(topics));
