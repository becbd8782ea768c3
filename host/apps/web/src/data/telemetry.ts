// The numbers of a recorded run: int16 differences in byte planes, deflated, base64
// (docs/getting-started/tour-of-the-console.md).

export interface TelemetryHead {
  rows: number;
  ticks: { first: number; every: number };
  columns: { name: string; index: number; unit: string; scale: number }[];
}

export interface Telemetry {
  rows: number;
  firstTick: number;
  ticksPerRow: number;
  columns: Map<string, Float32Array[]>; // by field and index; NaN: not there
}

const NOT_THERE = -32768;

export async function inflated(base64: string): Promise<Uint8Array> {
  const packed = Uint8Array.from(atob(base64.trim()), (c) => c.charCodeAt(0));
  const plain = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
  return new Uint8Array(await new Response(plain).arrayBuffer());
}

// Values of one column, which begins at byte `at` of the planes.
function column(planes: Uint8Array, at: number, rows: number, scale: number): Float32Array {
  const values = new Float32Array(rows);
  let whole = 0;
  for (let i = 0; i < rows; ++i) {
    whole = ((whole + (planes[at + i] | (planes[at + rows + i] << 8))) << 16) >> 16;
    values[i] = whole === NOT_THERE ? NaN : whole * scale;
  }
  return values;
}

// Throws when there are not as many bytes as the head says.
export function telemetryOf(head: TelemetryHead, planes: Uint8Array): Telemetry {
  const expected = 2 * head.rows * head.columns.length;
  if (planes.length !== expected)
    throw new Error(`telemetry has ${planes.length} bytes, ${expected} belong to its rows and columns: the file is damaged`);
  const columns = new Map<string, Float32Array[]>();
  head.columns.forEach((c, k) => {
    const ofField = columns.get(c.name) ?? [];
    ofField[c.index] = column(planes, 2 * head.rows * k, head.rows, c.scale);
    columns.set(c.name, ofField);
  });
  return { rows: head.rows, firstTick: head.ticks.first, ticksPerRow: head.ticks.every, columns };
}
