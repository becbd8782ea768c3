import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { inflated } from '../../host/apps/web/src/data/telemetry';
import { values } from '../../host/apps/web/src/data/sample';
import type { Scene } from '../../host/apps/web/src/model/robot';
import { distance, turnBetween, type Pose } from '../../host/apps/web/src/model/vector';
import { hintOf } from '../../host/apps/web/src/try/guide';
import { INTERVAL_S, REQUESTS, TryArm, type Request } from '../../host/apps/web/src/try/try_arm';
import { Way } from '../../host/apps/web/src/try/way';
import { near } from './support';

const root = process.env.LIANA_ROOT ?? process.cwd();
const html = readFileSync(join(root, 'build', 'page', 'try.html'), 'utf8');
const heldText = (id: string) => new RegExp(`id="${id}">([^<]*)<`).exec(html)![1];
const tables = heldText('liana-tables');
const scene: Scene = JSON.parse(tables.split('\n')[2]);
const newArm = async () => TryArm.of(await inflated(heldText('liana-try')), tables);

interface Line {
  count: number;
  request: Request;
  wanted: Pose | null;
}

function play(arm: TryArm, { count, request, wanted }: Line): void {
  for (let i = 0; i < count; ++i) arm.interval(i === 0 ? request : 'none', wanted);
}

async function enabledArm(): Promise<TryArm> {
  const arm = await newArm();
  play(arm, { count: 200, request: 'enable', wanted: null });
  assert.equal(arm.sample().facts.state, 'ENABLED');
  return arm;
}

// What the same code answers, compiled for this machine.
function nativeHash(lines: Line[]): string {
  const program = join(root, 'build', 'bin', 'try_player');
  const script = lines.map(({ count, request, wanted }) => [count, REQUESTS[request], wanted ? 1 : 0, ...(wanted ?? [0, 0, 0, 1, 0, 0, 0])].join(' '));
  const { stdout, stderr, status, error } = spawnSync(program, [], { input: `${tables.trim()}\n${script.join('\n')}\n`, encoding: 'utf8' });
  assert.equal(status, 0, error ? `${error}: build the target try_player (./dev test page does)` : stderr);
  return stdout.trim().split('\n').slice(-1)[0];
}

test('the same inputs leave the same bits in WebAssembly and natively, refusals and a stop included', async () => {
  const ahead: Pose = [1.2, -0.7, 0.14, ...scene.rod!.quaternion_wxyz];
  const sphere = scene.spheres![0].center_m;
  const lines: Line[] = [
    { count: 200, request: 'enable', wanted: null },
    { count: 100, request: 'none', wanted: ahead },
    { count: 30, request: 'none', wanted: null },
    { count: 550, request: 'none', wanted: [...sphere, ...scene.rod!.quaternion_wxyz] },
    { count: 100, request: 'stop', wanted: null },
  ];
  const arm = await newArm();
  for (const line of lines) play(arm, line);
  const { facts } = arm.sample();
  assert.ok(facts.commands.released > 200 && facts.commands.refused > 0, JSON.stringify(facts.commands));
  assert.equal(facts.state, 'DISABLED');
  assert.equal(arm.hash(), nativeHash(lines));
  const other = lines.map((line, i) => (i === 1 ? { ...line, count: line.count + 1 } : line));
  assert.notEqual(arm.hash(), nativeHash(other)); // one interval more shows
});

test('led along the way, the arm crosses the slit to the rod without a refusal', async () => {
  const arm = await enabledArm();
  const way = new Way(scene, [...values(arm.sample(), 'setpoint_cp')]);
  let least_m = Infinity;
  let sample = arm.sample();
  for (let i = 0; i < 150 / INTERVAL_S && hintOf(sample, way).weight !== 'done'; ++i) {
    arm.interval('none', way.at(way.nearestTo(values(sample, 'setpoint_cp')).s_m + 0.12));
    sample = arm.sample();
    least_m = Math.min(least_m, values(sample, 'clearance.distance_m')[0]);
  }
  assert.equal(hintOf(sample, way).weight, 'done');
  assert.equal(sample.facts.commands.refused, 0);
  assert.equal(sample.facts.planar_segments, 2);
  assert.ok(least_m > 0.01, String(least_m));
});

test('a hand that pushes towards a body is refused by name, and the arm stays clear of it', async () => {
  const arm = await enabledArm();
  const obstacle = scene.spheres![0].center_m;
  const way = new Way(scene, [...values(arm.sample(), 'setpoint_cp')]);
  let least_m = Infinity;
  let refusals = '';
  for (let i = 0; i < 700; ++i) {
    const tip = values(arm.sample(), 'setpoint_cp');
    arm.interval('none', [...obstacle, ...tip.subarray(3)]);
    const sample = arm.sample();
    least_m = Math.min(least_m, values(sample, 'clearance.distance_m')[0]);
    if (sample.facts.verdict.code !== 0) refusals = hintOf(sample, way).weight;
  }
  assert.equal(refusals, 'warning');
  assert.ok(least_m > 0.003, String(least_m));
});

test('letting go brings the arm to rest and keeps it enabled; stop switches it off, and it can be enabled again', async () => {
  const arm = await enabledArm();
  const [x, y, z, ...attitude] = values(arm.sample(), 'setpoint_cp');
  play(arm, { count: 60, request: 'none', wanted: [x + 1, y, z, ...attitude] });
  assert.ok(values(arm.sample(), 'tip_speed_m_s')[0] > 0.02);
  play(arm, { count: 100, request: 'none', wanted: null });
  assert.deepEqual([arm.sample().facts.state, arm.sample().facts.at_rest], ['ENABLED', true]);
  play(arm, { count: 60, request: 'none', wanted: [x + 1, y, z, ...attitude] });
  play(arm, { count: 150, request: 'stop', wanted: [x + 1, y, z, ...attitude] });
  assert.equal(arm.sample().facts.state, 'DISABLED');
  assert.deepEqual(arm.sample().facts.faults, []);
  play(arm, { count: 250, request: 'enable', wanted: null });
  assert.equal(arm.sample().facts.state, 'ENABLED');
});

test('the way begins at the tip, comes into the plane before the mouth, and ends at the rod', () => {
  const start: Pose = [0.24, -0.27, 0.58, 1, 0, 0, 0];
  const way = new Way(scene, start);
  const { slit, rod } = scene;
  const off_m = (pose: Pose) => Math.abs(slit!.normal.reduce((sum, n, r) => sum + n * pose[r], -slit!.offset_m));
  assert.ok(distance(way.at(0), start) < 1e-9 && turnBetween(way.at(0), start) < 1e-6);
  assert.ok(distance(way.at(way.length_m), rod!.position_m) < 1e-9);
  for (const s_m of [way.mouth_m - 0.5, way.mouth_m, way.length_m]) assert.ok(off_m(way.at(s_m)) < 1e-6, String(s_m));
  const mouth = way.at(way.mouth_m);
  assert.ok(near(slit!.u_axis.reduce((sum, u, r) => sum + u * mouth[r], 0), slit!.mouth_u_m, 1e-6));
  const beside = way.at(1).map((p, i) => (i === 2 ? p + 0.1 : p));
  assert.ok(near(way.nearestTo(beside).s_m, 1, 0.1) && way.nearestTo(beside).off_m <= 0.1);
  const sight = way.nearestToSight([1, -5, 1], way.at(2));
  assert.ok(near(sight.s_m, 2, 0.021) && sight.off_m < 0.02);
});
