// Which numbers stand together on a strip, with their colours.
import { segmentsOf } from '../model/drive_names';
import { feedCount, type Robot, type Scene } from '../model/robot';
import { segmentColour } from '../scene/palette';
import type { Curve, Limit } from './strip';

export interface Source extends Curve {
  field: string;
  index: number;
  factor: number; // from the field's unit to the strip's
}

export interface Group {
  name: string; // short, for the filter
  title: string;
  sources: Source[];
  most?: number; // values beyond it are not worth the room
  limits?: Limit[]; // lines across the strip
  note?: string; // how its curves are told apart, where they are many
}

const AXIS_COLOURS = ['#e0564a', '#57b894', '#4e9bd6']; // x, y, z, as in the scene

type Has = (field: string, index: number) => boolean;

const DASHES = [undefined, [7, 3], [2, 2], [9, 3, 2, 3]]; // of the first, second, ... curve of a segment
const CABLE_NOTE = 'by segment; its cables solid, dashed, dotted';

function source(field: string, index: number, label: string, colour: string, factor = 1, dashed = false): Source {
  return { field, index, label, colour, factor, dash: dashed ? [4, 3] : undefined };
}

// One curve for each cable or joint: the segment's colour, and a line of its own within the segment.
function ofDrives(robot: Robot, field: string, factor = 1): Source[] {
  if (robot.kind === 'serial') return robot.joints.map((_, i) => source(field, i, `joint ${i + 1}`, segmentColour(i), factor));
  const segments = segmentsOf(robot);
  return segments.map((segment, i) => {
    const place = i - segments.indexOf(segment);
    return { ...source(field, i, `cable ${i + 1}, segment ${segment}`, segmentColour(segment - 1), factor), dash: DASHES[place % DASHES.length] };
  });
}

const both = (limit: number, name: string): Limit[] => [{ at: limit, name }, { at: -limit, name }];

function angleGroups(robot: Robot): Group[] {
  if (robot.kind === 'serial') {
    const joints = robot.joints.map((_, i) => source('measured_js_deg', i, String(i + 1), segmentColour(i)));
    return [{ name: 'angles', title: 'joints [deg]', sources: joints }];
  }
  const base = feedCount(robot);
  const ofAxis = (axis: number) =>
    robot.segments.map((_, m) => source('measured_js_deg', base + 2 * m + axis, String(base / 2 + m + 1), segmentColour(m)));
  const limit_deg = Math.min(...robot.segments.map((segment) => segment.theta_limit_deg));
  const fed = ['slide', 'roll'].map((name, i) => source('measured_js_deg', i, name, AXIS_COLOURS[i]));
  return [
    ...(base === 0 ? [] : [{ name: 'base', title: 'slide and roll of the base [deg]', sources: fed }]),
    { name: 'pitch', title: 'pitch of segments [deg]', sources: ofAxis(0), limits: both(limit_deg, 'limit') },
    { name: 'yaw', title: 'yaw of segments [deg]', sources: ofAxis(1), limits: both(limit_deg, 'limit') },
  ];
}

// What the drives report: share of the rated torque, which is that of the rated current.
function currentGroup(robot: Robot): Group {
  const note = robot.kind === 'serial' ? undefined : CABLE_NOTE;
  return { name: 'current', title: 'motor current, of rated [%]', sources: ofDrives(robot, 'drives.torque_permille', 0.1), note, limits: both(100, 'rated') };
}

function forceGroups(robot: Robot): Group[] {
  if (robot.kind === 'serial') return [{ name: 'torque', title: 'joint torque [N m]', sources: ofDrives(robot, 'torque_Nm') }];
  const { floor_motor_N, ceiling_free_N, alarm_N } = robot.tension;
  const limits = [{ at: floor_motor_N, name: 'floor' }, { at: ceiling_free_N, name: 'ceiling' }, { at: alarm_N, name: 'alarm' }];
  return [{ name: 'tension', title: 'cable tension [N]', sources: ofDrives(robot, 'tension_N').slice(feedCount(robot)), note: CABLE_NOTE, limits }];
}

function axes(field: string, factor = 1): Source[] {
  return ['x', 'y', 'z'].map((axis, i) => source(field, i, axis, AXIS_COLOURS[i], factor));
}

// Of an arm with a wrist sensor, an adapter or a servo; forces and torques in the tip's frame.
function pushGroups(): Group[] {
  const set = source('insert.force_setpoint_N', 0, 'set', '#f0a030', 1, true);
  const depths = [0, 1, 2].map((i) => source('adapter.depth_m', i, `pin ${i + 1}`, segmentColour(i), 1000));
  const way = source('insert.travel_m', 0, 'way', '#c96bb0', 1000, true);
  const aside = source('insert.lateral_m', 0, 'aside', '#8f9aa6', 1000, true);
  return [
    { name: 'wrist force', title: 'force at the wrist [N]', sources: axes('insert.measured_wrench.force_N') },
    { name: 'wrist torque', title: 'torque at the wrist [N m]', sources: axes('insert.measured_wrench.torque_Nm') },
    { name: 'push', title: 'push: what the arm gives [N]', sources: [...axes('insert.applied_force.force_N'), set] },
    { name: 'insertion', title: 'into the adapter [mm]', sources: [...depths, way, aside] },
    { name: 'servo', title: 'servo: left to go [mm]', most: 100, sources: axes('servo.error_m', 1000) },
    { name: 'servo turn', title: 'servo: left to turn [deg]', most: 5, sources: axes('servo.error_deg') },
  ];
}

// The strips of this arm; fields that are not there are left out, and strips without any.
export function groupsOf(robot: Robot, scene: Scene, has: Has): Group[] {
  const { slow_m, refuse_m } = scene.margins ?? {};
  const margins = [[slow_m, 'slowed'], [refuse_m, 'refused']] as const;
  const clearance: Group = {
    name: 'clearance',
    title: 'clearance up to 150 mm [mm]',
    most: 150,
    limits: margins.flatMap(([at_m, name]) => (at_m === undefined ? [] : [{ at: 1000 * at_m, name }])),
    sources: [
      source('clearance.distance_m', 0, 'guaranteed', '#f0a030', 1000),
      source('truth.clearance_m', 0, 'true', '#57b894', 1000),
      source('clearance.bound_m', 0, 'bound of error', '#8f9aa6', 1000, true),
    ],
  };
  const error: Group = {
    name: 'tip',
    title: 'tip: speed [mm/s], push [N]',
    sources: [source('truth.tip_speed_m_s', 0, 'true speed', '#4e9bd6', 1000), source('truth.contact_N', 0, 'contact', '#e0564a')],
  };
  const bus: Group = {
    name: 'bus',
    title: 'bus load [%]',
    sources: [0, 1, 2, 3].map((b) => source('buses.measured_load', b, `bus ${b + 1}`, segmentColour(b), 100)),
  };
  const verdict: Group = {
    name: 'verdict',
    title: 'nearest limit, share used [%]',
    limits: [{ at: 100, name: 'limit' }],
    sources: [source('verdict.share', 0, 'verdict', '#c96bb0', 100)],
  };
  const tick: Group = { name: 'tick', title: 'longest tick in real time [us]', sources: [source('tick_us', 0, 'tick', '#4e9bd6')] };
  const ofArm = [...angleGroups(robot), ...pushGroups(), ...forceGroups(robot), currentGroup(robot)];
  return [...ofArm, clearance, verdict, bus, tick, error]
    .map((group) => ({ ...group, sources: group.sources.filter((s) => has(s.field, s.index)) }))
    .filter((group) => group.sources.length > 0);
}
