// MCAP's own reader and Foxglove's own schemas on an exported file: `node mcap_client.mjs FILE`, where
// `npm install @mcap/core @mcap/nodejs @mcap/support @foxglove/schemas ajv` was run.
import { McapIndexedReader } from "@mcap/core";
import { loadDecompressHandlers } from "@mcap/support";
import { FileHandleReadable } from "@mcap/nodejs";
import foxglove from "@foxglove/schemas/jsonschema.js";
import Ajv from "ajv";
import { open } from "node:fs/promises";

function check(holds, what) {
  if (!holds) throw new Error(what);
}

const reader = await McapIndexedReader.Initialize({
  readable: new FileHandleReadable(await open(process.argv[2])),
  decompressHandlers: await loadDecompressHandlers(),
});
const ajv = new Ajv({ strict: false, discriminator: false });
const official = {};
for (const schema of Object.values(foxglove)) {
  if (schema?.title?.startsWith("foxglove.")) official[schema.title] = ajv.compile(schema);
}
const own = new Map();
for (const schema of reader.schemasById.values()) {
  own.set(schema.id, ajv.compile(JSON.parse(new TextDecoder().decode(schema.data))));
}

const counts = {};
const transforms = new Set();
const entities = [];
const decoder = new TextDecoder();
for await (const message of reader.readMessages()) {
  const channel = reader.channelsById.get(message.channelId);
  const schema = reader.schemasById.get(channel.schemaId);
  const value = JSON.parse(decoder.decode(message.data));
  for (const validate of [own.get(schema.id), official[schema.name]]) {
    check(!validate || validate(value), `${channel.topic}: ${JSON.stringify(validate?.errors)}`);
  }
  check(official[schema.name] || schema.name.startsWith("stampede."), `${schema.name} is no schema of Foxglove's`);
  if (channel.topic === "/tf") for (const one of value.transforms) transforms.add(one.child_frame_id);
  if (channel.topic === "/scene") entities.push(...value.entities);
  if (channel.topic.endsWith("/image") && schema.name === "foxglove.CompressedImage") {
    check(Buffer.from(value.data, "base64").subarray(1, 4).toString() === "PNG", `${channel.topic}: no PNG`);
  }
  counts[channel.topic] = (counts[channel.topic] ?? 0) + 1;
}
for (const topic of ["/tf", "/scene", "/joints", "/skills", "/segments", "/facts", "/action", "/progress"]) {
  check(counts[topic] > 0, `nothing on ${topic}`);
}
for (const entity of entities) check(transforms.has(entity.frame_id), `${entity.id} stands in no frame of /tf`);
check(entities.some((one) => one.cubes.length > 0), "nothing to be seen in /scene");
console.log(`Foxglove's schemas hold for ${process.argv[2]}: ${JSON.stringify(counts)}, ${entities.length} things`);
