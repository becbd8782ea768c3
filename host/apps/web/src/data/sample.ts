// One moment of the arm: its numbers by the names of the API's state, and the facts that go with them. Live and
// recorded states look the same.

export interface Facts {
  state?: string;
  owner?: string;
  is_homed?: boolean;
  not_homed?: { reason: string; text: string } | null;
  is_busy?: boolean;
  at_rest?: boolean;
  step?: { index: number; name: string; device: string; waits?: string | null } | null;
  device?: string;
  device_engaged?: boolean;
  device_reason?: string;
  held?: number[];
  held_at_target?: boolean;
  planar_segments?: number;
  faults?: { number: number; name: string; index?: number; where?: string; detail?: number; text?: string; cause?: number | null }[];
  recovery?: { cables?: number[]; where: string; next: string; recovers: boolean } | null; // a cable is lost
  enabling_waits?: string;
  limits?: string[];
  guidance?: { slowed_by?: string };
  stop?: { by: string; reason: string; tick: number } | null;
  stop_category?: string;
  stopping?: boolean;
  mapping?: { scale: number; rotation_scale: number };
  clearance?: { body: string; confidence: string; camera: string; level: string } | null;
  verdict?: { released?: boolean; code?: number; name?: string; text?: string; remedy?: string; margin?: string };
  buses?: { name: string; state: string; lost?: boolean; refused?: number; worst_load?: number }[];
  drives?: { node: number; state: string; serial?: number | null }[];
  retract?: { phase: string; points?: number; reason?: string };
  retracted?: boolean;
  ik?: { outcome: string };
  shape?: { settled: boolean; searching: boolean };
  contact?: { segment: number };
  friction?: { not_as_declared?: boolean; declared_mu?: number; planned_mu?: number };
  path?: { hash?: string } | null;
  mission_control?: { number: number; command: string; by: string } | null;
  operator_says?: { what: string; tick: number } | null;
  insert?: Push;
  adapter?: { captured: boolean; latch: string; lock: string };
  payload?: { mass_kg: number }; // what the arm was told that it carries
  servo?: Servo;
  tool?: { command: string; phase: string };
}

export interface Servo {
  phase: string;
  target: string;
  reason: string;
}

// Of a serial arm: the push under way, or how the last one went, and the sensor at the wrist.
export interface Push {
  number: number; // 0: none was asked for
  phase: string;
  end: string;
  law: string;
  touched: boolean;
  wrist: string;
}

export interface Sample {
  tick: number;
  time_s: number;
  numbers: ReadonlyMap<string, Float32Array>; // NaN: not there; overwritten by the next sample
  facts: Facts;
}

const NONE = new Float32Array(0);

// Values of a field; empty when this arm has no such field, or there is no sample yet.
export function values(sample: Sample | null, name: string): Float32Array {
  return sample?.numbers.get(name) ?? NONE;
}

// The only value of a field; NaN when it is not there.
export function value(sample: Sample | null, name: string): number {
  return sample?.numbers.get(name)?.[0] ?? NaN;
}

// Is there a number in it?
export function isKnown(numbers: ArrayLike<number>): boolean {
  return numbers.length > 0 && Number.isFinite(numbers[0]);
}

export interface LianaEvent {
  sequence: number;
  tick: number;
  kind: string;
  number: number;
  subject: string;
  values: Record<string, number>;
  text: string;
}
