// What the two handles say, as samples of docs/reference/api.md: poses in the device frame, which is parallel to the
// arm's base.
import { multiply, normalised, rotated, type Quaternion } from '../model/vector';

export type Side = 'right' | 'left';

// A handle in one frame of the headset, in the headset's own frame (y up).
export interface Handle {
  position_m: readonly [number, number, number];
  attitude: Quaternion;
  isTracked: boolean;
  deadman: number; // 0 to 1: trigger or squeeze, whichever is held more
}

export interface HandleSample {
  valid: boolean;
  trigger: number;
  pose: number[];
  stale?: true; // the headset was re-centred in this grip
}

export interface VrSample {
  t_us: number;
  right: HandleSample;
  left: HandleSample;
}

// From the headset's frame (x right, y up, z back) to the base's (x forward, y left, z up) for a person who looks along x.
export const UPRIGHT: Quaternion = [0.5, 0.5, -0.5, -0.5];

// The same when the person has turned the world by `turn_rad` about the vertical.
export function deviceFromHeadset(turn_rad: number): Quaternion {
  return normalised(multiply([Math.cos(turn_rad / 2), 0, 0, Math.sin(turn_rad / 2)], UPRIGHT));
}

const GRIPPED = 0.5; // of a trigger, as the gateway has it

const ORIGIN = [0, 0, 0, 1, 0, 0, 0];

export class HandleSamples {
  private readonly last: Record<Side, number[]> = { right: ORIGIN, left: ORIGIN };
  private last_us = -1;
  private readonly requireReengage = new Set<Side>();

  // The headset was re-centred: poses from now on are not those of the grip. Each handle steers again after it was let go.
  reset(): void {
    this.requireReengage.add('right').add('left');
  }

  // A person holds a trigger that does not count any more.
  get waits(): boolean {
    return this.requireReengage.size > 0;
  }

  // One sample; a handle that is null, or is not tracked, repeats its last pose and is not valid. Times strictly increase.
  next(now_ms: number, right: Handle | null, left: Handle | null, device: Quaternion): VrSample {
    this.last_us = Math.max(this.last_us + 1, Math.round(1000 * now_ms));
    return { t_us: this.last_us, right: this.one('right', right, device), left: this.one('left', left, device) };
  }

  private one(side: Side, handle: Handle | null, device: Quaternion): HandleSample {
    const valid = !!handle && handle.isTracked;
    if (valid) this.last[side] = [...rotated(device, handle.position_m), ...normalised(multiply(device, handle.attitude))];
    const trigger = Math.max(0, Math.min(1, handle?.deadman ?? 0));
    if (trigger < GRIPPED) this.requireReengage.delete(side);
    if (this.requireReengage.has(side)) return { valid, trigger: 0, pose: this.last[side], stale: true };
    return { valid, trigger, pose: this.last[side] };
  }
}
