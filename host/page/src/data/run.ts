// A recorded run: what the page of a run is made of.
import type { Robot, Scene } from '../model/robot';
import type { Facts, LianaEvent, Sample } from './sample';
import { inflated, telemetry_of, type Telemetry, type TelemetryHead } from './telemetry';

export interface Judged {
  passed: boolean;
  share?: number;
}

export interface Command {
  command: number;
  tick: number;
  owner: string;
  kind: string;
  execution: Judged | null;
  simulation: Judged | null;
  refusal: { code: number; name: string; text: string; remedy: string } | null;
  margins: Record<string, number> | null;
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

export interface RunHead {
  format: number;
  title: string;
  made_by: string;
  robot: Robot;
  scene: Scene;
  report: Report | null;
  period_s: number;
  steps: { index: number; name: string; device: string; tick: number }[];
  events: LianaEvent[];
  commands: Command[];
  facts: { tick: number; state: Facts }[];
  telemetry: TelemetryHead;
}

const kFormat = 1;

// The last of `list` (ascending ticks) at or before `tick`; -1: none.
export function last_before(list: readonly { tick: number }[], tick: number): number {
  let low = 0;
  let high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle].tick <= tick) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

// The first facts are whole, later ones tell only what is other than before.
function whole_facts(facts: RunHead['facts']): RunHead['facts'] {
  let before: Facts = {};
  return facts.map(({ tick, state }) => ({ tick, state: (before = { ...before, ...state }) }));
}

export class Run {
  readonly telemetry: Telemetry;
  private readonly facts: RunHead['facts'];
  private readonly sample: Sample & { numbers: Map<string, Float32Array> };

  // Throws when the head is of another format or does not fit the telemetry.
  constructor(readonly head: RunHead, planes: Uint8Array) {
    if (head.format !== kFormat) throw new Error(`format = ${head.format}: this page reads ${kFormat}`);
    this.telemetry = telemetry_of(head.telemetry, planes);
    this.facts = whole_facts(head.facts);
    const numbers = new Map<string, Float32Array>();
    for (const [name, columns] of this.telemetry.columns) numbers.set(name, new Float32Array(columns.length));
    this.sample = { tick: 0, time_s: 0, numbers, facts: {} };
  }

  get rows(): number {
    return this.telemetry.rows;
  }

  time_s(row: number): number {
    return this.tick(row) * this.head.period_s;
  }

  tick(row: number): number {
    return this.telemetry.first_tick + row * this.telemetry.ticks_per_row;
  }

  // The row nearest to this arm time, within the run.
  row_at(time_s: number): number {
    const row = Math.round((time_s / this.head.period_s - this.telemetry.first_tick) / this.telemetry.ticks_per_row);
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
    const facts = last_before(this.facts, sample.tick);
    sample.facts = facts < 0 ? {} : this.facts[facts].state;
    return sample;
  }
}

// The run in this page; null when there is none, which is the console.
export async function run_in(page: Document): Promise<Run | null> {
  const head = page.getElementById('liana-run')?.textContent;
  const packed = page.getElementById('liana-telemetry')?.textContent;
  if (!head || !packed) return null;
  return new Run(JSON.parse(head) as RunHead, await inflated(packed));
}
