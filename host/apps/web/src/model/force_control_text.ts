// What payload, servo, push, adapter and wrist tell, in short lines; empty where the arm has no such thing. Runs of
// older versions lack some of the numbers: what is not known is left out, or a dash among others.
import { is_known, value, values, type Sample } from '../data/sample';
import { payload_place } from './payload_place';
import type { Scene } from './robot';
import { length_text } from './sentence';

function length_of(v: ArrayLike<number>): number {
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
function vector_text(v: ArrayLike<number>, unit: string): string {
  return known(length_of(v), (length) => `${length.toFixed(1)} ${unit} (${triple(v, 1)})`);
}

function wrist_text(sample: Sample): string {
  const force = vector_text(values(sample, 'push.felt.force_N'), 'N');
  const torque = vector_text(values(sample, 'push.felt.torque_Nm'), 'N m');
  return force && listed(force, torque, sample.facts.push?.wrist);
}

function push_text(sample: Sample): string {
  const { push } = sample.facts;
  if (!push || push.number === 0) return '';
  const law = push.law === 'impedance' ? ' by impedance' : '';
  const said = listed(
    push.end !== 'none' && `ended: ${push.end.replaceAll('_', ' ')}`,
    push.phase !== 'none' && `${push.phase}${law}`,
    known(value(sample, 'push.set_N'), (N) => `set ${N.toFixed(1)} N`),
    known(length_of(values(sample, 'push.given.force_N')), (N) => `gives ${N.toFixed(1)} N`),
    known(value(sample, 'push.travel_m'), (m) => `${length_text(m)} on`),
    known(value(sample, 'push.aside_m'), (m) => `${length_text(m)} aside`),
    push.touched && 'touches',
  );
  return `${push.number} ${said}`;
}

function adapter_text(sample: Sample): string {
  const { adapter } = sample.facts;
  const depth_m = values(sample, 'adapter.depth_m');
  if (!adapter || !is_known(depth_m)) return '';
  const what = adapter.captured ? 'captured' : 'not captured';
  return `${what}, latch ${adapter.latch}, lock ${adapter.lock}, pins ${triple(depth_m, 1, 1000)} mm in`;
}

function servo_text(sample: Sample): string {
  const { servo } = sample.facts;
  if (!servo?.target) return '';
  const error_m = values(sample, 'servo.error_m');
  const error_deg = values(sample, 'servo.error_deg');
  const turn = known(length_of(error_deg), (deg) => ` and ${deg.toFixed(2)} deg`);
  const swing_m = value(sample, 'servo.swing_m');
  const said = listed(
    servo.phase.replaceAll('_', ' '),
    known(length_of(error_m), (m) => `${length_text(m)}${turn} to go`),
    swing_m > 0 && `the target swings by ${length_text(swing_m)}`,
    servo.reason,
  );
  return `to the ${servo.target}: ${said}`;
}

function payload_text({ facts }: Sample, scene: Scene): string {
  if (!scene.payload) return '';
  const mass_kg = facts.payload?.mass_kg ?? 0;
  const told = mass_kg > 0 ? `, the arm carries ${mass_kg} kg` : '';
  const place = payload_place(facts, scene);
  if (place === 'mechanism') return 'in the transfer mechanism';
  if (place === 'adapter') return 'in the adapter, released';
  const { captured, lock } = facts.adapter ?? {};
  const held = captured ? `, ${lock === 'closed' ? 'locked' : 'captured'} in the adapter` : '';
  return `on the tip${held}${told}`;
}

// Name and line of each.
export function push_lines(sample: Sample, scene: Scene): [string, string][] {
  return [
    ['payload', payload_text(sample, scene)],
    ['servo', servo_text(sample)],
    ['push', push_text(sample)],
    ['adapter', adapter_text(sample)],
    ['wrist', wrist_text(sample)],
  ];
}
