import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Facts, LianaEvent } from '../../host/apps/web/src/data/sample';
import { name_problem } from '../../host/apps/web/src/live/display_name';
import type { Alarm } from '../../host/apps/web/src/model/alarms';
import { alarm_badge, owner_badge, state_badge } from '../../host/apps/web/src/model/badges';
import { ending_of, refusal_words, type Ending, type Taken } from '../../host/apps/web/src/model/outcome_text';
import { hardware_text } from '../../host/apps/web/src/model/hardware';
import { sample_of } from './support';

const resting: Facts = { state: 'ENABLED', at_rest: true, is_busy: false, faults: [], stop: null, owner: 'anna' };
const moving: Facts = { ...resting, at_rest: false, is_busy: true };
const event = (changes: Partial<LianaEvent>): LianaEvent => ({ sequence: 8, tick: 500, kind: 'verdict', number: 208, subject: 'simulation', values: {}, text: 'link 27 and the wall', ...changes });

function end(op: string, facts: Facts, more: { taken?: Partial<Taken>; events?: LianaEvent[]; is_mine?: boolean; after_s?: number } = {}): Ending | null {
  const taken = { op, time_s: 2, last_event: 7, ...more.taken };
  return ending_of(taken, { time_s: 2 + (more.after_s ?? 1), facts, is_mine: more.is_mine ?? true, events: more.events ?? [] });
}

test('a motion that was taken is done when the arm is at rest, and not by the state before it began', () => {
  assert.equal(end('move_cp', moving), null);
  assert.equal(end('move_cp', resting, { after_s: 0.02 }), null);
  assert.deepEqual(end('move_cp', resting), { ok: true, text: 'done' });
  assert.equal(end('shape', { ...resting, shape: { settled: false, searching: true } }), null);
});

test('a motion that verification refuses after it was taken is refused with reason and remedy, not done', () => {
  assert.deepEqual(end('move_jp', resting, { events: [event({})] }), { ok: false, text: 'link 27 and the wall' });
  assert.deepEqual(end('move_jp', resting, { events: [event({ sequence: 7 })] }), { ok: true, text: 'done' }); // of something before
  assert.match(refusal_words(event({ kind: 'path', number: 0 })), /^refused: .*\[207 /);
  assert.equal(refusal_words(event({ kind: 'step' })), '');
});

test('a motion that stop, fault, another owner or a disabled arm ended is not done', () => {
  assert.match(end('move_cp', { ...moving, stop: { by: 'ben', reason: '', tick: 1 } })!.text, /emergency stop of ben/);
  assert.match(end('move_cp', { ...moving, faults: [{ number: 5006, name: 'cable_break' }] })!.text, /fault 5006 cable break/);
  assert.match(end('move_cp', moving, { is_mine: false })!.text, /no longer yours/);
  assert.match(end('move_cp', { ...moving, state: 'DISABLED' })!.text, /is DISABLED/);
});

test('operating states are done when they are there, and a clear says what it could not clear', () => {
  const command = (name: string) => ({ taken: { command: name } });
  assert.equal(end('state_command', { ...resting, state: 'ENABLING' }, command('enable')), null);
  assert.deepEqual(end('state_command', resting, command('enable')), { ok: true, text: 'done' });
  assert.equal(end('state_command', { ...resting, state: 'FAULT', faults: [{ number: 3002, name: 'drive_silent' }] }, command('enable'))?.ok, false);
  assert.equal(end('state_command', { ...resting, state: 'STOPPING' }, command('disable')), null);
  assert.equal(end('state_command', { ...resting, state: 'DISABLED' }, command('disable'))?.ok, true);
  const looked = (number: number) => ({ taken: { command: 'clear' }, events: [event({ kind: 'clear', number, text: 'faults not cleared, not met: drives' })] });
  assert.equal(end('state_command', resting, command('clear')), null);
  assert.equal(end('state_command', resting, looked(0))?.ok, true);
  assert.deepEqual(end('state_command', resting, looked(4)), { ok: false, text: 'faults not cleared, not met: drives' });
});

test('a retract is over when it says so, also with the faults that it is for', () => {
  const faults = [{ number: 5009, name: 'friction' }];
  assert.equal(end('retract', { ...resting, faults, retract: { phase: 'back' } }), null);
  assert.equal(end('retract', { ...resting, retract: { phase: 'done' } })?.ok, true);
  assert.deepEqual(end('retract', { ...resting, retract: { phase: 'ended', reason: 'hold' } }), { ok: false, text: 'ended: hold' });
});

test('motion is taken or given back when the state says who owns it', () => {
  assert.equal(end('acquire', resting, { is_mine: false }), null);
  assert.equal(end('acquire', resting)?.ok, true);
  assert.equal(end('release', resting), null);
  assert.equal(end('release', resting, { is_mine: false })?.ok, true);
});

test('nothing looks good that is only remembered', () => {
  assert.deepEqual(state_badge(resting, true), { text: 'ENABLED', look: 'good' });
  assert.deepEqual(state_badge(resting, false), { text: 'was ENABLED', look: 'stale' });
  assert.equal(state_badge({ state: 'FAULT' }, true).look, 'bad');
  assert.deepEqual(owner_badge(resting, true, false), { text: 'motion was: you', look: 'stale' });
  assert.deepEqual(owner_badge(resting, false, true), { text: 'motion: anna', look: '' });
});

test('alarms that are over or seen are not counted as alarms', () => {
  const alarm: Alarm = { key: 'x', priority: 1, title: 't', cause: 'c', todo: 'd', since_s: 0, is_active: true, acknowledged_by: '' };
  assert.deepEqual(alarm_badge([alarm, { ...alarm, key: 'y' }]), { text: '2 alarms', look: 'bad' });
  assert.deepEqual(alarm_badge([alarm, { ...alarm, is_active: false }]), { text: '1 alarm', look: 'bad' });
  assert.deepEqual(alarm_badge([{ ...alarm, is_active: false }]), { text: '1 over, not seen', look: '' });
  assert.equal(alarm_badge([{ ...alarm, acknowledged_by: 'anna' }]).text, '');
});

test('a name is what the gateway takes: 1 to 32 bytes, no control characters', () => {
  for (const good of ['anna', 'browser-3f2a', 'Zoe \u00e9']) assert.equal(name_problem(good), '');
  for (const bad of ['', 'a\nb', '\u20ac'.repeat(11)]) assert.match(name_problem(bad), /1 to 32 bytes/);
});

test('the largest motor current is named with its drive, the tick where there is real time', () => {
  const sample = sample_of({ 'drives.torque_permille': [120, -342, 80] }, resting);
  assert.equal(hardware_text(sample), 'Largest motor current 34 % of rated (node 2).');
  assert.match(hardware_text(sample_of({ 'drives.torque_permille': [0], tick_us: [143] }, resting)), /0 % of rated \(node 1\)\. Longest tick 143 us\.$/);
  assert.equal(hardware_text(sample_of({}, resting)), '');
});
