// How drives and cables are written in every text: counted from 1, with node and segment.
import type { Facts } from '../data/sample';
import { feedCount, type Robot } from './robot';

// Segment (from 1) of each drive, in their order; empty for an arm without cables.
export function segmentsOf(robot: Robot): number[] {
  if (robot.kind === 'serial') return [];
  const base = feedCount(robot) === 0 ? [] : [1, 1]; // a base that feeds is segment 1
  return [...base, ...robot.cables.phase_deg.flatMap((cables, m) => cables.map(() => m + 1 + base.length / 2))];
}

// "drive 4 (node 4, segment 2)" of the drive with this index, from 0.
export function driveText(drive: number, robot: Robot): string {
  const segment = segmentsOf(robot)[drive];
  return `drive ${drive + 1} (node ${drive + 1}${segment ? `, segment ${segment}` : ''})`;
}

const CABLE_BREAK = 5006;

// Drives (from 0) whose cable is lost: by a break that is latched, or on the way back after it.
export function lostCables(facts: Facts): number[] {
  const broken = (facts.faults ?? []).filter((fault) => fault.number === CABLE_BREAK && fault.index !== undefined).map((fault) => fault.index!);
  return [...new Set([...broken, ...(facts.recovery?.cables ?? []).map((cable) => cable - 1)])].sort((a, b) => a - b);
}

// "a, b and c"
function listed(texts: readonly string[]): string {
  return texts.length < 2 ? (texts[0] ?? '') : `${texts.slice(0, -1).join(', ')} and ${texts[texts.length - 1]}`;
}

// One text for places such as drives: "drives 4 (node 4, segment 2) and 5 (node 5, segment 2)"; of more than three
// drives the numbers only.
export function placesText(places: readonly string[]): string {
  const drives = places.map((place) => /^drive (\d+)(.*)$/.exec(place));
  if (places.length < 2 || drives.some((drive) => !drive)) return listed(places);
  return `drives ${listed(drives.map((drive) => drive![1] + (places.length > 3 ? '' : drive![2])))}`;
}
