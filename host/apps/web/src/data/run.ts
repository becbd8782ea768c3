// A recorded run: what `liana view` wrote into its page.
import { chainOf, type ArmChain } from '../model/arm_chain';
import type { Robot, Scene } from '../model/robot';
import type { Facts, LianaEvent, Sample } from './sample';
import { inflated, telemetryOf, type Telemetry, type TelemetryHead } from './telemetry';
import { withDerivedEvents } from './derived_events';

export interface Judged {
  code: number; // of the refusal; 0: passed
  share: number; // of the limit that the motion comes nearest to
  margins: Record<string, number | null>;
  text: string;
}

export interface Command {
  command: number;
  tick: number;
  owner: string;
  kind: string;
  execution: Judged | null;
  simulation: Judged | null;
  refusal: { code?: number; name?: string; text: string; remedy?: string } | null; // without code: of a request
}

export interface Report {
  mission?: string;
  outcome?: string;
  reason?: string;
  duration_s?: number;
  seed?: number;
  steps?: { name: string; device: string; duration_s: number; outcome: string; reason: string }[];
  faults?: { number: number; name: string; text?: string; remedy?: string }[];
  criteria?: { name: string; value: number; limit: number; met: boolean }[];
  [name: string]: unknown;
}

export interface ReplayHead {
  is_serial: boolean;
  recorded: number; // ticks of the run
  ticks: number; // of these the page holds the first
  start_bytes: number;
}

export interface RunHead {
  format: number;
  title: string;
  robot: Robot;
  scene: Scene;
  report: Report | null;
  period_s: number;
  steps: { index: number; name: string; tick: number }[];
  events: LianaEvent[];
  commands: Command[];
  facts: { tick: number; state: Facts }[]; // the first whole, of later ones what is another than before
  replay?: ReplayHead | null;
  telemetry: TelemetryHead;
}

const FORMAT = 1;

// The first of the indices from 0 for which `holds`, as it then does for all behind; `count`: none.
export function firstWhere(count: number, holds: (i: number) => boolean): number {
  let low = 0;
  let high = count;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (holds(middle)) high = middle;
    else low = middle + 1;
  }
  return low;
}

// The last of `list` (ascending ticks) at or before `tick`; -1: none.
export function lastBefore(list: readonly { tick: number }[], tick: number): number {
  return firstWhere(list.length, (i) => list[i].tick > tick) - 1;
}

// All facts at each change.
function wholeFacts(changes: RunHead['facts']): RunHead['facts'] {
  let state: Facts = {};
  return changes.map((change) => ({ tick: change.tick, state: (state = { ...state, ...change.state }) }));
}

export class Run {
  readonly telemetry: Telemetry;
  readonly events: LianaEvent[]; // in the order of their ticks
  private readonly facts: RunHead['facts'];
  private readonly chain: ArmChain;
  private readonly sample: Sample & { numbers: Map<string, Float32Array> };

  // Throws when the head is of another format or does not fit the telemetry.
  constructor(readonly head: RunHead, planes: Uint8Array) {
    if (head.format !== FORMAT) throw new Error(`format = ${head.format}: this page reads ${FORMAT}`);
    this.telemetry = telemetryOf(head.telemetry, planes);
    this.facts = wholeFacts(head.facts);
    this.events = withDerivedEvents(head.events, this.facts);
    const numbers = new Map<string, Float32Array>();
    for (const [name, columns] of this.telemetry.columns) numbers.set(name, new Float32Array(columns.length));
    this.chain = chainOf(head.robot);
    if (!numbers.has('measured_cp')) numbers.set('measured_cp', new Float32Array(7).fill(NaN)); // from the angles, below
    this.sample = { tick: 0, time_s: 0, numbers, facts: {} };
  }

  get rows(): number {
    return this.telemetry.rows;
  }

  time_s(row: number): number {
    return this.tick(row) * this.head.period_s;
  }

  tick(row: number): number {
    return this.telemetry.firstTick + row * this.telemetry.ticksPerRow;
  }

  // The row nearest to this arm time, within the run.
  rowAt(time_s: number): number {
    const row = Math.round((time_s / this.head.period_s - this.telemetry.firstTick) / this.telemetry.ticksPerRow);
    return Math.max(0, Math.min(this.rows - 1, row));
  }

  // The moment of a row; the same object each time.
  at(row: number): Sample {
    const { sample } = this;
    sample.tick = this.tick(row);
    sample.time_s = this.time_s(row);
    for (const [name, columns] of this.telemetry.columns) {
      const values = sample.numbers.get(name)!;
      for (let i = 0; i < columns.length; ++i) values[i] = columns[i]?.[row] ?? NaN;
    }
    this.placeTip(sample.numbers);
    const facts = lastBefore(this.facts, sample.tick);
    sample.facts = facts < 0 ? {} : this.facts[facts].state;
    return sample;
  }

  // Where the tip is, which the page does not hold: the angles say it. Its attitude is left out.
  private placeTip(numbers: Map<string, Float32Array>): void {
    const angles_deg = numbers.get('measured_js_deg');
    if (this.telemetry.columns.has('measured_cp') || !angles_deg) return;
    this.chain.set(angles_deg);
    const known = Number.isFinite(angles_deg[0]);
    for (let r = 0; r < 3; ++r) numbers.get('measured_cp')![r] = known ? this.chain.tip[12 + r] : NaN;
  }
}

// The run in this page; null when there is none, which is the console.
export async function runIn(page: Document): Promise<Run | null> {
  const head = page.getElementById('liana-run')?.textContent;
  const packed = page.getElementById('liana-telemetry')?.textContent;
  if (!head || !packed) return null;
  return new Run(JSON.parse(head) as RunHead, await inflated(packed));
}
