import assert from 'node:assert/strict';
import { test } from 'node:test';
import { csv_of } from '../../host/page/src/data/csv';
import { fact_columns, kFactFields, read_fact_numbers } from '../../host/page/src/data/fact_numbers';
import { Run, type RunHead } from '../../host/page/src/data/run';
import type { Facts, Push, Sample } from '../../host/page/src/data/sample';
import { told_changes, with_told_changes } from '../../host/page/src/data/told_changes';
import { Live } from '../../host/page/src/live/live';
import type { Welcome } from '../../host/page/src/live/protocol';
import { payload_place } from '../../host/page/src/model/payload_place';
import { push_lines } from '../../host/page/src/model/push_words';
import type { Scene, ScenePose } from '../../host/page/src/model/robot';
import { weight_of } from '../../host/page/src/model/weight';
import { groups_of } from '../../host/page/src/plots/groups';
import { kArm, kMicro } from './support';

const still = { force_N: [0, 0, 0], torque_Nm: [0, 0, 0] };
const no_push: Push = {
  number: 0, phase: 'none', end: 'none', law: 'force', set_N: 0, given: still, felt: still,
  touched: false, travel_m: 0, aside_m: 0, wrist: 'silent', wrist_age_s: null,
};
const felt = { force_N: [0.3, -0.4, -20], torque_Nm: [0, 3, 4] };
const given = { force_N: [-0.3, 0.4, 20], torque_Nm: [0, -3, -4] };
const pressing: Push = {
  ...no_push, number: 1, phase: 'pressing', set_N: 30, given, felt,
  touched: true, travel_m: 0.012, aside_m: 0.0004, wrist: 'good', wrist_age_s: 0,
};
const open = { age_s: 0.004, captured: false, latch: 'open', lock: 'open', depth_m: [0.0015, 0.001, 0.0021] };
const left = { error_m: [0.003, 0, 0.004], error_deg: [0, 0.1, 0] };
const servoing = { phase: 'approaching', target: 'adapter', ...left, swing_m: 0.014, reason: '' };
const place: ScenePose = { position_m: [0, 0, 0], quaternion_wxyz: [1, 0, 0, 0] };
const scene: Scene = { name: 's', payload: { ...place, start: 'mechanism', length_m: 1 }, adapter: place };
// As states of arms that have nothing to push with say it.
const bare: Facts = {
  push: no_push, adapter: { ...open, age_s: null }, payload: { mass_kg: 0 }, servo: { ...servoing, phase: 'standby', target: '' },
};

function sample(facts: Facts): Sample {
  const numbers = new Map(kFactFields.map(({ name, count }) => [name, new Float32Array(count)]));
  read_fact_numbers(facts, numbers);
  return { tick: 0, time_s: 0, numbers, facts };
}

const lines = (facts: Facts, of: Scene = scene) => Object.fromEntries(push_lines(sample(facts), of));

test('wrench, set force, way in and what the servo has left to go are numbers of a state', () => {
  const { numbers } = sample({ push: pressing, adapter: open, servo: servoing });
  assert.deepEqual([...numbers.get('push.felt.force_N')!], [...Float32Array.from(felt.force_N)]);
  assert.deepEqual([...numbers.get('push.felt.torque_Nm')!, ...numbers.get('push.set_N')!], [0, 3, 4, 30]);
  assert.deepEqual([...numbers.get('adapter.depth_m')!], [...Float32Array.from(open.depth_m)]);
  assert.deepEqual([...numbers.get('servo.error_m')!], [...Float32Array.from(servoing.error_m)]);
});

test('an arm without wrist sensor, adapter and servo has no such numbers, no strips and no words of them', () => {
  for (const facts of [{}, bare]) {
    assert.ok([...sample(facts).numbers.values()].every((values) => values.every(Number.isNaN)));
    assert.equal(fact_columns(2, () => facts).size, 0);
    assert.ok(push_lines(sample(facts), { name: 'none' }).every(([, text]) => text === ''));
  }
});

test('a servo that is over has nothing left to go', () => {
  assert.ok(Number.isNaN(sample({ servo: { ...servoing, phase: 'done' } }).numbers.get('servo.error_m')![0]));
});

test('strips of force and push are there for fields that are', () => {
  const names = (fields: string[]) => groups_of(kMicro, (field) => fields.includes(field)).map((group) => group.name);
  assert.deepEqual(names(['measured_js_deg']), ['angles']);
  const fields = ['push.felt.force_N', 'push.set_N', 'adapter.depth_m', 'servo.error_m'];
  assert.deepEqual(names(fields), ['wrist force', 'push', 'insertion', 'servo']);
});

test('a push is told by its phase, set force, way and whether it touches; the adapter by what it says', () => {
  const { push, adapter, wrist, servo } = lines({ push: pressing, adapter: open, servo: servoing });
  assert.equal(push, '1 pressing, set 30.0 N, gives 20.0 N, 12.0 mm on, 0.4 mm aside, touches');
  assert.equal(adapter, 'not captured, latch open, lock open, pins 1.5, 1.0, 2.1 mm in');
  assert.equal(wrist, '20.0 N (0.3, -0.4, -20.0), 5.0 N m (0.0, 3.0, 4.0), good');
  assert.equal(servo, 'to the adapter: approaching, 5.0 mm and 0.10 deg to go, the target swings by 14.0 mm');
  const ended = lines({ push: { ...pressing, end: 'early_capture', phase: 'yielding' } });
  assert.match(ended.push, /^1 ended: early capture, yielding, set/);
});

test('the payload is in the mechanism, then on the tip, then in the adapter', () => {
  const carried = { payload: { mass_kg: 500 } };
  assert.equal(lines(bare).payload, 'in the transfer mechanism');
  assert.equal(payload_place({ ...bare, tool: { command: 'grapple', phase: 'acting' } }, scene), 'mechanism');
  assert.equal(payload_place({ ...bare, tool: { command: 'grapple', phase: 'done' } }, scene), 'tip');
  assert.equal(lines(carried).payload, 'on the tip, the arm carries 500 kg');
  const locked = lines({ ...carried, adapter: { ...open, captured: true, lock: 'closed' } });
  assert.equal(locked.payload, 'on the tip, locked in the adapter, the arm carries 500 kg');
  assert.equal(lines({ tool: { command: 'release', phase: 'done' } }).payload, 'in the adapter, released');
  assert.equal(payload_place({}, { ...scene, payload: { ...scene.payload!, start: 'arm' } }), 'tip');
});

function told(before: Facts, now: Facts): string[] {
  return told_changes(before, now, 7, 3).map((e) => `${e.kind}: ${e.text}${weight_of(e) === 'note' ? '' : '!'}`);
}

test('what changes of servo, push and adapter are events, and those that went wrong are warnings', () => {
  const captured: Push = { ...pressing, phase: 'unloading', end: 'captured' };
  assert.deepEqual(told({ push: { ...pressing, touched: false } }, { push: pressing }), ['push: push 1: touches']);
  assert.deepEqual(told({ push: pressing }, { push: { ...pressing, set_N: 20 } }), []);
  const has_it = { ...open, captured: true, latch: 'closing' };
  assert.deepEqual(told({ push: pressing, adapter: open }, { push: captured, adapter: has_it }),
    ['push: push 1 ended: captured', 'push: push 1: unloading', 'adapter: captured', 'adapter: latch closing']);
  const failed: Push = { ...pressing, phase: 'yielding', end: 'aside', wrist: 'failed' };
  assert.deepEqual(told({ push: pressing }, { push: failed }),
    ['push: push 1 ended: aside!', 'push: push 1: yielding', 'wrist: wrist sensor: failed!']);
  const second = { ...pressing, number: 2, touched: false };
  assert.deepEqual(told({ push: captured }, { push: second }), ['push: push 2: pressing']);
  const late = { ...servoing, phase: 'timed_out', reason: 'too long' };
  assert.deepEqual(told({ servo: servoing }, { servo: late }), ['servo: servo to adapter: timed out: too long!']);
  assert.deepEqual(told({ payload: { mass_kg: 0 } }, { payload: { mass_kg: 500 } }), ['payload: carries 500 kg']);
});

test('nothing has changed where the state before is not known', () => {
  assert.deepEqual(told({}, { push: pressing, adapter: open, servo: servoing, payload: { mass_kg: 500 } }), []);
});

test('events made of facts stand between the others by their ticks', () => {
  const event = { sequence: 1, tick: 20, kind: 'step', number: 1, subject: '', values: {}, text: 'step 1' };
  const pushes = [no_push, pressing, { ...pressing, phase: 'unloading' }];
  const facts = pushes.map((push, i) => ({ tick: 10 + 15 * i, state: { push } }));
  const all = with_told_changes([event], facts).map((e) => [e.tick, e.kind]);
  assert.deepEqual(all, [[20, 'step'], [25, 'push'], [25, 'push'], [25, 'wrist'], [40, 'push']]);
});

test('a run has the numbers of its facts as columns, in its moments and in its table', () => {
  const facts = [{ tick: 10, state: { push: no_push } }, { tick: 15, state: { push: pressing } }];
  const telemetry = { rows: 2, ticks: { first: 10, every: 5 }, columns: [] };
  const head: RunHead = {
    format: 1, title: '', robot: kMicro, scene, report: null, period_s: 0.004,
    steps: [], events: [], commands: [], facts, telemetry,
  };
  const run = new Run(head, new Uint8Array(0));
  assert.ok(Number.isNaN(run.at(0).numbers.get('push.set_N')![0]));
  assert.equal(run.at(1).numbers.get('push.set_N')![0], 30);
  assert.equal(run.telemetry.columns.has('servo.error_m'), false);
  const [names, , last] = csv_of(run, 0, 1).split('\n');
  assert.equal(last.split(',')[names.split(',').indexOf('push.felt.force_N[2] [N]')], '-20');
  assert.equal(run.events.length, 3);
});

function record(tick: number): ArrayBuffer {
  const view = new DataView(new ArrayBuffer(24));
  view.setUint32(0, tick, true);
  view.setFloat64(8, tick, true);
  return view.buffer;
}

test('live, numbers of facts go with the next record, are kept a minute, and changes of them are events', () => {
  const live = new Live();
  live.take_welcome({ robot: kArm, scene, layout: { version: 1, bytes: 24, fields: [] } } as unknown as Welcome);
  live.take({ op: 'facts', facts: 1, state: bare });
  live.take_record(record(5), 0.02);
  assert.equal(live.history!.known.size, 0);
  live.take({ op: 'facts', facts: 2, state: { ...bare, push: pressing } });
  live.take_record(record(10), 0.04);
  assert.equal(live.history!.value(1, 'push.set_N', 0), 30);
  assert.ok(live.history!.known.has('push.felt.force_N') && !live.history!.known.has('adapter.depth_m'));
  assert.equal(live.sample!.numbers.get('push.felt.torque_Nm')![2], 4);
  assert.deepEqual(live.events.map((e) => [e.kind, e.tick]), [['push', 5], ['push', 5], ['wrist', 5]]);
});
