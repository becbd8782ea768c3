import assert from 'node:assert/strict';
import { test } from 'node:test';
import { distance } from '../../host/apps/web/src/model/vector';
import { kActions, role_blocked } from '../../host/apps/web/src/steer/actions';
import { kLead_s, next_goal, sum_of, towards } from '../../host/apps/web/src/steer/jog';
import { action_of, is_field, type Direction } from '../../host/apps/web/src/steer/keyboard';
import { near } from './support';

const limits = { tip_speed_m_s: 0.1, tip_rate_deg_s: 20 };
const speed = { tip_m_s: 0.05, turn_rad_s: 0.1, in_tip: false };
const start = [1, 0, 0, 1, 0, 0, 0];
const key = (code: string, name = 'x', ctrlKey = false) => ({ code, key: name, ctrlKey, altKey: false, metaKey: false });

test('Escape stops wherever the focus is; letters move the tip only outside of fields', () => {
  assert.deepEqual(action_of(key('Escape', 'Escape'), true), { kind: 'stop' });
  assert.equal(action_of(key('Escape', 'Escape', true), true)?.kind, 'stop');
  assert.equal(action_of(key('KeyW'), false)?.kind, 'jog');
  assert.equal(action_of(key('KeyW'), true), null);
  assert.equal(action_of(key('KeyW', 'w', true), false), null);
  assert.deepEqual(action_of(key('Digit3'), false), { kind: 'view', index: 2 });
});

test('no two keys move the tip the same way, and each way has its opposite', () => {
  const codes = ['KeyW', 'KeyS', 'KeyA', 'KeyD', 'KeyE', 'KeyQ', 'KeyJ', 'KeyL', 'KeyI', 'KeyK', 'KeyU', 'KeyO'];
  const ways = codes.map((code) => {
    const action = action_of(key(code), false);
    return action?.kind === 'jog' ? action.direction.join() : '';
  });
  assert.equal(new Set(ways).size, 12);
  for (const way of ways) assert.ok(ways.includes(way.split(',').map((d) => -Number(d)).join()), way);
});

test('a field takes letters, a box does not', () => {
  assert.deepEqual([{ tagName: 'INPUT', type: 'number' }, { tagName: 'SELECT' }, { tagName: 'INPUT', type: 'checkbox' }, { tagName: 'CANVAS' }].map(is_field), [true, true, false, false]);
});

test('a jogged goal moves at the speed asked for', () => {
  const goal = next_goal(null, start, [1, 0, 0, 0, 0, 0], speed, 0.02, limits);
  assert.ok(near(goal[0], 1.001, 1e-12));
});

test('a jogged goal never leads by more than the tip comes in 0.3 s, in place and in turn, and comes back freely', () => {
  let goal = start;
  for (let i = 0; i < 200; ++i) goal = next_goal(goal, start, [1, 0, 0, 0, 0, 1], { ...speed, turn_rad_s: 1 }, 0.02, limits);
  assert.ok(distance(goal, start) <= kLead_s * limits.tip_speed_m_s + 1e-9);
  const turned_rad = 2 * Math.acos(goal[3]);
  assert.ok(turned_rad <= (kLead_s * limits.tip_rate_deg_s * Math.PI) / 180 + 1e-9);
  const back = next_goal(goal, start, [-1, 0, 0, 0, 0, 0], speed, 0.02, limits);
  assert.ok(back[0] < goal[0]);
});

test('a page that stood still for a second does not jump', () => {
  const goal = next_goal(null, start, [0, 1, 0, 0, 0, 0], speed, 5, limits);
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
  assert.deepEqual(sum_of([x, x, [0, -1, 0, 0, 0, 0]]), [1, -1, 0, 0, 0, 0]);
});

function blocked(name: string, facts: object, is_mine: boolean): string {
  return kActions.find((action) => action.name === name)!.blocked(facts, is_mine);
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
  assert.notEqual(role_blocked('watch'), '');
  assert.equal(role_blocked('operate'), '');
});
