import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { RunHead } from '../../host/apps/web/src/data/run';
import { faultRow } from '../../host/apps/web/src/model/tables';
import { outcomeOf } from '../../host/apps/web/src/run/outcome';
import { ARM } from './support';

const steps = [
  { index: 1, name: 'prepare pose', tick: 100 },
  { index: 2, name: 'into the slit', tick: 200 },
];
const done = { name: 'prepare pose', device: 'none', duration_s: 1, outcome: 'success', reason: '' };

function head(changes: Partial<RunHead>): RunHead {
  const telemetry = { rows: 0, ticks: { first: 0, every: 1 }, columns: [] };
  return { format: 1, title: 't', robot: ARM, scene: { name: 's' }, report: null, period_s: 0.004, steps, events: [], commands: [], facts: [], telemetry, ...changes };
}

test('of a failed run it says what failed, where, why, and the remedy of the fault table', () => {
  const outcome = outcomeOf(head({
    report: { mission: 'slit_crossing', outcome: 'failed', reason: 'the arm is STOPPING', faults: [], steps: [done, { ...done, name: 'into the slit', outcome: 'failed', reason: 'fault' }] },
    events: [
      { sequence: 1, tick: 250, kind: 'fault', number: 5006, subject: 'drive 8 (node 8, segment 3)', values: {}, text: `It is gone. ${faultRow(5006)!.remedy} [5006 cable_break]` },
      { sequence: 2, tick: 260, kind: 'fault', number: 3002, subject: 'drive 8 (node 8, segment 3)', values: {}, text: 'later' },
    ],
  }));
  assert.equal(outcome.success, false);
  assert.equal(outcome.what, 'slit_crossing failed in "into the slit"');
  assert.equal(outcome.where, 'at 1.0 s, in step 2: into the slit');
  assert.match(outcome.why, /^drive 8 \(node 8, segment 3\): It is gone. \[5006 cable_break\]/);
  assert.match(outcome.todo[0], /its clamp on the drum/);
  assert.equal(outcome.tick, 250);
});

test('a run that ended with a refused command names its refusal and what to do instead', () => {
  const outcome = outcomeOf(head({
    report: { outcome: 'failed', reason: 'time limit', faults: [], steps: [] },
    events: [{ sequence: 1, tick: 300, kind: 'verdict', number: 208, subject: 'simulation', values: { command: 9 }, text: 'link 27 and the wall' }],
  }));
  assert.match(outcome.why, /link 27 and the wall/);
  assert.match(outcome.todo.join(' '), /leaves the body named more room/);
});

test('a step that ran into its time limit is named with its end, not with what was refused on the way back', () => {
  const outcome = outcomeOf(head({
    report: { outcome: 'aborted', reason: 'time limit of 2 s passed; retracted', faults: [], steps: [done, { ...done, name: 'into the slit', duration_s: 2, outcome: 'failed', reason: 'time limit of 2 s passed' }] },
    events: [{ sequence: 1, tick: 9000, kind: 'verdict', number: 211, subject: 'simulation', values: { command: 9 }, text: 'slack' }],
  }));
  assert.equal(outcome.tick, 700);
  assert.equal(outcome.where, 'at 2.8 s, in step 2: into the slit');
  assert.equal(outcome.why, 'time limit of 2 s passed; retracted');
});

test('a success is one line with its figures', () => {
  const outcome = outcomeOf(head({ report: { outcome: 'success', duration_s: 204.08, verified_clearance_m: { min: 0.0106 }, tip_error_m: 0.0009 } }));
  assert.equal(outcome.what, 'Success: 204.1 s, at least 10.6 mm clear of everything, tip 0.9 mm from its goal in the end');
});

test('a run without a report says so', () => {
  assert.match(outcomeOf(head({})).what, /no report/);
});

test('what the mission saw of the fault that ended the run is not said beside it, what else it saw is', () => {
  const events = [{ sequence: 1, tick: 250, kind: 'fault', number: 5006, subject: 'drive 8 (node 8, segment 3)', values: {}, text: 'cable_break: gone' }];
  const why = (faults: string) => outcomeOf(head({ report: { outcome: 'failed', reason: `the arm is STOPPING (stop category stop), faults: ${faults}`, faults: [], steps: [] }, events })).why;
  assert.equal(why('5006 cable_break: drive 8 (node 8, segment 3)'), 'drive 8 (node 8, segment 3): cable_break: gone');
  assert.match(why('5006 cable_break: drive 8 (node 8, segment 3), 3002 drive_silent: drive 5 (node 5, segment 2)'), / \u2013 the arm is STOPPING .*3002 drive_silent: drive 5 \(node 5, segment 2\)$/);
});

test('a reason that event, step and report spell differently is said once', () => {
  const why = 'goal = 9: allowed -5 to 5 [m]: choose a goal within reach';
  const reason = `move_cp refused: out_of_range: ${why}`;
  const outcome = outcomeOf(head({
    report: { outcome: 'refused', reason: `${reason}; retracted`, faults: [], steps: [{ ...done, outcome: 'refused', reason }] },
    events: [{ sequence: 1, tick: 110, kind: 'refusal', number: 6, subject: 'mission', values: {}, text: `move_cp refused (out_of_range): ${why}` }],
  }));
  assert.equal(outcome.why, `mission: move_cp refused (out_of_range): ${why} \u2013 retracted`);
});
