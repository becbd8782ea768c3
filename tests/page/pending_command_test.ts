import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Facts, LianaEvent } from '../../host/apps/web/src/data/sample';
import { nameProblem } from '../../host/apps/web/src/live/display_name';
import type { Alarm } from '../../host/apps/web/src/model/alarms';
import { alarmBadge, deviceBadge, ownerBadge, stateBadge } from '../../host/apps/web/src/model/badges';
import { endingOf, refusalText, type Ending, type Taken } from '../../host/apps/web/src/model/outcome_text';
import { hardwareText } from '../../host/apps/web/src/model/hardware';
import { ARM, MICRO, sampleOf } from './support';

const resting: Facts = { state: 'ENABLED', at_rest: true, is_busy: false, faults: [], stop: null, owner: 'anna' };
const moving: Facts = { ...resting, at_rest: false, is_busy: true };
const event = (changes: Partial<LianaEvent>): LianaEvent => ({ sequence: 8, tick: 500, kind: 'verdict', number: 208, subject: 'simulation', values: {}, text: 'link 27 and the wall', ...changes });

function end(op: string, facts: Facts, more: { taken?: Partial<Taken>; events?: LianaEvent[]; isMine?: boolean; after_s?: number } = {}): Ending | null {
  const taken = { op, time_s: 2, lastEvent: 7, ...more.taken };
  return endingOf(taken, { time_s: 2 + (more.after_s ?? 1), facts, isMine: more.isMine ?? true, events: more.events ?? [] });
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
  assert.match(refusalText(event({ kind: 'path', number: 0 })), /^refused: .*\[207 /);
  assert.equal(refusalText(event({ kind: 'step' })), '');
});

test('a motion that stop, fault, another owner or a disabled arm ended is not done', () => {
  assert.match(end('move_cp', { ...moving, stop: { by: 'ben', reason: '', tick: 1 } })!.text, /emergency stop of ben/);
  assert.match(end('move_cp', { ...moving, faults: [{ number: 5006, name: 'cable_break' }] })!.text, /fault 5006 cable break/);
  assert.match(end('move_cp', moving, { isMine: false })!.text, /no longer yours/);
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
  assert.equal(end('acquire', resting, { isMine: false }), null);
  assert.equal(end('acquire', resting)?.ok, true);
  assert.equal(end('release', resting), null);
  assert.equal(end('release', resting, { isMine: false })?.ok, true);
});

test('nothing looks good that is only remembered', () => {
  assert.deepEqual(stateBadge(resting, true), { text: 'ENABLED', look: 'good' });
  assert.deepEqual(stateBadge(resting, false), { text: 'was ENABLED', look: 'stale' });
  assert.equal(stateBadge({ state: 'FAULT' }, true).look, 'bad');
  assert.deepEqual(ownerBadge(resting, true, false), { text: 'motion was: you', look: 'stale' });
  assert.deepEqual(ownerBadge(resting, false, true), { text: 'motion: anna', look: '' });
});

test('the input device is named with what it does, and says when it is let go, silent or only remembered', () => {
  const vr = { ...resting, device: 'vr', device_engaged: true };
  assert.deepEqual(deviceBadge(vr, 90, true), { text: 'vr: moves the arm', look: 'good' });
  assert.deepEqual(deviceBadge({ ...vr, device_engaged: false }, 90, true), { text: 'vr: clutch open', look: '' });
  assert.equal(deviceBadge(vr, 0, true).look, 'bad');
  assert.deepEqual(deviceBadge({ ...vr, device_reason: 'device silent' }, 0, true), { text: 'vr let go: device silent', look: 'bad' });
  assert.equal(deviceBadge({ ...resting, device: 'none', device_reason: 'device silent' }, 0, true).look, 'bad');
  assert.deepEqual(deviceBadge(vr, 90, false), { text: 'device was: vr', look: 'stale' });
  assert.deepEqual(deviceBadge({ ...resting, device: 'none' }, 0, true), { text: '', look: '' });
});

test('alarms that are over or seen are not counted as alarms', () => {
  const alarm: Alarm = { key: 'x', priority: 1, title: 't', cause: 'c', todo: 'd', since_s: 0, isActive: true, acknowledgedBy: '' };
  assert.deepEqual(alarmBadge([alarm, { ...alarm, key: 'y' }]), { text: '2 alarms', look: 'bad' });
  assert.deepEqual(alarmBadge([alarm, { ...alarm, isActive: false }]), { text: '1 alarm', look: 'bad' });
  assert.deepEqual(alarmBadge([{ ...alarm, isActive: false }]), { text: '1 over, not seen', look: '' });
  assert.equal(alarmBadge([{ ...alarm, acknowledgedBy: 'anna' }]).text, '');
});

test('a name is what the gateway takes: 1 to 32 bytes, no control characters', () => {
  for (const good of ['anna', 'browser-3f2a', 'Zoe \u00e9']) assert.equal(nameProblem(good), '');
  for (const bad of ['', 'a\nb', '\u20ac'.repeat(11)]) assert.match(nameProblem(bad), /1 to 32 bytes/);
});

test('the largest motor current is named with its drive, the tick where there is real time', () => {
  const sample = sampleOf({ 'drives.torque_permille': [120, -342, 80] }, resting);
  assert.equal(hardwareText(sample, ARM), 'Largest motor current 34 % of rated, drive 2 (node 2, segment 1).');
  assert.match(hardwareText(sampleOf({ 'drives.torque_permille': [0], tick_us: [143] }, resting), MICRO), /0 % of rated, drive 1 \(node 1\)\. Longest tick 143 us\.$/);
  assert.equal(hardwareText(sampleOf({}, resting), ARM), '');
});
