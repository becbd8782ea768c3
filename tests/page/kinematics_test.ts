import assert from 'node:assert/strict';
import { test } from 'node:test';
import { chainOf } from '../../host/apps/web/src/model/arm_chain';
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
