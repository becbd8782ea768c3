import assert from 'node:assert/strict';
import { test } from 'node:test';
import { chainOf } from '../../host/apps/web/src/model/arm_chain';
import { driveText } from '../../host/apps/web/src/model/drive_names';
import { angleCount, angleName, angleRange_deg, type CableRobot } from '../../host/apps/web/src/model/robot';
import { jsonFile, ARM, MICRO, near } from './support';

interface Golden {
  cases: { name: string; theta_deg: number[]; tip_pose: number[][]; segment_ends_m: number[][] }[];
}

// req:A35
test('the cable arm stands where the golden values have it, at all its nodes and its tip', () => {
  const chain = chainOf(ARM);
  for (const golden of (jsonFile('tests/golden/arm.json') as Golden).cases) {
    chain.set(golden.theta_deg);
    for (let r = 0; r < 3; ++r) {
      for (let c = 0; c < 4; ++c)
        assert.ok(near(chain.tip[4 * c + r], golden.tip_pose[r][c], 2e-6), `${golden.name} tip[${r}][${c}]`);
      golden.segment_ends_m.forEach((end, m) => assert.ok(near(chain.nodes[3 * m + r], end[r], 2e-6), `${golden.name} node ${m}`));
    }
  }
});

// A slide of 4 mm a degree, and a roll.
const FED: CableRobot = { ...ARM, name: 'fed', base: { limit_deg: 90, slide_m_per_deg: 0.004 } };

test('an arm on a base that feeds is the same arm, moved along x and turned about it', () => {
  const chain = chainOf(FED);
  const [slide_deg, roll_deg] = [-50, 30];
  const [c, s] = [Math.cos(Math.PI / 6), Math.sin(Math.PI / 6)];
  const moved = ([x, y, z]: number[]) => [x + 0.004 * slide_deg, c * y - s * z, s * y + c * z];
  for (const golden of (jsonFile('tests/golden/arm.json') as Golden).cases) {
    chain.set([slide_deg, roll_deg, ...golden.theta_deg]);
    const tip = moved(golden.tip_pose.map((row) => row[3]));
    for (let r = 0; r < 3; ++r) assert.ok(near(chain.tip[12 + r], tip[r], 2e-6), `${golden.name} tip[${r}]`);
    assert.ok(near(chain.nodes[0], 0.004 * slide_deg, 1e-6), 'its first node is the carriage');
    golden.segment_ends_m.map(moved).forEach((end, m) =>
      end.forEach((place, r) => assert.ok(near(chain.nodes[3 * (m + 1) + r], place, 2e-6), `${golden.name} node ${m + 1}`)));
  }
});

test('slide and roll come before the angles and drives of the segments, and count as segment 1', () => {
  assert.equal(angleCount(FED), 12);
  assert.deepEqual([0, 1, 2, 11].map((i) => angleName(FED, i)), ['slide', 'roll', 'pitch 2', 'yaw 6']);
  assert.deepEqual(angleRange_deg(FED, 1), [-90, 90]);
  assert.deepEqual(angleRange_deg(FED, 2), [-20, 20]);
  assert.equal(driveText(1, FED), 'drive 2 (node 2, segment 1)');
  assert.equal(driveText(2, FED), 'drive 3 (node 3, segment 2)');
});

interface SerialGolden {
  cases: { name: string; joint_deg: number[]; tip_pose: number[][] }[];
}

test('the serial arm has its tip where the golden values have it', () => {
  const chain = chainOf(MICRO);
  for (const golden of (jsonFile('tests/golden/micro.json') as SerialGolden).cases) {
    chain.set(golden.joint_deg);
    for (let r = 0; r < 3; ++r)
      for (let c = 0; c < 4; ++c)
        assert.ok(near(chain.tip[4 * c + r], golden.tip_pose[r][c], 3e-6), `${golden.name} tip[${r}][${c}]`);
  }
});

test('each piece begins where the one before it ends', () => {
  for (const robot of [ARM, MICRO]) {
    const chain = chainOf(robot);
    chain.set([12, -9, 7, -8, 12, -3, 12, -10, -12, -2]);
    let end = [0, 0, 0];
    chain.pieces.forEach((piece, k) => {
      const frame = chain.matrices.subarray(16 * k, 16 * k + 16);
      for (let r = 0; r < 3; ++r) assert.ok(near(frame[12 + r], end[r], 1e-5), `${robot.name} piece ${k}`);
      end = [0, 1, 2].map((r) => frame[12 + r] + piece.length_m * frame[r]);
    });
    for (let r = 0; r < 3; ++r) assert.ok(near(chain.tip[12 + r], end[r], 1e-5), `${robot.name} tip`);
  }
});

test('angles that are not there or no numbers count as 0', () => {
  const chain = chainOf(ARM);
  chain.set([NaN, 0, 0]);
  assert.ok(near(chain.tip[12], 4, 1e-6));
});
