// What the arm does, in one sentence that a visitor understands.
import { isKnown, value, values, type Sample } from '../data/sample';
import type { Robot, Scene } from './robot';
import { distance } from './vector';

const STATES: Record<string, string> = {
  BOOTING: 'the drives are booting',
  DISABLED: 'brakes on, drives without power',
  ENABLING: 'the cables are being tightened',
  ENABLED: 'enabled',
  STOPPING: 'stopping',
  FAULT: 'stopped by a fault',
};

const MODES: Record<string, string> = {
  vr: 'steered by VR handles',
  hand: 'steered by the hand controller',
};

// 41 mm, 0.86 m.
export function lengthText(length_m: number): string {
  if (!Number.isFinite(length_m)) return '?';
  return Math.abs(length_m) < 0.2 ? `${(1000 * length_m).toFixed(length_m < 0.02 ? 1 : 0)} mm` : `${length_m.toFixed(2)} m`;
}

function doing(sample: Sample, stepCount: number | null): string {
  const { step, state, retract, stop, device_engaged, device } = sample.facts;
  if (stop) return `emergency stop by ${stop.by}`;
  if (state === 'FAULT') return STATES.FAULT;
  if (retract && ['stopping', 'joining', 'back'].includes(retract.phase)) return 'going back along the verified path';
  if (step) return `step ${step.index}${stepCount ? ` of ${stepCount}` : ''}: ${step.name}`;
  const what = STATES[state ?? ''] ?? 'no state yet';
  if (state !== 'ENABLED') return what;
  if (device_engaged) return MODES[device ?? ''] ?? 'steered';
  return sample.facts.at_rest === false ? 'moving' : 'enabled, at rest';
}

// "step 4 of 6: segment 5 into the slit, 41 mm from the panel, 0.86 m to the rod"; `stepCount`: null while not known.
export function sentenceOf(sample: Sample, robot: Robot, scene: Scene, stepCount: number | null): string {
  const parts = [doing(sample, stepCount)];
  const clear_m = value(sample, 'clearance.distance_m');
  if (Number.isFinite(clear_m)) parts.push(`${lengthText(clear_m)} from the ${sample.facts.clearance?.body ?? 'scene'}`);
  const tip = values(sample, 'measured_cp');
  if (scene.rod && isKnown(tip)) parts.push(`${lengthText(distance(tip, scene.rod.position_m))} to the rod`);
  else if (isKnown(tip)) parts.push(`tip of ${robot.name} at ${[...tip.subarray(0, 3)].map((x) => x.toFixed(2)).join(', ')} m`);
  return parts.join(', ');
}
