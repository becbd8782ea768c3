// Colour of a cable by its tension: one scale for cables, bars and legend.
import type { CableRobot } from './robot';

export interface TensionScale {
  low_N: number; // slack beyond it: blue
  middle_N: number; // as planned: grey white
  high_N: number; // free motion has to stay under it: red
}

type Colour = [number, number, number]; // linear, 0 to 1

const LOW: Colour = [0.18, 0.5, 1];
const MIDDLE: Colour = [0.82, 0.84, 0.8];
const HIGH: Colour = [1, 0.25, 0.12];

export function scaleOf(tension: CableRobot['tension']): TensionScale {
  return { low_N: tension.floor_motor_N, middle_N: tension.plan_N, high_N: tension.ceiling_free_N };
}

// Blue at the floor, pale at the planned tension, red at the ceiling of free motion; grey where it is not known.
export function tensionColour(tension_N: number, scale: TensionScale): Colour {
  if (!Number.isFinite(tension_N)) return [0.5, 0.5, 0.5];
  const below = tension_N < scale.middle_N;
  const span = below ? scale.middle_N - scale.low_N : scale.high_N - scale.middle_N;
  const share = Math.min(1, Math.abs(tension_N - scale.middle_N) / span);
  const end = below ? LOW : HIGH;
  return [0, 1, 2].map((i) => MIDDLE[i] + (end[i] - MIDDLE[i]) * share) as Colour;
}

export function css(colour: Colour): string {
  return `rgb(${colour.map((c) => Math.round(255 * c)).join(' ')})`;
}
