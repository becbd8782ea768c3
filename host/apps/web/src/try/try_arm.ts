// The arm of this page: the controller and both verification ends, as WebAssembly (../../core/try.hpp).
import type { Facts, Sample } from '../data/sample';
import { startedProgram } from '../data/wasm';
import type { Pose } from '../model/vector';

interface Program {
  memory: WebAssembly.Memory;
  room(bytes: number): number;
  begin(): void;
  interval(request: number, wanted: number, x: number, y: number, z: number, qw: number, qx: number, qy: number, qz: number): void;
  state(): number;
  hash(): number;
  place(): number;
}

// What an operator asks of the state machine (firmware_like/command/request.hpp).
export const REQUESTS = { none: 0, enable: 1, disable: 2, clear: 3, stop: 4 } as const;
export type Request = keyof typeof REQUESTS;

export const INTERVAL_S = 0.02; // T_c of buses/embedded

interface StateFacts extends Facts {
  verdict: { code: number; text: string };
  commands: { released: number; refused: number }; // so far
}

export interface TrySample extends Sample {
  facts: StateFacts;
}

const NOWHERE = [0, 0, 0, 1, 0, 0, 0] as const;

// Numbers and lists of numbers, by their names with dots between them.
function collect(value: unknown, name: string, into: Map<string, Float32Array>): void {
  if (typeof value === 'number') into.set(name, Float32Array.of(value));
  else if (Array.isArray(value)) into.set(name, Float32Array.from(value.filter((each) => typeof each === 'number')));
  else if (value && typeof value === 'object') for (const [key, member] of Object.entries(value)) collect(member, name ? `${name}.${key}` : key, into);
}

export class TryArm {
  private constructor(private readonly program: Program) {}

  // `tables`: buses, robot and scene as canonical JSON, a line each.
  static async of(wasm: Uint8Array, tables: string): Promise<TryArm> {
    const program = (await startedProgram(wasm)) as unknown as Program;
    const bytes = new TextEncoder().encode(tables);
    const place = program.room(bytes.length);
    new Uint8Array(program.memory.buffer, place, bytes.length).set(bytes);
    program.begin();
    return new TryArm(program);
  }

  // One command interval of 20 ms; the tip goes towards `wanted`, or comes to rest.
  interval(request: Request, wanted: Pose | null): void {
    const [x, y, z, qw, qx, qy, qz] = wanted ?? NOWHERE;
    this.program.interval(REQUESTS[request], wanted ? 1 : 0, x, y, z, qw, qx, qy, qz);
  }

  sample(): TrySample {
    const facts = JSON.parse(this.text(this.program.state()));
    const numbers = new Map<string, Float32Array>();
    collect(facts, '', numbers);
    return { tick: facts.tick, time_s: facts.time_s, numbers, facts };
  }

  // Of everything that is remembered: the same inputs give the same one on every machine.
  hash(): string {
    return this.text(this.program.hash());
  }

  private text(bytes: number): string {
    return new TextDecoder().decode(new Uint8Array(this.program.memory.buffer, this.program.place(), bytes));
  }
}
