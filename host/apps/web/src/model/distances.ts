// How far the arm is from things. One distance is shown at a time, by its name; the others stand in a detail.
import { isKnown, value, values, type Sample } from '../data/sample';
import type { Robot, Scene } from './robot';
import { lengthText, spoken } from './text';
import { distance } from './vector';

export const NEAR_M = 0.3; // nearer than this, the clearance is what counts
const NO_LIMIT_M = 100; // a margin from here on means that there is nothing to come near to

// "at least 41 mm from the panel": the guaranteed bound, errors subtracted; empty while nothing is guaranteed.
export function boundText(sample: Sample): string {
  const bound_m = value(sample, 'clearance.distance_m');
  return Number.isFinite(bound_m) ? `at least ${lengthText(bound_m)} from the ${spoken(sample.facts.clearance?.body ?? 'scene')}` : '';
}

function toRod(sample: Sample, scene: Scene): string {
  const tip = values(sample, 'measured_cp');
  return scene.rod && isKnown(tip) ? `${lengthText(distance(tip, scene.rod.position_m))} to the rod` : '';
}

// The one that counts now: what is near, else the way to the goal. Empty: none is known.
export function mainDistance(sample: Sample, scene: Scene): string {
  const isNear = value(sample, 'clearance.distance_m') < NEAR_M || ['slow', 'refuse'].includes(sample.facts.clearance?.level ?? '');
  return (isNear ? '' : toRod(sample, scene)) || boundText(sample) || toRod(sample, scene);
}

// All of them, name and text.
export function distanceLines(sample: Sample, scene: Scene): [string, string][] {
  const bound_m = value(sample, 'clearance.distance_m');
  const error_m = value(sample, 'clearance.bound_m');
  const predicted_m = value(sample, 'verdict.margins');
  const lines: [string, string][] = [['guaranteed (bound)', boundText(sample)]];
  if (Number.isFinite(bound_m + error_m)) {
    lines.push(['measured now', `${lengthText(bound_m + error_m)}, of which ${lengthText(error_m)} may be error; known by ${sample.facts.clearance?.confidence ?? '?'}`]);
  }
  if (predicted_m < NO_LIMIT_M) lines.push(['predicted', `${lengthText(predicted_m)} are left during the last command and the stop after it`]);
  lines.push(['tip, measured now', toRod(sample, scene)]);
  return lines.filter(([, text]) => text !== '');
}

// "slowed to 40 % by tension", or by the limits that act now; empty while nothing holds the tip back.
export function slowdownText(sample: Sample): string {
  const { clearance, guidance, limits } = sample.facts;
  const share = value(sample, 'guidance.speed_share');
  const by = [guidance?.slowed_by ?? '', ...(limits ?? [])].filter((name) => name !== '').map(spoken);
  if (clearance?.level === 'slow') by.unshift(`the ${spoken(clearance.body)} being near`);
  if (by.length === 0) return '';
  return `slowed${share < 0.995 ? ` to ${Math.round(100 * share)} %` : ''} by ${[...new Set(by)].join(', ')}`;
}

function causeOfDeviation({ facts }: Sample, robot: Robot): string {
  if (facts.recovery) return 'a cable is lost';
  if (facts.state !== 'ENABLED') return 'brakes hold; the cables are not tightened';
  if (robot.kind === 'serial') return facts.at_rest === false ? 'drives follow late' : 'joints bend';
  if (facts.friction?.not_as_declared) return 'friction is not as declared';
  return facts.at_rest === false ? 'drives follow late; friction and stretch of cables' : 'friction and stretch of cables';
}

// Of the tips of the commanded and the measured arm, with what causes it now.
export function deviationText(sample: Sample, robot: Robot, deviation_m: number): string {
  return `commanded less measured: ${(1000 * deviation_m).toFixed(1)} mm at the tip (${causeOfDeviation(sample, robot)})`;
}
