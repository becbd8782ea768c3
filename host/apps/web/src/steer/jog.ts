// Where a jogged tip is asked to be: a goal that runs ahead of the commanded tip, never farther than it comes soon.
import type { TipLimits } from '../model/robot';
import { distance, moved, turnBetween, type Pose } from '../model/vector';
import type { Direction } from './keyboard';

export interface JogSpeed {
  tip_m_s: number;
  turn_rad_s: number;
  inTip: boolean; // along the tip's own axes; else the base's
}

// lianad refuses goals farther than 0.5 s of the robot's tip speed; this leaves room for what is under way.
export const LEAD_S = 0.3;
const FARTHEST_STEP_S = 0.1; // a page that stood still does not jump

// The next goal of the stream: `goal` (null: begin at `commanded`) moved on by `passed_s` of the wanted velocity. It
// waits where it would lead by more than 0.3 s of the robot's limits (or is turned on its spot).
export function nextGoal(
  goal: Pose | null,
  commanded: ArrayLike<number>,
  direction: Direction,
  speed: JogSpeed,
  passed_s: number,
  limits: TipLimits,
): Pose {
  const from = goal ?? Array.from(commanded);
  const step_s = Math.min(passed_s, FARTHEST_STEP_S);
  const way = direction.slice(0, 3).map((d) => d * speed.tip_m_s * step_s);
  const turn = direction.slice(3).map((d) => d * speed.turn_rad_s * step_s);
  const next = moved(from, way, turn, speed.inTip);
  const tooFar = distance(next, commanded) > LEAD_S * limits.tip_speed_m_s && distance(next, commanded) > distance(from, commanded);
  const limit_rad = (LEAD_S * limits.tip_rate_deg_s * Math.PI) / 180;
  const tooTurned = turnBetween(next, commanded) > limit_rad && turnBetween(next, commanded) > turnBetween(from, commanded);
  return tooFar || tooTurned ? from : next;
}

// The direction of several at once, each -1 to 1.
export function sumOf(directions: Iterable<Direction>): Direction {
  const sum = [0, 0, 0, 0, 0, 0];
  for (const direction of directions) direction.forEach((d, i) => (sum[i] = Math.max(-1, Math.min(1, sum[i] + d))));
  return sum as unknown as Direction;
}

// From `goal` towards the place under the mouse, at most as far as the tip comes in `passed_s`, and never with too much
// lead before the commanded tip.
export function towards(
  goal: Pose | null,
  commanded: ArrayLike<number>,
  place_m: ArrayLike<number>,
  speed_m_s: number,
  passed_s: number,
  limits: TipLimits,
): Pose {
  const from = goal ?? Array.from(commanded);
  const way_m = distance(place_m, from);
  if (way_m < 1e-6) return from;
  const share = Math.min(1, (speed_m_s * Math.min(passed_s, FARTHEST_STEP_S)) / way_m);
  const next = [...from];
  for (let r = 0; r < 3; ++r) next[r] += (place_m[r] - from[r]) * share;
  const lead_m = distance(next, commanded);
  return lead_m > LEAD_S * limits.tip_speed_m_s && lead_m > distance(from, commanded) ? from : next;
}
