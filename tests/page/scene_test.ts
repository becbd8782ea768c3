import assert from 'node:assert/strict';
import { test } from 'node:test';
import { pitchBudget } from '../../host/apps/web/src/model/pitch_budget';
import { deviationText, distanceLines, mainDistance, slowdownText } from '../../host/apps/web/src/model/distances';
import type { Scene } from '../../host/apps/web/src/model/robot';
import { sentenceOf } from '../../host/apps/web/src/model/sentence';
import { scaleOf, tensionColour } from '../../host/apps/web/src/model/tension_colour';
import { lengthText, spoken } from '../../host/apps/web/src/model/text';
import { moved, rotated, turnBetween } from '../../host/apps/web/src/model/vector';
import { FramePace, FrameTurns } from '../../host/apps/web/src/scene/frame_pace';
import { writeCameraFrame } from '../../host/apps/web/src/scene/tip_camera';
import { isIn, spreadLabels } from '../../host/apps/web/src/scene/spread_labels';
import { ARM, MICRO, near, sampleOf } from './support';
import type { Robot } from '../../host/apps/web/src/model/robot';

const scene: Scene = { name: 'x', rod: { position_m: [3, 0, 0], radius_m: 0.01, quaternion_wxyz: [1, 0, 0, 0] } };

test('one sentence says the step and one distance: the clearance where it is small', () => {
  const sample = sampleOf(
    { measured_cp: [2.14, 0, 0, 1, 0, 0, 0], 'clearance.distance_m': [0.041] },
    { state: 'ENABLED', step: { index: 4, name: 'segment 5 into the slit', device: 'hand' }, clearance: { body: 'panel', confidence: 'camera', camera: 'none', level: 'free' } },
  );
  assert.equal(sentenceOf(sample, ARM, scene, 6), 'step 4 of 6: segment 5 into the slit, at least 41 mm from the panel');
});

test('one distance is shown at a time; the others have names: guaranteed, measured, predicted', () => {
  const clearance = { body: 'drive_box', confidence: 'camera', camera: 'none', level: 'free' };
  const far = sampleOf({ measured_cp: [2.14, 0, 0, 1, 0, 0, 0], 'clearance.distance_m': [0.46], 'clearance.bound_m': [0.004], 'verdict.margins': [0.35, 1, 1, 1, 1] }, { clearance });
  assert.equal(mainDistance(far, scene), '0.86 m to the rod');
  assert.deepEqual(distanceLines(far, scene).map(([name]) => name), ['guaranteed (bound)', 'measured now', 'predicted', 'tip, measured now']);
  const close = sampleOf({ measured_cp: [2.14, 0, 0, 1, 0, 0, 0], 'clearance.distance_m': [0.05] }, { clearance });
  assert.equal(mainDistance(close, scene), 'at least 50 mm from the drive box');
  assert.deepEqual(distanceLines(close, scene).map(([name]) => name), ['guaranteed (bound)', 'tip, measured now']);
  assert.equal(mainDistance(sampleOf({}, {}), scene), '');
  assert.equal(spoken('panel_edge'), 'panel edge');
});

test('what the commanded tip is off the measured one has its cause beside it', () => {
  const cause = (facts: object, robot: Robot) => /\((.*)\)/.exec(deviationText(sampleOf({}, facts), robot, 0.001))![1];
  const causes = [{ state: 'DISABLED' }, { state: 'ENABLED', at_rest: true }, { state: 'ENABLED', at_rest: false }, { state: 'ENABLED', friction: { not_as_declared: true } },
    { state: 'ENABLED', recovery: { where: '', next: '', recovers: true } }].map((facts) => cause(facts, ARM));
  assert.equal(new Set(causes).size, 5);
  assert.notEqual(cause({ state: 'ENABLED' }, MICRO), cause({ state: 'ENABLED' }, ARM));
});

test('a stop and a fault come before the step in the sentence', () => {
  const step = { index: 1, name: 'x', device: 'none' };
  assert.match(sentenceOf(sampleOf({}, { state: 'FAULT', step }), ARM, scene, null), /^stopped by a fault/);
  const stop = { by: 'anna', reason: '', tick: 1 };
  assert.match(sentenceOf(sampleOf({}, { state: 'DISABLED', step, stop }), ARM, scene, null), /^emergency stop by anna/);
});

test('an arm that goes back says how much of the path is left', () => {
  const back = sampleOf({ 'retract.points_left': [21] }, { state: 'ENABLED', retract: { phase: 'back', points: 50 } });
  assert.match(sentenceOf(back, ARM, scene, null), /42 % left/);
});

test('lengths are said in the unit that people use', () => {
  assert.deepEqual([0.0134, 0.041, 0.86, NaN, -0.002].map(lengthText), ['13.4 mm', '41 mm', '0.86 m', '?', '-2.0 mm']);
});

test('a cable is blue at the floor, pale as planned, red at the ceiling, grey when not known', () => {
  const scale = scaleOf(ARM.tension);
  const [low, plan, high] = [15, 40, 150].map((tension_N) => tensionColour(tension_N, scale));
  assert.ok(low[2] > low[0] && high[0] > high[2]);
  assert.ok(Math.max(...plan) - Math.min(...plan) < 0.1);
  assert.deepEqual(tensionColour(600, scale), high);
  assert.deepEqual(tensionColour(NaN, scale), [0.5, 0.5, 0.5]);
});

// req:A47
test('the pitch budget is 0.32 deg with one segment in the slit and 0.084 deg with two', () => {
  const setpoint = new Float32Array(10);
  const measured = Float32Array.of(5, 0, 0, 0, 0, 0, 0.021, 0, -0.042, 0);
  assert.equal(pitchBudget([], measured, setpoint), null);
  assert.equal(pitchBudget([10], measured, setpoint), null); // a yaw is no pitch
  const one = pitchBudget([9], measured, setpoint)!;
  const two = pitchBudget([7, 9], measured, setpoint)!;
  assert.deepEqual([one.allowed_deg, one.segments], [0.32, [5]]);
  assert.deepEqual([two.allowed_deg, two.segments], [0.084, [4, 5]]);
  assert.ok(near(two.share, 0.5, 1e-4) && near(two.used_deg, 0.042, 1e-5));
});

test('labels are pushed apart, the first stays, all are inside the picture and beside what is taken', () => {
  const areas = [0, 1, 2, 3].map((i) => ({ x: 100 + i, y: 100, width: 80, height: 18 }));
  spreadLabels(areas, 300, 200, [{ x: 90, y: 125, width: 100, height: 20 }]);
  assert.deepEqual([areas[0].x, areas[0].y], [100, 100]);
  const all = [...areas, { x: 90, y: 125, width: 100, height: 20 }];
  for (const a of all)
    for (const b of all) if (a !== b) assert.ok(a.y + a.height <= b.y || b.y + b.height <= a.y, JSON.stringify(all));
  assert.ok(areas.every((a) => a.y >= 0 && a.y + a.height <= 200));
});

test('a label without a free place is not shown, and neither is one whose thing is under a control', () => {
  const taken = [{ x: 0, y: 0, width: 300, height: 200 }];
  assert.deepEqual(spreadLabels([{ x: 100, y: 100, width: 80, height: 18 }], 300, 200, taken), [false]);
  assert.deepEqual(spreadLabels([{ x: 100, y: 100, width: 80, height: 18 }], 300, 200), [true]);
  assert.deepEqual([[300, 200], [301, 200], [150, -1]].map((at) => isIn(at as [number, number], taken)), [true, false, false]);
});

test('what slows the tip is named, with its share where it is known', () => {
  assert.equal(slowdownText(sampleOf({ 'guidance.speed_share': [1] }, { guidance: { slowed_by: '' }, limits: [] })), '');
  assert.equal(slowdownText(sampleOf({ 'guidance.speed_share': [0.4] }, { guidance: { slowed_by: 'tension' }, limits: ['theta_rate'] })), 'slowed to 40 % by tension, theta rate');
  assert.equal(slowdownText(sampleOf({}, { limits: ['tip_speed'] })), 'slowed by tip speed');
});

test('the picture becomes coarser while states wait long, and finer again only after calm seconds', () => {
  const pace = new FramePace();
  let now_ms = 0;
  const frames = (waited_ms: number, seconds: number) => {
    const end_ms = now_ms + 1000 * seconds;
    while (now_ms < end_ms) pace.drawn((now_ms += 40), waited_ms);
  };
  frames(15, 5);
  assert.equal(pace.pixelRatio, 1);
  frames(80, 5);
  assert.ok(pace.pixelRatio < 1);
  const coarse = pace.pixelRatio;
  frames(15, 5);
  assert.equal(pace.pixelRatio, coarse);
  frames(15, 30);
  assert.equal(pace.pixelRatio, 1);
});

test('every turn of the screen is drawn, every second one for a minute after states were in no frame', () => {
  const turns = new FrameTurns();
  const turn_ms = 1000 / 60;
  let now_ms = 0;
  const shareDrawn = (misses: boolean, seconds: number) => {
    let drawn = 0;
    const all = Math.round((1000 * seconds) / turn_ms);
    for (let i = 0; i < all; ++i) {
      now_ms += turn_ms;
      if (!turns.takes(now_ms)) continue;
      ++drawn;
      turns.drawn(now_ms, misses);
    }
    return drawn / all;
  };
  assert.equal(shareDrawn(false, 10), 1);
  shareDrawn(true, 3);
  assert.ok(near(shareDrawn(true, 50), 0.5, 0.02));
  shareDrawn(false, 10);
  assert.equal(shareDrawn(false, 10), 1);
});

test('the camera looks ahead along the x of the tip of an arm, and along z where it carries a payload', () => {
  const angle = 0.3;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const tip = [c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1]; // turned about z
  const column = (m: number[], i: number) => m.slice(4 * i, 4 * i + 3);
  for (const [ahead, forward, up] of [['x', 0, 2], ['z', 2, 0]] as const) {
    const camera = new Array<number>(16).fill(0);
    writeCameraFrame(tip, ahead, camera);
    const [right, upright, back] = [0, 1, 2].map((i) => column(camera, i));
    back.forEach((x, r) => assert.ok(near(x, -column(tip, forward)[r], 1e-12)));
    assert.deepEqual([upright, column(camera, 3)], [column(tip, up), [1, 2, 3]]);
    const cross = [0, 1, 2].map((r) => upright[(r + 1) % 3] * back[(r + 2) % 3] - upright[(r + 2) % 3] * back[(r + 1) % 3]);
    cross.forEach((x, r) => assert.ok(near(x, right[r], 1e-12), 'no mirror'));
  }
});

test('a pose moves along the axes of base or tip and turns about them', () => {
  const turned = moved([1, 0, 0, 1, 0, 0, 0], [0, 0, 0], [0, 0, Math.PI / 2], false);
  const on = moved(turned, [0.5, 0, 0], [0, 0, 0], true);
  assert.ok(near(on[0], 1, 1e-9) && near(on[1], 0.5, 1e-9));
  assert.ok(near(turnBetween([0, 0, 0, 1, 0, 0, 0], turned), Math.PI / 2, 1e-9));
  assert.ok(near(rotated([turned[3], turned[4], turned[5], turned[6]], [1, 0, 0])[1], 1, 1e-9));
});
