// What payload, servo, push, adapter and wrist tell, in short lines; empty where the arm has no such thing.
import { is_known, value, values, type Sample } from '../data/sample';
import { payload_place } from './payload_place';
import type { Scene } from './robot';
import { length_text } from './sentence';

function length_of(v: ArrayLike<number>): number {
  return Math.hypot(v[0], v[1], v[2]);
}

function triple(v: ArrayLike<number>, digits: number, factor = 1): string {
  return Array.from(v, (x) => (factor * x).toFixed(digits)).join(', ');
}

function wrist_text(sample: Sample): string {
  const force_N = values(sample, 'push.felt.force_N');
  const torque_Nm = values(sample, 'push.felt.torque_Nm');
  if (!is_known(force_N)) return '';
  const force = `${length_of(force_N).toFixed(1)} N (${triple(force_N, 1)})`;
  const torque = `${length_of(torque_Nm).toFixed(1)} N m (${triple(torque_Nm, 1)})`;
  return `${force}, ${torque}, ${sample.facts.push?.wrist ?? '?'}`;
}

function push_text(sample: Sample): string {
  const { push } = sample.facts;
  if (!push || push.number === 0) return '';
  const ended = push.end === 'none' ? '' : ` ended: ${push.end.replaceAll('_', ' ')},`;
  const law = push.law === 'force' ? '' : ` by ${push.law}`;
  const given_N = length_of(values(sample, 'push.given.force_N')).toFixed(1);
  const way = `${length_text(value(sample, 'push.travel_m'))} on, ${length_text(value(sample, 'push.aside_m'))} aside`;
  const phase = push.phase === 'none' ? '' : ` ${push.phase}${law},`;
  const force = `set ${value(sample, 'push.set_N').toFixed(1)} N, gives ${given_N} N`;
  return `${push.number}${ended}${phase} ${force}, ${way}${push.touched ? ', touches' : ''}`;
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
  const left = is_known(error_m) ? `, ${length_text(length_of(error_m))} and ${length_of(error_deg).toFixed(2)} deg to go` : '';
  const swing_m = value(sample, 'servo.swing_m');
  const swing = swing_m > 0 ? `, the target swings by ${length_text(swing_m)}` : '';
  const why = servo.reason ? `, ${servo.reason}` : '';
  return `to the ${servo.target}: ${servo.phase.replaceAll('_', ' ')}${left}${swing}${why}`;
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
