// The recorded ticks of a run once more, in this browser: the controller's own code, as WebAssembly, gets the recorded
// inputs, and what it answers is compared with what was recorded, by checksum.
import type { ReplayHead } from '../data/run';
import { inflated } from '../data/telemetry';
import { startedProgram } from '../data/wasm';

export interface ReplayState {
  done: number; // ticks so far
  differing: number;
  firstDiffering: number | null; // counted from 0
}

interface Core {
  memory: WebAssembly.Memory;
  room(bytes: number): number;
  start(isSerial: number): void;
  tick(): number;
  outputs(): number;
}

const CRC_TABLE = Uint32Array.from({ length: 256 }, (_, byte) => {
  let value = byte;
  for (let bit = 0; bit < 8; ++bit) value = value & 1 ? 0xedb88320 ^ (value >>> 1) : value >>> 1;
  return value;
});

// CRC-32 as in IEEE 802.3.
export function crc32(bytes: Uint8Array): number {
  let value = 0xffffffff;
  for (const byte of bytes) value = CRC_TABLE[(value ^ byte) & 0xff] ^ (value >>> 8);
  return ~value >>> 0;
}

export class Replay {
  readonly state: ReplayState = { done: 0, differing: 0, firstDiffering: null };
  private readonly view: DataView;
  private readonly inputs: Uint8Array; // of all ticks, one after the other
  private at = 0; // where those of the next tick begin

  // `bytes`: start message, sizes, checksums, inputs. Throws when they are not as many as the head says.
  private constructor(private readonly core: Core, private readonly head: ReplayHead, bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const planes = bytes.subarray(Math.min(bytes.length, head.start_bytes + 6 * head.ticks));
    let expected = 0;
    for (let tick = 0; tick < head.ticks && expected <= planes.length; ++tick) expected += this.size(tick);
    if (expected !== planes.length) throw new Error(`the ticks have ${planes.length} bytes of inputs, not ${expected}: the file is damaged`);
    this.inputs = this.fromPlanes(planes);
    this.put(bytes.subarray(0, head.start_bytes));
    core.start(head.is_serial ? 1 : 0);
  }

  static async of(program: Uint8Array, head: ReplayHead, bytes: Uint8Array): Promise<Replay> {
    return new Replay((await startedProgram(program)) as unknown as Core, head, bytes);
  }

  // Replays up to `count` more ticks; false when all are done.
  run(count: number): boolean {
    const { state } = this;
    for (const end = Math.min(this.head.ticks, state.done + count); state.done < end; ++state.done) {
      if (this.isSame(state.done)) continue;
      state.firstDiffering ??= state.done;
      ++state.differing;
    }
    return state.done < this.head.ticks;
  }

  private isSame(tick: number): boolean {
    const size = this.size(tick);
    this.put(this.inputs.subarray(this.at, this.at + size));
    this.at += size;
    const length = this.core.tick();
    const outputs = new Uint8Array(this.core.memory.buffer, this.core.outputs(), length);
    return crc32(outputs) === this.view.getUint32(this.head.start_bytes + 2 * this.head.ticks + 4 * tick, true);
  }

  // `planes`: byte i of all ticks that have one, for each i, as its difference from the one before.
  private fromPlanes(planes: Uint8Array): Uint8Array {
    const inputs = new Uint8Array(planes.length);
    for (let i = 0, next = 0; next < planes.length; ++i) {
      let value = 0;
      for (let tick = 0, row = 0; tick < this.head.ticks; row += this.size(tick), ++tick) {
        if (i < this.size(tick)) inputs[row + i] = value = (value + planes[next++]) & 0xff;
      }
    }
    return inputs;
  }

  private size(tick: number): number {
    return this.view.getUint16(this.head.start_bytes + 2 * tick, true);
  }

  private put(bytes: ArrayLike<number>): void {
    const place = this.core.room(bytes.length);
    new Uint8Array(this.core.memory.buffer, place, bytes.length).set(bytes);
  }
}

// The replay in this page; null when it holds none.
export async function replayIn(page: Document, head: ReplayHead | null | undefined): Promise<Replay | null> {
  const core = page.getElementById('liana-core')?.textContent;
  const ticks = page.getElementById('liana-ticks')?.textContent;
  if (!head || !core || !ticks) return null;
  return Replay.of(await inflated(core), head, await inflated(ticks));
}
