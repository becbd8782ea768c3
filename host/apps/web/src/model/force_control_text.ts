// What payload, servo, push, adapter and wrist tell, in short lines; empty where the arm has no such thing. Runs of
// older versions lack some of the numbers: what is not known is left out, or a dash among others.
import { isKnown, value, values, type Sample } from '../data/sample';
import { payloadPlace } from './payload_place';
import type { Scene } from './robot';
import { lengthText, spoken } from './text';

function lengthOf(v: ArrayLike<number>): number {
  return Math.hypot(v[0], v[1], v[2]);
}

function triple(v: ArrayLike<number>, digits: number, factor = 1): string {
  return Array.from(v, (x) => (Number.isFinite(x) ? (factor * x).toFixed(digits) : '\u2013')).join(', ');
}

// The parts that say something.
function listed(...parts: (string | false | undefined)[]): string {
  return parts.filter(Boolean).join(', ');
}

function known(x: number, text: (x: number) => string): string {
  return Number.isFinite(x) ? text(x) : '';
}

// Length and parts of a vector.
function vectorText(v: ArrayLike<number>, unit: string): string {
  return known(lengthOf(v), (length) => `${length.toFixed(1)} ${unit} (${triple(v, 1)})`);
}

function wristText(sample: Sample): string {
  const force = vectorText(values(sample, 'insert.measured_wrench.force_N'), 'N');
  const torque = vectorText(values(sample, 'insert.measured_wrench.torque_Nm'), 'N m');
  return force && listed(force, torque, sample.facts.insert?.wrist);
}

function pushText(sample: Sample): string {
  const { insert: push } = sample.facts;
  if (!push || push.number === 0) return '';
  const law = push.law === 'impedance' ? ' by impedance' : '';
  const said = listed(
    push.end !== 'none' && `ended: ${spoken(push.end)}`,
    push.phase !== 'none' && `${push.phase}${law}`,
    known(value(sample, 'insert.force_setpoint_N'), (newtons) => `set ${newtons.toFixed(1)} N`),
    known(lengthOf(values(sample, 'insert.applied_force.force_N')), (newtons) => `gives ${newtons.toFixed(1)} N`),
    known(value(sample, 'insert.travel_m'), (m) => `${lengthText(m)} on`),
    known(value(sample, 'insert.lateral_m'), (m) => `${lengthText(m)} aside`),
    push.touched && 'touches',
  );
  return `${push.number} ${said}`;
}

function adapterText(sample: Sample): string {
  const { adapter } = sample.facts;
  const depth_m = values(sample, 'adapter.depth_m');
  if (!adapter || !isKnown(depth_m)) return '';
  const what = adapter.captured ? 'captured' : 'not captured';
  return `${what}, latch ${adapter.latch}, lock ${adapter.lock}, pins ${triple(depth_m, 1, 1000)} mm in`;
}

function servoText(sample: Sample): string {
  const { servo } = sample.facts;
  if (!servo?.target) return '';
  const error_m = values(sample, 'servo.error_m');
  const error_deg = values(sample, 'servo.error_deg');
  const turn = known(lengthOf(error_deg), (deg) => ` and ${deg.toFixed(2)} deg`);
  const swing_m = value(sample, 'servo.sway_m');
  const said = listed(
    spoken(servo.phase),
    known(lengthOf(error_m), (m) => `${lengthText(m)}${turn} to go`),
    swing_m > 0 && `the target swings by ${lengthText(swing_m)}`,
    servo.reason,
  );
  return `to the ${servo.target}: ${said}`;
}

function payloadText({ facts }: Sample, scene: Scene): string {
  if (!scene.payload) return '';
  const mass_kg = facts.payload?.mass_kg ?? 0;
  const told = mass_kg > 0 ? `, the arm carries ${mass_kg} kg` : '';
  const place = payloadPlace(facts, scene);
  if (place === 'mechanism') return 'in the transfer mechanism';
  if (place === 'adapter') return 'in the adapter, released';
  const { captured, lock } = facts.adapter ?? {};
  const held = captured ? `, ${lock === 'closed' ? 'locked' : 'captured'} in the adapter` : '';
  return `on the tip${held}${told}`;
}

// Name and line of each.
export function pushLines(sample: Sample, scene: Scene): [string, string][] {
  return [
    ['payload', payloadText(sample, scene)],
    ['servo', servoText(sample)],
    ['push', pushText(sample)],
    ['adapter', adapterText(sample)],
    ['wrist', wristText(sample)],
  ];
}
