// The last minute of records, for strips and to look back.
import type { Layout } from '../data/record';
import { isKnown } from '../data/sample';

const ROWS = 3000; // a minute at 50 Hz

export class History {
  readonly numbers = new Map<string, { at: number; count: number }>(); // where a field is in a row
  readonly known = new Set<string>(); // fields that ever had a number
  private readonly width: number;
  private readonly cells: Float32Array;
  private readonly ticks = new Float64Array(ROWS);
  private readonly times_s = new Float64Array(ROWS);
  private written = 0;

  constructor(layout: Layout) {
    let at = 0;
    for (const field of layout.fields) {
      this.numbers.set(field.name, { at, count: field.count });
      at += field.count;
    }
    this.width = at;
    this.cells = new Float32Array(ROWS * at);
  }

  get rows(): number {
    return Math.min(ROWS, this.written);
  }

  add(tick: number, time_s: number, numbers: ReadonlyMap<string, Float32Array>): void {
    const row = this.written % ROWS;
    this.ticks[row] = tick;
    this.times_s[row] = time_s;
    for (const [name, place] of this.numbers) {
      const values = numbers.get(name)!;
      this.cells.set(values, row * this.width + place.at);
      if (isKnown(values)) this.known.add(name);
    }
    ++this.written;
  }

  // Of row `i`, 0 the oldest.
  time_s(i: number): number {
    return this.times_s[this.place(i)];
  }

  tick(i: number): number {
    return this.ticks[this.place(i)];
  }

  value(i: number, field: string, index: number): number {
    const place = this.numbers.get(field);
    return place && index < place.count ? this.cells[this.place(i) * this.width + place.at + index] : NaN;
  }

  // Copies row `i` into `numbers`.
  read(i: number, numbers: ReadonlyMap<string, Float32Array>): void {
    for (const [name, place] of this.numbers) {
      const at = this.place(i) * this.width + place.at;
      numbers.get(name)?.set(this.cells.subarray(at, at + place.count));
    }
  }

  private place(i: number): number {
    return (Math.max(0, this.written - ROWS) + i) % ROWS;
  }
}
