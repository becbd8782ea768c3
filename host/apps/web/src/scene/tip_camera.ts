// How the camera at the tip stands: cable arms come to things along the tip's x, an arm with a payload along its z.

export type Ahead = 'x' | 'z';

// Writes the camera's frame (it looks along its -z, y is up) for the tip's, both column by column.
export function writeCameraFrame(tip: ArrayLike<number>, ahead: Ahead, to: number[]): void {
  const [forward, up, side] = ahead === 'x' ? [0, 8, -1] : [8, 0, 1];
  for (let r = 0; r < 3; ++r) {
    to[r] = side * tip[4 + r];
    to[4 + r] = tip[up + r];
    to[8 + r] = -tip[forward + r];
    to[12 + r] = tip[12 + r];
  }
}
