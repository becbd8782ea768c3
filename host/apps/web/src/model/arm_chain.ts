// Where every straight piece of an arm is for given angles, from the robot table; columns as WebGL wants them.
import { feedCount, type CableRobot, type Robot, type SerialRobot } from './robot';

const DEG = Math.PI / 180;

// A straight piece of the arm: along the x axis of its frame, which stands at its beginning.
export interface Piece {
  length_m: number;
  segment: number; // from 0; of a serial arm the joint that moves it
}

// A rigid transformation as 3 rows of 4, in doubles: what is multiplied along the arm.
type Rows = Float64Array;

export interface ArmChain {
  readonly pieces: Piece[];
  readonly matrices: Float32Array; // of each piece's frame in the base frame, 16 each, column by column
  readonly tip: Float32Array; // 16: the tip's frame
  readonly nodes: Float32Array; // 3 for each segment: where it ends; a base that feeds is one
  // Moves all to these angles; angles beyond those given are 0. About 5 us, nothing is allocated.
  set(theta_deg: ArrayLike<number>): void;
}

export function chainOf(robot: Robot): ArmChain {
  const chain = robot.kind === 'serial' ? new SerialChain(robot) : new CableChain(robot);
  chain.set([]);
  return chain;
}

// Lengths of each segment's pieces [m].
function piecesOf(lengths: readonly number[][]): Piece[] {
  return lengths.flatMap((of_m, segment) => of_m.map((length_m) => ({ length_m, segment })));
}

function identity(): Rows {
  return Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0);
}

// Turns columns `a` and `b` of the rotation: about x for (1, 2), about y for (2, 0), about z for (0, 1).
function turn(rows: Rows, a: number, b: number, angle_rad: number): void {
  const c = Math.cos(angle_rad);
  const s = Math.sin(angle_rad);
  for (let r = 0; r < 12; r += 4) {
    const x = rows[r + a];
    const y = rows[r + b];
    rows[r + a] = c * x + s * y;
    rows[r + b] = c * y - s * x;
  }
}

function advance(rows: Rows, axis: number, way_m: number): void {
  for (let r = 0; r < 12; r += 4) rows[r + 3] += rows[r + axis] * way_m;
}

// `first` to `third`: which of the frame's axes stand in the columns of the matrix.
function write(rows: Rows, out: Float32Array, at: number, first = 0, second = 1, third = 2): void {
  for (let r = 0; r < 3; ++r) {
    out[at + r] = rows[4 * r + first];
    out[at + 4 + r] = rows[4 * r + second];
    out[at + 8 + r] = rows[4 * r + third];
    out[at + 12 + r] = rows[4 * r + 3];
  }
  out[at + 3] = out[at + 7] = out[at + 11] = 0;
  out[at + 15] = 1;
}

function atOrZero(values: ArrayLike<number>, i: number): number {
  return i < values.length && Number.isFinite(values[i]) ? values[i] : 0;
}

abstract class Chain implements ArmChain {
  readonly matrices: Float32Array;
  readonly tip = new Float32Array(16);
  readonly nodes: Float32Array;

  constructor(readonly pieces: Piece[], segments: number) {
    this.matrices = new Float32Array(16 * pieces.length);
    this.nodes = new Float32Array(3 * segments);
  }

  set(theta_deg: ArrayLike<number>): void {
    const rows = identity();
    this.walk(rows, theta_deg);
    write(rows, this.tip, 0);
  }

  protected endOf(segment: number, rows: Rows): void {
    for (let r = 0; r < 3; ++r) this.nodes[3 * segment + r] = rows[4 * r + 3];
  }

  // Moves `rows` from the base to the tip, and writes pieces and nodes on the way.
  protected abstract walk(rows: Rows, theta_deg: ArrayLike<number>): void;
}

// A base that feeds, then segments of equal-angled modules: odd modules turn Rz(pitch) Ry(yaw), even ones Ry(yaw) Rz(pitch).
class CableChain extends Chain {
  constructor(private readonly robot: CableRobot) {
    const { segments } = robot;
    const lengths = segments.map((s) => new Array<number>(s.modules).fill(s.module_length_m));
    super(piecesOf(lengths), feedCount(robot) / 2 + segments.length);
  }

  protected override walk(rows: Rows, theta_deg: ArrayLike<number>): void {
    const { base } = this.robot;
    const first = feedCount(this.robot);
    if (base) {
      advance(rows, 0, base.slide_m_per_deg * atOrZero(theta_deg, 0));
      turn(rows, 1, 2, atOrZero(theta_deg, 1) * DEG);
      this.endOf(0, rows);
    }
    this.pieces.forEach(({ length_m, segment }, k) => {
      const pitch = atOrZero(theta_deg, first + 2 * segment) * DEG;
      const yaw = atOrZero(theta_deg, first + 2 * segment + 1) * DEG;
      if (k % 2 === 0) turn(rows, 0, 1, pitch);
      turn(rows, 2, 0, yaw);
      if (k % 2 === 1) turn(rows, 0, 1, pitch);
      write(rows, this.matrices, 16 * k);
      advance(rows, 0, length_m);
      this.endOf(first / 2 + segment, rows);
    });
  }
}

// Standard DH rows; a row is up to two straight pieces, along z and along the new x.
class SerialChain extends Chain {
  constructor(private readonly robot: SerialRobot) {
    super(piecesOf(robot.joints.map(({ d_m, a_m }) => [d_m, a_m].filter((length_m) => length_m !== 0))), robot.joints.length);
  }

  protected override walk(rows: Rows, theta_deg: ArrayLike<number>): void {
    let at = 0;
    this.robot.joints.forEach((joint, j) => {
      turn(rows, 0, 1, (atOrZero(theta_deg, j) + (joint.offset_deg ?? 0)) * DEG);
      if (joint.d_m !== 0) write(rows, this.matrices, 16 * at++, 2, 0, 1);
      advance(rows, 2, joint.d_m);
      if (joint.a_m !== 0) write(rows, this.matrices, 16 * at++);
      advance(rows, 0, joint.a_m);
      turn(rows, 1, 2, joint.alpha_deg * DEG);
      this.endOf(j, rows);
    });
  }
}
