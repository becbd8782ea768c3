// An MCAP file opened with the reader that Foxglove and others use.
import { open } from 'node:fs/promises';
import { McapIndexedReader } from '@mcap/core';
import { decompress } from 'fzstd';

class Readable {
  constructor(handle) { this.handle = handle; }
  async size() { return BigInt((await this.handle.stat()).size); }
  async read(offset, length) {
    const { buffer } = await this.handle.read(Buffer.alloc(Number(length)), 0, Number(length), Number(offset));
    return new Uint8Array(buffer);
  }
}

export const text = new TextDecoder('utf-8', { fatal: true });

// Calls `use` with the reader, and closes the file.
export async function withReader(file, use) {
  const handle = await open(file);
  const reader = await McapIndexedReader.Initialize({
    readable: new Readable(handle),
    decompressHandlers: { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) },
  });
  const result = await use(reader);
  await handle.close();
  return result;
}
