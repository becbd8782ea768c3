// What the tests of the page share: robots and scenes as the system evaluates them, golden values.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { CableRobot, SerialRobot } from '../../host/apps/web/src/model/robot';
import type { Facts, Sample } from '../../host/apps/web/src/data/sample';

const root = process.env.LIANA_ROOT ?? process.cwd();

export function jsonFile(path: string): any {
  return JSON.parse(readFileSync(join(root, path), 'utf8'));
}

export function near(actual: number, expected: number, by: number): boolean {
  return Math.abs(actual - expected) <= by;
}

const segment = { modules: 8, module_length_m: 0.1, theta_limit_deg: 20 };

export const ARM: CableRobot = {
  name: 'zhu2022',
  kind: 'robot',
  segments: Array.from({ length: 5 }, () => segment),
  module: { radius_m: 0.03 },
  cables: { hole_radius_m: 0.025, face_offset_m: 0.01, phase_deg: [0, 24, 48, 72, 96].map((p) => [p, p + 120, p + 240]) },
  tension: { plan_N: 40, floor_motor_N: 15, ceiling_free_N: 150, alarm_N: 400, hard_limit_N: 600 },
  limits: { tip_speed_m_s: 0.1, tip_rate_deg_s: 20, theta_rate_deg_s: 2, tip_speed_slit_m_s: 0.03 },
  named_poses_deg: {},
};

function joint(alpha_deg: number, a_m: number, d_m: number) {
  return { alpha_deg, a_m, d_m, low_deg: -270, high_deg: 270, rate_deg_s: 4 };
}

export const MICRO: SerialRobot = {
  name: 'micro',
  kind: 'serial',
  joints: [joint(90, 0, 0.28), joint(90, 0, 0.22), joint(0, 2.1, 0.2), joint(0, 2.1, 0), joint(90, 0, 0.2), joint(-90, 0, 0.22), joint(0, 0, 0.28)],
  limits: { tip_speed_m_s: 0.1, tip_rate_deg_s: 3 },
  named_poses_deg: {},
};

export function sampleOf(numbers: Record<string, number[]>, facts: Facts): Sample {
  const map = new Map(Object.entries(numbers).map(([name, values]) => [name, Float32Array.from(values)]));
  return { tick: 0, time_s: 0, numbers: map, facts };
}
