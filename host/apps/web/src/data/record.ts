// State records: header and values of fixed size (docs/reference/console-protocol.md), read without allocation.

export interface Layout {
  version: number;
  bytes: number;
  fields: { name: string; unit: string; offset: number; count: number }[];
}

export const HEADER_BYTES = 24;
const LAYOUT_VERSION = 1;

// Reads records of one layout; its numbers are views that the next record overwrites.
export class RecordReader {
  sequence = 0;
  facts = 0; // number of the facts message that belongs to it
  tick = 0;
  time_s = 0;
  readonly numbers = new Map<string, Float32Array>();
  private readonly bytes: Uint8Array;
  private readonly head: DataView;

  // Throws when the layout is of another version or its fields are not within the record.
  constructor(readonly layout: Layout) {
    if (layout.version !== LAYOUT_VERSION)
      throw new Error(`layout.version = ${layout.version}: this page reads ${LAYOUT_VERSION}: reload it from the gateway`);
    if (!(layout.bytes >= HEADER_BYTES && layout.bytes % 4 === 0))
      throw new Error(`layout.bytes = ${layout.bytes}: at least ${HEADER_BYTES}, a multiple of 4`);
    const buffer = new ArrayBuffer(layout.bytes);
    this.bytes = new Uint8Array(buffer);
    this.head = new DataView(buffer);
    for (const field of layout.fields) {
      const end = field.offset + 4 * field.count;
      if (field.offset < HEADER_BYTES || field.offset % 4 !== 0 || end > layout.bytes)
        throw new Error(`layout field ${field.name} at ${field.offset}: not within ${layout.bytes} bytes`);
      this.numbers.set(field.name, new Float32Array(buffer, field.offset, field.count));
    }
  }

  // False, and nothing changed, when the record is not of the layout's size.
  read(record: ArrayBuffer): boolean {
    if (record.byteLength !== this.layout.bytes) return false;
    this.bytes.set(new Uint8Array(record));
    this.sequence = this.head.getUint32(0, true);
    this.facts = this.head.getUint32(4, true);
    this.tick = this.head.getFloat64(8, true);
    this.time_s = this.head.getFloat64(16, true);
    return true;
  }
}
