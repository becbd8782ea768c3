// The way through the slit: from where the arm stands to a place before the mouth, then in the slit's plane to the rod.
import type { Scene, Triple } from '../model/robot';
import { distance, normalised, quaternionOf, type Pose, type Quaternion } from '../model/vector';

const BEFORE_M = 0.55; // of the mouth: where the tip comes into the plane
const STEP_M = 0.02; // between places that are looked at

export interface OnWay {
  s_m: number; // along the way
  off_m: number; // how far beside it
}

const dot = (a: ArrayLike<number>, b: ArrayLike<number>) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const between = (a: ArrayLike<number>, b: ArrayLike<number>, share: number): Triple => [0, 1, 2].map((r) => a[r] + share * (b[r] - a[r])) as Triple;

// By the shorter turn, evenly enough for what is less than half a turn.
function turned(a: Quaternion, b: Quaternion, share: number): Quaternion {
  const sign = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0 ? -1 : 1;
  return normalised([0, 1, 2, 3].map((i) => a[i] + share * (sign * b[i] - a[i])) as Quaternion);
}

export class Way {
  readonly length_m: number;
  readonly mouth_m: number; // how far along the slit begins
  private readonly corners: Pose[];
  private readonly first_m: number; // length of the way before the plane

  // Of a scene with a slit and a rod; `start`: the tip where the arm stands.
  constructor(scene: Scene, start: Pose) {
    const { slit, rod } = scene;
    if (!slit || !rod) throw new Error('this page needs a scene with a slit and a rod');
    const u = (place: ArrayLike<number>) => dot(slit.u_axis, place);
    const share = (slit.mouth_u_m - BEFORE_M - u(start)) / (u(rod.position_m) - u(start));
    const straight = between(start, rod.position_m, share);
    const before = between(straight, slit.normal.map((n, r) => straight[r] + n) as Triple, slit.offset_m - dot(slit.normal, straight));
    const attitude = rod.quaternion_wxyz;
    this.corners = [start, [...before, ...attitude], [...rod.position_m, ...attitude]];
    this.first_m = distance(start, before);
    this.length_m = this.first_m + distance(before, rod.position_m);
    this.mouth_m = this.first_m + (BEFORE_M / (u(rod.position_m) - u(before))) * distance(before, rod.position_m);
  }

  // The pose at a place of the way.
  at(s_m: number): Pose {
    const leg = s_m < this.first_m ? 0 : 1;
    const [from, to] = [this.corners[leg], this.corners[leg + 1]];
    const share = Math.max(0, Math.min(1, leg === 0 ? s_m / this.first_m : (s_m - this.first_m) / (this.length_m - this.first_m)));
    return [...between(from, to, share), ...turned(quaternionOf(from), quaternionOf(to), share)];
  }

  // The attitude that the tip should have at any place: that of the way where it is nearest.
  attitudeAt(place_m: ArrayLike<number>): Quaternion {
    return quaternionOf(this.at(this.nearestTo(place_m).s_m));
  }

  nearestTo(place_m: ArrayLike<number>): OnWay {
    const legs = [0, 1].map((leg) => {
      const [from, to] = [this.corners[leg], this.corners[leg + 1]];
      const [long, beside] = [to, place_m].map((end) => [0, 1, 2].map((r) => end[r] - from[r]));
      const share = Math.max(0, Math.min(1, dot(beside, long) / dot(long, long)));
      const s_m = share * Math.hypot(...long) + (leg === 0 ? 0 : this.first_m);
      return { s_m, off_m: distance(between(from, to, share), place_m) };
    });
    return legs[0].off_m < legs[1].off_m ? legs[0] : legs[1];
  }

  // Where a line of sight passes the way: from `eye_m` through `place_m`.
  nearestToSight(eye_m: ArrayLike<number>, place_m: ArrayLike<number>): OnWay {
    const length = distance(place_m, eye_m);
    const sight = [0, 1, 2].map((r) => (place_m[r] - eye_m[r]) / length);
    let best: OnWay = { s_m: 0, off_m: Infinity };
    for (let s_m = 0; s_m <= this.length_m; s_m += STEP_M) {
      const place = this.at(s_m);
      const along_m = dot([0, 1, 2].map((r) => place[r] - eye_m[r]), sight);
      const off_m = distance(place, [0, 1, 2].map((r) => eye_m[r] + along_m * sight[r]));
      if (off_m < best.off_m) best = { s_m, off_m };
    }
    return best;
  }

  // Points to draw, x y z each.
  points(): Float32Array {
    return Float32Array.from(this.corners.flatMap((corner) => corner.slice(0, 3)));
  }
}
