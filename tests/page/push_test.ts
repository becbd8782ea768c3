import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Facts, Push } from '../../host/apps/web/src/data/sample';
import { derivedEvents, withDerivedEvents } from '../../host/apps/web/src/data/derived_events';
import { Live } from '../../host/apps/web/src/live/live';
import type { Welcome } from '../../host/apps/web/src/live/protocol';
import { isAtSite, payloadPlace } from '../../host/apps/web/src/model/payload_place';
import { pushLines } from '../../host/apps/web/src/model/force_control_text';
import type { Scene, ScenePose } from '../../host/apps/web/src/model/robot';
import { weightOf } from '../../host/apps/web/src/model/weight';
import { groupsOf } from '../../host/apps/web/src/plots/groups';
import { ARM, MICRO, sampleOf } from './support';

const noPush: Push = { number: 0, phase: 'none', end: 'none', law: 'force', touched: false, wrist: 'silent' };
const pressing: Push = { ...noPush, number: 1, phase: 'pressing', touched: true, wrist: 'good' };
const open = { captured: false, latch: 'open', lock: 'open' };
const servoing = { phase: 'approaching', target: 'adapter', reason: '' };
// What a record holds of a push in its adapter.
const NUMBERS = {
  'insert.measured_wrench.force_N': [0.3, -0.4, -20], 'insert.measured_wrench.torque_Nm': [0, 3, 4], 'insert.applied_force.force_N': [-0.3, 0.4, 20],
  'insert.force_setpoint_N': [30], 'insert.travel_m': [0.012], 'insert.lateral_m': [0.0004], 'adapter.depth_m': [0.0015, 0.001, 0.0021],
  'servo.error_m': [0.003, 0, 0.004], 'servo.error_deg': [0, 0.1, 0], 'servo.sway_m': [0.014],
};
const place: ScenePose = { position_m: [0, 0, 0], quaternion_wxyz: [1, 0, 0, 0] };
const scene: Scene = { name: 's', payload: { ...place, start: 'mechanism', length_m: 1, radius_m: 0.3 }, adapter: place };
// As states of arms that have nothing to push with say it.
const bare: Facts = {
  insert: noPush, adapter: open, payload: { mass_kg: 0 }, servo: { ...servoing, phase: 'standby', target: '' },
};

function lines(facts: Facts, numbers: Record<string, number[]> = NUMBERS): Record<string, string> {
  return Object.fromEntries(pushLines(sampleOf(numbers, facts), scene));
}

test('an arm without wrist sensor, adapter and servo has no words of them', () => {
  const none = Object.fromEntries(Object.entries(NUMBERS).map(([name, numbers]) => [name, numbers.map(() => NaN)]));
  for (const facts of [{}, bare]) {
    for (const numbers of [{}, none])
      assert.ok(pushLines(sampleOf(numbers, facts), { name: 'none' }).every(([, text]) => text === ''));
  }
});

test('strips of force and push are there for fields that are', () => {
  const names = (fields: string[]) => groupsOf(MICRO, { name: 'x' }, (field) => fields.includes(field)).map((group) => group.name);
  assert.deepEqual(names(['measured_js_deg']), ['angles']);
  const fields = ['insert.measured_wrench.force_N', 'insert.force_setpoint_N', 'adapter.depth_m', 'servo.error_m'];
  assert.deepEqual(names(fields), ['wrist force', 'push', 'insertion', 'servo']);
});

test('a push is told by its phase, set force, way and whether it touches; the adapter by what it says', () => {
  const { push, adapter, wrist, servo } = lines({ insert: pressing, adapter: open, servo: servoing });
  assert.equal(push, '1 pressing, set 30.0 N, gives 20.0 N, 12.0 mm on, 0.4 mm aside, touches');
  assert.equal(adapter, 'not captured, latch open, lock open, pins 1.5, 1.0, 2.1 mm in');
  assert.equal(wrist, '20.0 N (0.3, -0.4, -20.0), 5.0 N m (0.0, 3.0, 4.0), good');
  assert.equal(servo, 'to the adapter: approaching, 5.0 mm and 0.10 deg to go, the target swings by 14.0 mm');
  const ended = lines({ insert: { ...pressing, end: 'early_capture', phase: 'yielding' } });
  assert.match(ended.push, /^1 ended: early capture, yielding, set/);
});

test('numbers that a run of an older version lacks are left out of the words, whether null or missing', () => {
  const facts = { insert: pressing, adapter: open, servo: servoing };
  const named = (name: string) => Object.fromEntries(Object.entries(NUMBERS).filter(([each]) => each !== name));
  const nulls = Object.fromEntries(Object.entries(NUMBERS).map(([name, numbers]) => [name, numbers.map(() => NaN)]));
  for (const numbers of [{}, nulls]) {
    const { push, adapter, wrist, servo } = lines(facts, numbers);
    assert.deepEqual([push, adapter, wrist, servo], ['1 pressing, touches', '', '', 'to the adapter: approaching']);
  }
  for (const name of Object.keys(NUMBERS)) {
    for (const numbers of [named(name), { ...NUMBERS, [name]: nulls[name] }])
      assert.ok(!/NaN|undefined|\?/.test(Object.values(lines(facts, numbers)).join('\n')), name);
  }
  assert.equal(lines(facts, named('insert.force_setpoint_N')).push, '1 pressing, gives 20.0 N, 12.0 mm on, 0.4 mm aside, touches');
  assert.match(lines(facts, { ...NUMBERS, 'adapter.depth_m': [0.0015, NaN, 0.0021] }).adapter, /pins 1.5, \u2013, 2.1 mm in/);
});

test('the payload is in the mechanism, then on the tip, then in the adapter', () => {
  const carried = { payload: { mass_kg: 500 } };
  assert.equal(lines(bare).payload, 'in the transfer mechanism');
  assert.equal(payloadPlace({ ...bare, tool: { command: 'grapple', phase: 'acting' } }, scene), 'mechanism');
  assert.equal(payloadPlace({ ...bare, tool: { command: 'grapple', phase: 'done' } }, scene), 'tip');
  assert.equal(lines(carried).payload, 'on the tip, the arm carries 500 kg');
  const locked = lines({ ...carried, adapter: { ...open, captured: true, lock: 'closed' } });
  assert.equal(locked.payload, 'on the tip, locked in the adapter, the arm carries 500 kg');
  assert.equal(lines({ tool: { command: 'release', phase: 'done' } }).payload, 'in the adapter, released');
  assert.equal(payloadPlace({}, { ...scene, payload: { ...scene.payload!, start: 'arm' } }), 'tip');
});

test('the adapter is there once the large arm has carried the small one to it', () => {
  const fetched: Scene = { ...scene, payload: { ...scene.payload!, fetch_pose: 'fetch' } };
  const onLarge = { ...MICRO, base: { pose: 'install' } };
  assert.ok(isAtSite(bare, scene, onLarge));
  assert.ok(isAtSite(bare, fetched, MICRO), 'it stands firm');
  assert.ok(!isAtSite({ ...bare, tool: { command: 'grapple', phase: 'done' } }, fetched, onLarge));
  assert.ok(!isAtSite({ ...bare, tool: { command: 'carry', phase: 'acting' } }, fetched, onLarge));
  assert.ok(isAtSite({ ...bare, tool: { command: 'carry', phase: 'done' } }, fetched, onLarge));
});

function told(before: Facts, now: Facts): string[] {
  return derivedEvents(before, now, 7, 3).map((e) => `${e.kind}: ${e.text}${weightOf(e) === 'note' ? '' : '!'}`);
}

test('what changes of servo, push and adapter are events, and those that went wrong are warnings', () => {
  const captured: Push = { ...pressing, phase: 'unloading', end: 'captured' };
  assert.deepEqual(told({ insert: { ...pressing, touched: false } }, { insert: pressing }), ['push: push 1: touches']);
  assert.deepEqual(told({ insert: pressing }, { insert: { ...pressing } }), []);
  const hasIt = { ...open, captured: true, latch: 'closing' };
  assert.deepEqual(told({ insert: pressing, adapter: open }, { insert: captured, adapter: hasIt }),
    ['push: push 1 ended: captured', 'push: push 1: unloading', 'adapter: captured', 'adapter: latch closing']);
  const failed: Push = { ...pressing, phase: 'yielding', end: 'aside', wrist: 'failed' };
  assert.deepEqual(told({ insert: pressing }, { insert: failed }),
    ['push: push 1 ended: aside!', 'push: push 1: yielding', 'wrist: wrist sensor: failed!']);
  const second = { ...pressing, number: 2, touched: false };
  assert.deepEqual(told({ insert: captured }, { insert: second }), ['push: push 2: pressing']);
  const late = { ...servoing, phase: 'timed_out', reason: 'too long' };
  assert.deepEqual(told({ servo: servoing }, { servo: late }), ['servo: servo to adapter: timed out: too long!']);
  assert.deepEqual(told({ payload: { mass_kg: 0 } }, { payload: { mass_kg: 500 } }), ['payload: carries 500 kg']);
});

test('nothing has changed where the state before is not known', () => {
  assert.deepEqual(told({}, { insert: pressing, adapter: open, servo: servoing, payload: { mass_kg: 500 } }), []);
});

test('events made of facts stand between the others by their ticks', () => {
  const event = { sequence: 1, tick: 20, kind: 'step', number: 1, subject: '', values: {}, text: 'step 1' };
  const pushes = [noPush, pressing, { ...pressing, phase: 'unloading' }];
  const facts = pushes.map((push, i) => ({ tick: 10 + 15 * i, state: { insert: push } }));
  const all = withDerivedEvents([event], facts).map((e) => [e.tick, e.kind]);
  assert.deepEqual(all, [[20, 'step'], [25, 'push'], [25, 'push'], [25, 'wrist'], [40, 'push']]);
});

function record(tick: number, set_N: number): ArrayBuffer {
  const view = new DataView(new ArrayBuffer(28));
  view.setUint32(0, tick, true);
  view.setFloat64(8, tick, true);
  view.setFloat32(24, set_N, true);
  return view.buffer;
}

test('live, a number is known from its first value on, and changes of facts are events', () => {
  const live = new Live();
  const fields = [{ name: 'insert.force_setpoint_N', unit: 'N', offset: 24, count: 1 }];
  live.takeWelcome({ robot: ARM, scene, layout: { version: 1, bytes: 28, fields } } as unknown as Welcome);
  live.take({ op: 'facts', facts: 1, state: bare });
  live.takeRecord(record(5, NaN), 0.02);
  assert.equal(live.history!.known.size, 0);
  live.take({ op: 'facts', facts: 2, state: { ...bare, insert: pressing } });
  live.takeRecord(record(10, 30), 0.04);
  assert.ok(live.history!.known.has('insert.force_setpoint_N'));
  assert.deepEqual(live.events.map((e) => [e.kind, e.tick]), [['push', 5], ['push', 5], ['wrist', 5]]);
});
