import assert from 'node:assert/strict';
import { test } from 'node:test';
import { distance } from '../../host/apps/web/src/model/vector';
import { ACTIONS, roleBlocked } from '../../host/apps/web/src/steer/actions';
import { LEAD_S, nextGoal, sumOf, towards } from '../../host/apps/web/src/steer/jog';
import { actionOf, isField, type Direction } from '../../host/apps/web/src/steer/keyboard';
import { hasMoved, length_m, PlannerOffer, pointsOfPlan, tipWay_m, wayText } from '../../host/apps/web/src/steer/planner_offer';
import { drivesFor, faultText, kindsFor } from '../../host/apps/web/src/steer/practice_panel';
import { ARM, MICRO, near } from './support';

const limits = { tip_speed_m_s: 0.1, tip_rate_deg_s: 20 };
const speed = { tip_m_s: 0.05, turn_rad_s: 0.1, inTip: false };
const start = [1, 0, 0, 1, 0, 0, 0];
const key = (code: string, name = 'x', ctrlKey = false) => ({ code, key: name, ctrlKey, altKey: false, metaKey: false });

test('Escape stops wherever the focus is; letters move the tip only outside of fields', () => {
  assert.deepEqual(actionOf(key('Escape', 'Escape'), true), { kind: 'stop' });
  assert.equal(actionOf(key('Escape', 'Escape', true), true)?.kind, 'stop');
  assert.equal(actionOf(key('KeyW'), false)?.kind, 'jog');
  assert.equal(actionOf(key('KeyW'), true), null);
  assert.equal(actionOf(key('KeyW', 'w', true), false), null);
  assert.deepEqual(actionOf(key('Digit3'), false), { kind: 'view', index: 2 });
});

test('no two keys move the tip the same way, and each way has its opposite', () => {
  const codes = ['KeyW', 'KeyS', 'KeyA', 'KeyD', 'KeyE', 'KeyQ', 'KeyJ', 'KeyL', 'KeyI', 'KeyK', 'KeyU', 'KeyO'];
  const ways = codes.map((code) => {
    const action = actionOf(key(code), false);
    return action?.kind === 'jog' ? action.direction.join() : '';
  });
  assert.equal(new Set(ways).size, 12);
  for (const way of ways) assert.ok(ways.includes(way.split(',').map((d) => -Number(d)).join()), way);
});

test('a field takes letters, a box does not', () => {
  assert.deepEqual([{ tagName: 'INPUT', type: 'number' }, { tagName: 'SELECT' }, { tagName: 'INPUT', type: 'checkbox' }, { tagName: 'CANVAS' }].map(isField), [true, true, false, false]);
});

test('a jogged goal moves at the speed asked for', () => {
  const goal = nextGoal(null, start, [1, 0, 0, 0, 0, 0], speed, 0.02, limits);
  assert.ok(near(goal[0], 1.001, 1e-12));
});

test('a jogged goal never leads by more than the tip comes in 0.3 s, in place and in turn, and comes back freely', () => {
  let goal = start;
  for (let i = 0; i < 200; ++i) goal = nextGoal(goal, start, [1, 0, 0, 0, 0, 1], { ...speed, turn_rad_s: 1 }, 0.02, limits);
  assert.ok(distance(goal, start) <= LEAD_S * limits.tip_speed_m_s + 1e-9);
  const turned_rad = 2 * Math.acos(goal[3]);
  assert.ok(turned_rad <= (LEAD_S * limits.tip_rate_deg_s * Math.PI) / 180 + 1e-9);
  const back = nextGoal(goal, start, [-1, 0, 0, 0, 0, 0], speed, 0.02, limits);
  assert.ok(back[0] < goal[0]);
});

test('a page that stood still for a second does not jump', () => {
  const goal = nextGoal(null, start, [0, 1, 0, 0, 0, 0], speed, 5, limits);
  assert.ok(near(goal[1], 0.005, 1e-12));
});

test('a dragged goal goes straight to the place under the mouse and stops there', () => {
  let goal = start;
  let commanded = start;
  for (let i = 0; i < 200; ++i) {
    goal = towards(goal, commanded, [1, 0.06, 0], 0.05, 0.02, limits);
    commanded = goal;
  }
  assert.ok(distance(goal, [1, 0.06, 0]) < 1e-9);
  assert.deepEqual(goal.slice(3), start.slice(3));
});

test('keys add up to at most one each way', () => {
  const x: Direction = [1, 0, 0, 0, 0, 0];
  assert.deepEqual(sumOf([x, x, [0, -1, 0, 0, 0, 0]]), [1, -1, 0, 0, 0, 0]);
});

function blocked(name: string, facts: object, isMine: boolean): string {
  return ACTIONS.find((action) => action.name === name)!.blocked(facts, isMine);
}

test('each button says why it cannot be used now', () => {
  assert.equal(blocked('take motion', { owner: '' }, false), '');
  assert.match(blocked('take motion', { owner: 'mission' }, false), /mission has it/);
  assert.match(blocked('enable', { state: 'DISABLED' }, false), /Take motion first/);
  assert.match(blocked('enable', { state: 'DISABLED', stop: { by: 'x', reason: '', tick: 1 } }, true), /emergency stop is in force/);
  assert.equal(blocked('enable', { state: 'DISABLED', faults: [], is_homed: true }, true), '');
  assert.match(blocked('retract', { state: 'ENABLED', faults: [{ number: 5006, name: 'cable_break' }] }, true), /5006 does not allow/);
  assert.equal(blocked('retract', { state: 'ENABLED', faults: [] }, true), '');
  assert.match(blocked('clear', { faults: [] }, true), /nothing to clear/);
  assert.notEqual(roleBlocked('watch'), '');
  assert.equal(roleBlocked('operate'), '');
});

test('a planned way is told by the length of its tip, its time and its least clearance', () => {
  const tip_m = tipWay_m(ARM, [Array(10).fill(0), Array(10).fill(5)]);
  const straight_m = [tip_m.length - 3, tip_m.length - 2, tip_m.length - 1].map((i) => tip_m[i]);
  assert.ok(near(tip_m[0], 4, 1e-6) && length_m(tip_m) > distance([4, 0, 0], straight_m));
  const way = { from_deg: [], points_deg: [], duration_s: 8.7, min_clearance_m: 0.014, nearest: 'drive_box' };
  assert.equal(wayText(ARM, way, 1.234), 'Way found: 1.23 m of the tip, at least 12 s, at least 14.0 mm to drive box.');
  assert.match(wayText(ARM, { ...way, min_clearance_m: null, nearest: '' }, 0.5), /at least 9 s, nothing in the scene/);
});

test('a way of 500 points has no more places than a line in the scene', () => {
  assert.ok(tipWay_m(ARM, Array.from({ length: 500 }, (_, k) => Array(10).fill(k / 100))).length / 3 <= 3000);
});

test('a planned way is good for where the arm stands, and for nothing else', () => {
  assert.equal(hasMoved([1, 2], Float32Array.of(1, 2)), false);
  for (const now of [[1.02, 2], [1, 1.98], [1], []]) assert.equal(hasMoved([1, 2], now), true);
  assert.equal(hasMoved([1, 2], [1.009, 1.991]), false);
});

// An element without a browser: what it shows, and its listeners.
class Shown {
  hidden = false;
  textContent = '';
  readonly listeners = new Map<string, () => void>();
  readonly classList = { contains: () => false, toggle: () => false };
  append(): void {}
  setAttribute(name: string): void {
    this.hidden ||= name === 'hidden';
  }
  addEventListener(name: string, listener: () => void): void {
    this.listeners.set(name, listener);
  }
}

test('what comes late about a goal that was given up is not shown', () => {
  const made: Shown[] = [], asked: { op: string; number: number }[] = [];
  (globalThis as any).document = { createElement: () => made[made.push(new Shown()) - 1] };
  const connection = { request: (request: any) => (asked.push(request), Promise.resolve({ op: 'answer', ok: true })) };
  const planner = new PlannerOffer({ newestEvent: 0, sample: null, events: [] } as any, { robot: ARM } as any, connection as any, () => {}, () => {});
  delete (globalThis as any).document;
  const [says, plan, , , , offer] = made;
  planner.asked([1]);
  plan.listeners.get('click')!();
  planner.take({ op: 'plan', number: asked[0].number, phase: 'planning', for_s: 1, text: 'round 1' });
  assert.match(says.textContent, /round 1/);
  planner.asked([2]);
  assert.equal(asked[1].op, 'end_plan');
  planner.take({ op: 'plan', number: asked[0].number, phase: 'none', text: 'Planning was cancelled.' });
  assert.ok(offer.hidden);
  plan.listeners.get('click')!();
  planner.take({ op: 'plan', number: asked[0].number, phase: 'none', text: 'Planning was cancelled.' });
  assert.equal(says.textContent, 'Planning.');
  planner.take({ op: 'plan', number: asked[2].number, phase: 'none', text: 'There is no way.' });
  assert.equal(says.textContent, 'There is no way.');
});

test('a plan is carried out only where it has points of this arm', () => {
  assert.deepEqual(pointsOfPlan('{"waypoints_deg":[[0,1],[2,3]]}', 2), [[0, 1], [2, 3]]);
  for (const text of ['{', '{}', '{"waypoints_deg":[]}', '{"waypoints_deg":[[0]]}', '{"waypoints_deg":[[0,null]]}', 'null']) assert.throws(() => pointsOfPlan(text, 2), /liana plan --out/);
});

test('faults to practise with are those that can happen to the arm', () => {
  assert.deepEqual(kindsFor(MICRO).filter((kind) => kind.ofCable), []);
  const [cable, drive] = [true, false].map((ofCable) => kindsFor(ARM).find((kind) => !!kind.ofCable === ofCable)!);
  assert.deepEqual(drivesFor(ARM, cable), Array.from({ length: 15 }, (_, i) => i + 1));
  assert.deepEqual(drivesFor(MICRO, drive), [1, 2, 3, 4, 5, 6, 7]);
  const fed = { ...ARM, base: { slide_m_per_deg: 0.01, limit_deg: 90 } } as typeof ARM;
  assert.deepEqual([drivesFor(fed, cable)[0], drivesFor(fed, drive)[0]], [3, 1]);
});

test('a fault that is on is said with its drive and how it ends', () => {
  assert.equal(faultText({ kind: 'silent', drives: [4], can_end: true }, ARM), 'a drive is lost: drive 4 (node 4, segment 2), until it is repaired');
  assert.match(faultText({ kind: 'cable_break', drives: [5], can_end: false }, ARM), /drive 5 .*, until the console is started again$/);
  assert.match(faultText({ kind: 'fault', drives: [5], can_end: false }, ARM), /, once$/);
  assert.equal(faultText({ kind: 'camera_frozen', drives: [], can_end: true }, ARM), 'camera frozen, until it is repaired');
});
