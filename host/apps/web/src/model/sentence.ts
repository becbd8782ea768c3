// What the arm does, in one sentence that a visitor understands.
import { isKnown, value, values, type Sample } from '../data/sample';
import { mainDistance } from './distances';
import type { Robot, Scene } from './robot';

const STATES: Record<string, string> = {
  BOOTING: 'the drives are booting',
  DISABLED: 'brakes on, drives without power',
  ENABLING: 'the cables are being tightened',
  ENABLED: 'enabled',
  STOPPING: 'stopping',
  FAULT: 'stopped by a fault',
};

const MODES: Record<string, string> = {
  vr: 'moved with the VR controllers',
  hand: 'moved with the hand controller',
};

function leftOf(sample: Sample): string {
  const share = value(sample, 'retract.points_left') / (sample.facts.retract?.points ?? NaN);
  return Number.isFinite(share) ? `, ${Math.round(100 * share)} % left` : '';
}

function doing(sample: Sample, stepCount: number | null): string {
  const { step, state, retract, stop, device_engaged, device } = sample.facts;
  if (stop) return `emergency stop by ${stop.by}`;
  if (state === 'FAULT') return STATES.FAULT;
  if (retract && ['stopping', 'joining', 'back'].includes(retract.phase)) return `going back along the verified path${leftOf(sample)}`;
  if (step) return `step ${step.index}${stepCount ? ` of ${stepCount}` : ''}: ${step.name}${step.waits ? `, waits: ${step.waits}` : ''}`;
  const what = STATES[state ?? ''] ?? 'no state yet';
  if (state !== 'ENABLED') return what;
  if (device_engaged) return MODES[device ?? ''] ?? 'moved with a device';
  return sample.facts.at_rest === false ? 'moving' : 'enabled, at rest';
}

// "step 4 of 6: segment 5 into the slit, at least 41 mm from the panel": one distance, the one that counts now;
// `stepCount`: null while not known.
export function sentenceOf(sample: Sample, robot: Robot, scene: Scene, stepCount: number | null): string {
  const tip = values(sample, 'measured_cp');
  const place = isKnown(tip) ? `tip of ${robot.name} at ${[...tip.subarray(0, 3)].map((x) => x.toFixed(2)).join(', ')} m` : '';
  const where = mainDistance(sample, scene) || place;
  return [doing(sample, stepCount), ...(where ? [where] : [])].join(', ');
}
