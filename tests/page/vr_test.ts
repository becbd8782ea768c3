import assert from 'node:assert/strict';
import { test } from 'node:test';
import { rotated } from '../../host/apps/web/src/model/vector';
import { nextNode, nextScale, VrButtons } from '../../host/apps/web/src/vr/buttons';
import { deviceFromHeadset, HandleSamples, UPRIGHT, type Handle } from '../../host/apps/web/src/vr/handles';
import { IntervalLog } from '../../host/apps/web/src/vr/interval_log';
import { near } from './support';

const handle = (position_m: [number, number, number], changes: Partial<Handle> = {}): Handle => ({ position_m, attitude: [1, 0, 0, 0], isTracked: true, deadman: 0, ...changes });

function isVector(actual: ArrayLike<number>, expected: number[]): void {
  expected.forEach((e, i) => assert.ok(near(actual[i], e, 1e-9), `${Array.from(actual)} is not ${expected}`));
}

test('what is before the person is along the base\u2019s x, what is to the right is along minus y, up is z', () => {
  isVector(rotated(UPRIGHT, [0, 0, -1]), [1, 0, 0]);
  isVector(rotated(UPRIGHT, [1, 0, 0]), [0, -1, 0]);
  isVector(rotated(UPRIGHT, [0, 1, 0]), [0, 0, 1]);
});

test('a hand that moves forward moves forward in the base as the person sees it after turning the world', () => {
  const device = deviceFromHeadset(Math.PI / 2); // looks along y now
  isVector(rotated(device, [0, 0, -1]), [0, 1, 0]);
  const samples = new HandleSamples();
  const first = samples.next(0, handle([0, 0, 0]), null, device).right.pose;
  const second = samples.next(11, handle([0, 0, -0.1]), null, device).right.pose;
  isVector(second.map((x, i) => x - first[i]).slice(0, 3), [0, 0.1, 0]);
});

test('a handle that is not tracked repeats its last pose and is not valid', () => {
  const samples = new HandleSamples();
  const seen = samples.next(0, handle([0, 1, 0], { deadman: 0.9 }), null, UPRIGHT);
  const lost = samples.next(11, handle([5, 5, 5], { isTracked: false, deadman: 0.9 }), null, UPRIGHT);
  assert.deepEqual([seen.right.valid, lost.right.valid, lost.left.valid], [true, false, false]);
  assert.deepEqual(lost.right.pose, seen.right.pose);
  assert.equal(lost.right.trigger, 0.9);
  assert.deepEqual(samples.next(22, null, null, UPRIGHT).right.pose, seen.right.pose);
});

// req:A32
test('after the headset was re-centred a handle is let go, and steers again after its trigger was open', () => {
  const samples = new HandleSamples();
  const held = (now_ms: number, right: number, left: number) =>
    samples.next(now_ms, handle([0, 1, 0], { deadman: right }), handle([0, 1, 0], { deadman: left }), UPRIGHT);
  held(0, 1, 1);
  samples.reset();
  const after = held(11, 1, 0.2);
  assert.deepEqual([after.right.trigger, after.right.stale, after.left.stale, samples.waits], [0, true, undefined, true]);
  assert.deepEqual([held(22, 1, 1).right.stale, held(33, 1, 1).left.trigger], [true, 1]);
  assert.deepEqual([held(44, 0, 1).right.stale, samples.waits], [undefined, false]);
  assert.equal(held(55, 1, 1).right.trigger, 1);
});

test('times of samples strictly increase, in microseconds', () => {
  const samples = new HandleSamples();
  const times = [1.5, 1.5, 1.4, 20].map((now_ms) => samples.next(now_ms, null, null, UPRIGHT).t_us);
  assert.deepEqual(times, [1500, 1501, 1502, 20000]);
});

// req:A24
test('below 50 samples a second there is an alarm, not at 90, and not before a second has passed', () => {
  const quick = new IntervalLog();
  for (let i = 0; i < 180; ++i) quick.sampled((1000 * i) / 90);
  assert.deepEqual(quick.conditions(1989), []);
  const slow = new IntervalLog();
  for (let i = 0; i < 90; ++i) slow.sampled(25 * i);
  assert.match(slow.conditions(2225)[0].title, /only 40 times/);
  assert.deepEqual([quick.framesPerPicture(1989), slow.framesPerPicture(2225)], [1, 3]); // handles before pictures
  const fresh = new IntervalLog();
  fresh.sampled(0);
  assert.deepEqual(fresh.conditions(500), []);
});

test('the log of intervals keeps a minute', () => {
  const log = new IntervalLog();
  for (let i = 0; i < 7000; ++i) log.sampled(10 * i);
  assert.equal(log.intervals_ms().length, 6000);
  assert.ok(log.csv().startsWith('interval_ms\n10.00\n'));
});

test('a button acts once when it goes down', () => {
  const buttons = new VrButtons();
  const pad = (down: number[]) => ({ buttons: Array.from({ length: 6 }, (_, i) => ({ pressed: down.includes(i) })) });
  assert.deepEqual(buttons.pressed('right', pad([5])), ['stop']);
  assert.deepEqual(buttons.pressed('right', pad([5])), []);
  assert.deepEqual(buttons.pressed('left', pad([4, 5])), ['mode', 'scale']);
  assert.deepEqual(buttons.pressed('right', null), []);
  assert.deepEqual(buttons.pressed('right', pad([4, 5])), ['hold', 'stop']);
});

test('scales and nodes go around', () => {
  assert.deepEqual([0.5, 1, 2, 4].map(nextScale), [1, 2, 4, 0.5]);
  assert.deepEqual([0, 1, 2, 3, 4].map((n) => nextNode(n, 4)), [1, 2, 3, 4, 0]);
});
