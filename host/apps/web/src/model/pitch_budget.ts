// How far the pitch of segments inside the slit may be off before the arm uses up the gap (requirement: 20 mm).

export interface Budget {
  allowed_deg: number;
  used_deg: number; // the largest pitch error of the segments that are inside
  share: number; // used of allowed
  segments: number[]; // numbers of those segments, from 1
}

// By the number of segments inside: an error of all their joints moves the end of one by 3.6 m/rad, of two by 13.6 m/rad.
const ALLOWED_DEG = [0, 0.32, 0.084];

// `held` numbers angles from 1, as the state has them; only pitch angles (odd) that are held count. Null: none is.
export function pitchBudget(
  held: readonly number[],
  measured_deg: ArrayLike<number>,
  setpoint_deg: ArrayLike<number>,
): Budget | null {
  const pitches = held.filter((theta) => theta % 2 === 1);
  if (pitches.length === 0) return null;
  const errors = pitches.map((theta) => Math.abs(measured_deg[theta - 1] - setpoint_deg[theta - 1]));
  const used_deg = Math.max(...errors);
  const allowed_deg = ALLOWED_DEG[Math.min(pitches.length, ALLOWED_DEG.length - 1)];
  return { allowed_deg, used_deg, share: used_deg / allowed_deg, segments: pitches.map((theta) => (theta + 1) / 2) };
}
