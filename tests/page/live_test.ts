import assert from 'node:assert/strict';
import { webcrypto } from 'node:crypto';
import { test } from 'node:test';
import type { Layout } from '../../host/apps/web/src/data/record';
import { History } from '../../host/apps/web/src/live/history';
import { creditOf, proofOf } from '../../host/apps/web/src/live/protocol';
import { Rate } from '../../host/apps/web/src/live/rate';
import { StateAge } from '../../host/apps/web/src/live/state_age';
import { AlarmBook, conditionsOf, type Condition } from '../../host/apps/web/src/model/alarms';
import { driveText, lostCables, placesText } from '../../host/apps/web/src/model/drive_names';
import { missionCommands } from '../../host/apps/web/src/steer/mission_panel';
import { ARM, MICRO, near } from './support';

if (!('crypto' in globalThis)) Object.assign(globalThis, { crypto: webcrypto }); // Node 18

test('the credit of a record is its sequence, little-endian', () => {
  assert.deepEqual([...new Uint8Array(creditOf(0x01020304))], [4, 3, 2, 1]);
});

test('the proof is the HMAC-SHA256 of the nonce as text, in hex', async () => {
  // RFC 4231, test case 2.
  assert.equal(await proofOf('Jefe', 'what do ya want for nothing?'), '5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843');
});

test('a minute of records is kept, the oldest go', () => {
  const layout: Layout = { version: 1, bytes: 36, fields: [{ name: 'a', unit: '1', offset: 24, count: 2 }, { name: 'b', unit: '1', offset: 32, count: 1 }] };
  const history = new History(layout);
  for (let i = 0; i < 3100; ++i) history.add(5 * i, i / 50, new Map([['a', Float32Array.of(i, -i)], ['b', Float32Array.of(i / 2)]]));
  assert.equal(history.rows, 3000);
  assert.equal(history.time_s(0), 2);
  assert.equal(history.tick(2999), 5 * 3099);
  assert.equal(history.value(0, 'a', 1), -100);
  assert.ok(Number.isNaN(history.value(0, 'c', 0)));
  const back = new Map([['a', new Float32Array(2)], ['b', new Float32Array(1)]]);
  history.read(2999, back);
  assert.deepEqual([...back.get('a')!, ...back.get('b')!], [3099, -3099, 1549.5]);
});

test('the age of a state is how late it came against the quickest, and how long ago', () => {
  const age = new StateAge();
  assert.ok(Number.isNaN(age.age_s(1)));
  for (let i = 0; i < 10; ++i) age.came(i * 0.02, 100 + i * 0.02);
  assert.ok(near(age.age_s(100.2), 0.02, 1e-9));
  age.came(0.2, 100.28); // 80 ms late
  assert.ok(near(age.age_s(100.3), 0.1, 1e-9));
});

test('a rate counts what happened in the last second', () => {
  const rate = new Rate();
  for (let i = 0; i < 90; ++i) rate.add(i / 90);
  assert.equal(rate.perSecond(89 / 90), 90);
  assert.equal(rate.perSecond(3), 0);
});

const slow: Condition = { key: 'x', priority: 2, title: 't', cause: 'c', todo: 'd' };

test('an alarm that comes and goes within moments is not shown, and one that is shown does not flicker', () => {
  const book = new AlarmBook();
  book.update([slow], 0);
  assert.equal(book.list().length, 0); // not yet
  book.update([], 0.1);
  book.update([slow], 0.4);
  assert.equal(book.list().length, 0); // it had begun anew
  book.update([slow], 1.0);
  assert.equal(book.list().length, 1);
  for (let now_s = 1.1; now_s < 6; now_s += 0.2) {
    const flickers = Math.round(now_s * 10) % 4 < 2;
    assert.equal(book.update(flickers ? [slow] : [], now_s), false, `at ${now_s}`);
  }
});

test('an alarm that is over stays until somebody has seen it; one that was seen goes with its cause', () => {
  const book = new AlarmBook();
  const hard = { ...slow, key: 'y', priority: 1 as const };
  book.update([hard], 0);
  assert.equal(book.list()[0].isActive, true); // at once
  book.update([], 10);
  assert.deepEqual([book.list()[0].isActive, book.list()[0].acknowledgedBy], [false, '']);
  book.acknowledge('y', 'anna');
  assert.equal(book.list().length, 0);
  book.update([hard], 20);
  book.acknowledge('y', 'anna');
  assert.equal(book.list()[0].acknowledgedBy, 'anna');
  book.update([], 24);
  assert.equal(book.list().length, 0);
});

test('what has come back has to be seen anew', () => {
  const book = new AlarmBook();
  const hard = { ...slow, priority: 1 as const };
  book.update([hard], 0);
  book.update([], 4);
  book.update([hard], 5);
  assert.deepEqual([book.list()[0].isActive, book.list()[0].since_s], [true, 5]);
});

test('fifteen silent drives are one alarm with the remedy of the fault table, before what matters less', () => {
  const faults = Array.from({ length: 15 }, (_, i) => ({ number: 3002, name: 'drive_silent', where: driveText(i, ARM) }));
  const book = new AlarmBook();
  const clearance = { body: 'wall', confidence: 'camera', camera: 'none', level: 'slow' };
  for (const now_s of [0, 1]) book.update(conditionsOf({ faults, clearance }), now_s);
  const [first, second] = book.list();
  assert.equal(book.list().length, 2);
  assert.match(first.title, /^3002 drive silent: drives 1, 2, 3/);
  assert.match(first.todo, /Check the bus for errors and load/);
  assert.match(second.title, /close to the wall/);
});

test('a fault and its consequences are one alarm, and so are a loose plug and its bus', () => {
  const where = driveText(4, ARM);
  const faults = [
    { number: 3002, name: 'drive_silent', where, cause: null },
    { number: 3001, name: 'drive_missing', where, cause: 0 },
    { number: 3008, name: 'drive_stop_timeout', where, cause: 0 },
  ];
  const buses = [{ name: 'can0', state: 'error_passive' }];
  const [plug, ...others] = conditionsOf({ faults, buses });
  assert.deepEqual([plug.key, others.length], ['fault 3002', 0]);
  assert.equal(plug.follows?.length, 3);
  const twoCauses = conditionsOf({ faults: [...faults, { number: 5002, name: 'cable_overload', where, cause: null }] });
  assert.deepEqual(twoCauses.map((each) => [each.key, each.follows?.length]), [['fault 3002', 2], ['fault 5002', 0]]);
});

test('alarms are acknowledged together, and one that is over stands below those that are not', () => {
  const book = new AlarmBook();
  const first = { ...slow, key: 'first', priority: 1 as const };
  const second = { ...slow, key: 'second', priority: 1 as const };
  book.update([first, second], 0);
  book.update([second], 4);
  assert.deepEqual(book.list().map((each) => each.key), ['second', 'first']);
  book.acknowledgeAll('anna');
  assert.deepEqual(book.list().map((each) => [each.key, each.acknowledgedBy]), [['second', 'anna']]);
});

test('an arm that goes back without a cable says so, and what the next command is', () => {
  const recovery = { where: driveText(4, ARM), next: 'liana recover goes on', recovers: true };
  assert.deepEqual(conditionsOf({ recovery }).map((each) => [each.key, each.todo]), [['recovery', 'liana recover goes on']]);
  assert.deepEqual(conditionsOf({ recovery: { ...recovery, recovers: false } }), []);
});

test('a cable that broke is lost while its fault is latched and on the way back after it', () => {
  assert.deepEqual(lostCables({ faults: [{ number: 5006, name: 'cable_break', index: 4 }, { number: 3002, name: 'drive_silent', index: 2 }] }), [4]);
  assert.deepEqual(lostCables({ faults: [], recovery: { cables: [5], where: '', next: '', recovers: true } }), [4]);
  assert.deepEqual(lostCables({ recovery: null }), []);
});

test('a mission that waits is shown with what can be done, and one that runs can pause', () => {
  const step = { index: 2, name: 'cover', device: 'none' };
  const commands = (waits: string | null) => missionCommands({ step: { ...step, waits } });
  assert.deepEqual(commands('confirm: cover removed'), ['confirm', 'abort']);
  assert.deepEqual(commands('paused: people'), ['resume', 'step', 'abort']);
  assert.deepEqual(commands(null), ['pause', 'abort']);
  assert.deepEqual(missionCommands({ step: null }), []);
  assert.deepEqual(conditionsOf({ step: { ...step, waits: 'confirm: cover removed' } }).map((each) => [each.key, each.cause]), [['mission', 'confirm: cover removed']]);
});

test('drives count from 1, with node and segment', () => {
  assert.equal(driveText(3, ARM), 'drive 4 (node 4, segment 2)');
  assert.equal(driveText(3, MICRO), 'drive 4 (node 4)');
  assert.equal(placesText([driveText(3, ARM), driveText(4, ARM)]), 'drives 4 (node 4, segment 2) and 5 (node 5, segment 2)');
  assert.equal(placesText(['bus can0', driveText(0, MICRO)]), 'bus can0 and drive 1 (node 1)');
});

test('an alarm that passes by itself is gone 3 s after its cause, seen or not', () => {
  const book = new AlarmBook();
  book.update([{ ...slow, priority: 1, passes: true }], 0);
  book.update([], 2);
  assert.equal(book.list().length, 1);
  book.update([], 4);
  assert.equal(book.list().length, 0);
});
