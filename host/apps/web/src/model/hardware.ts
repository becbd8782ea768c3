// What drives and real-time thread have to do, in one line.
import { value, values, type Sample } from '../data/sample';
import { driveText } from './drive_names';
import type { Robot } from './robot';

// "Largest motor current 34 % of rated, drive 8 (node 8, segment 3). Longest tick 143 us."; what is not told is left out.
export function hardwareText(sample: Sample, robot: Robot): string {
  const parts: string[] = [];
  const shares = [...values(sample, 'drives.torque_permille')].map((permille) => Math.abs(permille) / 10);
  const most = shares.reduce((best, share, i) => (share > (shares[best] ?? -1) ? i : best), 0);
  if (Number.isFinite(shares[most])) parts.push(`Largest motor current ${shares[most].toFixed(0)} % of rated, ${driveText(most, robot)}.`);
  const tick_us = value(sample, 'tick_us'); // in real time only
  if (Number.isFinite(tick_us)) parts.push(`Longest tick ${tick_us.toFixed(0)} us.`);
  return parts.join(' ');
}
