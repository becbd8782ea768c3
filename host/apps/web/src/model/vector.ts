// Poses as the API has them: [x, y, z, qw, qx, qy, qz], metres and unit quaternions.

export type Pose = number[];
export type Quaternion = [number, number, number, number]; // w, x, y, z

export function distance(a: ArrayLike<number>, b: ArrayLike<number>): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

export function multiply(a: Quaternion, b: Quaternion): Quaternion {
  return [
    a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
    a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
    a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
    a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
  ];
}

export function conjugate(q: Quaternion): Quaternion {
  return [q[0], -q[1], -q[2], -q[3]];
}

export function rotated(q: Quaternion, v: ArrayLike<number>): [number, number, number] {
  const r = multiply(multiply(q, [0, v[0], v[1], v[2]]), conjugate(q));
  return [r[1], r[2], r[3]];
}

// Turn by `angle_rad` about the unit vector `axis`.
export function about(axis: ArrayLike<number>, angle_rad: number): Quaternion {
  const s = Math.sin(angle_rad / 2);
  return [Math.cos(angle_rad / 2), s * axis[0], s * axis[1], s * axis[2]];
}

export function quaternionOf(pose: ArrayLike<number>): Quaternion {
  return [pose[3], pose[4], pose[5], pose[6]];
}

export function normalised(q: Quaternion): Quaternion {
  const n = Math.hypot(...q);
  return [q[0] / n, q[1] / n, q[2] / n, q[3] / n];
}

// The pose moved by `way_m` and turned by `turn_rad` (rotation vector), both along the axes of the base frame or, with
// `inTip`, of the pose itself.
export function moved(pose: ArrayLike<number>, way_m: ArrayLike<number>, turn_rad: ArrayLike<number>, inTip: boolean): Pose {
  const q = quaternionOf(pose);
  const angle = Math.hypot(turn_rad[0], turn_rad[1], turn_rad[2]);
  const axis = angle > 0 ? [turn_rad[0] / angle, turn_rad[1] / angle, turn_rad[2] / angle] : [1, 0, 0];
  const step = inTip ? rotated(q, way_m) : way_m;
  const by = about(axis, angle);
  const turned = normalised(inTip ? multiply(q, by) : multiply(by, q));
  return [pose[0] + step[0], pose[1] + step[1], pose[2] + step[2], ...turned];
}

// Angle between two attitudes [rad].
export function turnBetween(a: ArrayLike<number>, b: ArrayLike<number>): number {
  const q = multiply(conjugate(quaternionOf(a)), quaternionOf(b));
  return 2 * Math.atan2(Math.hypot(q[1], q[2], q[3]), Math.abs(q[0]));
}
