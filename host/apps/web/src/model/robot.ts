// The robot and the scene as lianad and runs have them (docs/reference/formats.md): only what the page reads.

export interface CableRobot {
  name: string;
  kind: 'robot';
  base?: { limit_deg: number; slide_m_per_deg: number }; // feeds: slide and roll are the first two angles and drives
  segments: { modules: number; module_length_m: number; theta_limit_deg: number }[];
  module: { radius_m: number };
  cables: { hole_radius_m: number | number[]; face_offset_m: number | number[]; phase_deg: number[][] };
  tension: { plan_N: number; floor_motor_N: number; ceiling_free_N: number; alarm_N: number; hard_limit_N: number };
  limits: TipLimits & { theta_rate_deg_s: number; tip_speed_slit_m_s: number };
  named_poses_deg: Record<string, number[]>;
}

// How many angles and drives a base that feeds has.
export function feedCount(robot: Robot): number {
  return robot.kind === 'robot' && robot.base ? 2 : 0;
}

// Of segment `m`: a number is that of all segments, a list has one for each.
export function numberOfSegment(numbers: number | number[], m: number): number {
  return typeof numbers === 'number' ? numbers : numbers[m];
}

export interface SerialRobot {
  name: string;
  kind: 'serial';
  joints: {
    alpha_deg: number;
    a_m: number;
    d_m: number;
    offset_deg?: number;
    low_deg: number;
    high_deg: number;
    rate_deg_s: number;
  }[];
  limits: TipLimits;
  named_poses_deg: Record<string, number[]>;
  base?: { pose: string }; // what carries it
}

export interface TipLimits {
  tip_speed_m_s: number;
  tip_rate_deg_s: number;
}

export type Robot = CableRobot | SerialRobot;

export type Triple = [number, number, number];

export interface Box {
  name: string;
  center_m: Triple;
  half_extent_m: Triple;
  rotation: [Triple, Triple, Triple]; // its axes as rows, in base coordinates
}

export interface Convex {
  name: string;
  points_m?: Triple[];
  cylinder?: { from_m: Triple; to_m: Triple; radius_m: number };
  chain?: { points_m: Triple[]; radius_m: number };
}

export interface Slit {
  normal: Triple;
  offset_m: number;
  u_axis: Triple;
  w_axis: Triple;
  mouth_u_m: number;
  end_u_m: number;
  half_gap_m: number;
  frame: { position_m: Triple };
}

export interface ScenePose {
  position_m: Triple;
  quaternion_wxyz: [number, number, number, number];
}

export interface Scene {
  name: string;
  boxes?: Box[];
  spheres?: { name: string; center_m: Triple; radius_m: number }[];
  convex?: Convex[];
  slit?: Slit;
  rod?: ScenePose & { radius_m: number };
  payload?: ScenePose & { start: string; length_m: number; radius_m?: number; fetch_pose?: string }; // frame of its grapple, z towards its pins
  adapter?: ScenePose; // the middle of its face, z into it
  margins?: { prediction_m?: number; slow_m?: number; refuse_m?: number };
}

// How many angles the arm has.
export function angleCount(robot: Robot): number {
  return robot.kind === 'serial' ? robot.joints.length : feedCount(robot) + 2 * robot.segments.length;
}

// Range of angle `i` (from 0) [deg].
export function angleRange_deg(robot: Robot, i: number): [number, number] {
  if (robot.kind === 'serial') return [robot.joints[i].low_deg, robot.joints[i].high_deg];
  const limit = robot.base && i < 2 ? robot.base.limit_deg : robot.segments[(i - feedCount(robot)) >> 1].theta_limit_deg;
  return [-limit, limit];
}

// What people call angle `i` (from 0).
export function angleName(robot: Robot, i: number): string {
  if (robot.kind === 'serial') return `joint ${i + 1}`;
  if (i < feedCount(robot)) return i === 0 ? 'slide' : 'roll';
  return `${i % 2 === 0 ? 'pitch' : 'yaw'} ${(i >> 1) + 1}`; // a base that feeds is segment 1
}

// Farthest that the tip can be from the base [m].
export function reach_m(robot: Robot): number {
  if (robot.kind === 'serial') return robot.joints.reduce((sum, j) => sum + Math.abs(j.a_m) + Math.abs(j.d_m), 0);
  const fed_m = robot.base ? robot.base.slide_m_per_deg * robot.base.limit_deg : 0;
  return robot.segments.reduce((sum, s) => sum + s.modules * s.module_length_m, fed_m);
}
