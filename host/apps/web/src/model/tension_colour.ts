// Colour of a cable by its tension: one scale for cables, bars and legend.

export interface TensionScale {
  low_N: number; // slack beyond it: blue
  middle_N: number; // as planned: grey white
  high_N: number; // free motion has to stay under it: red
}

type Colour = [number, number, number]; // linear, 0 to 1

const kLow: Colour = [0.18, 0.5, 1];
const kMiddle: Colour = [0.82, 0.84, 0.8];
const kHigh: Colour = [1, 0.25, 0.12];

export function scale_of(tension: { floor_motor_N: number; plan_N: number; ceiling_free_N: number }): TensionScale {
  return { low_N: tension.floor_motor_N, middle_N: tension.plan_N, high_N: tension.ceiling_free_N };
}

// Blue at the floor, pale at the planned tension, red at the ceiling of free motion; grey where it is not known.
export function tension_colour(tension_N: number, scale: TensionScale): Colour {
  if (!Number.isFinite(tension_N)) return [0.5, 0.5, 0.5];
  const below = tension_N < scale.middle_N;
  const span = below ? scale.middle_N - scale.low_N : scale.high_N - scale.middle_N;
  const share = Math.min(1, Math.abs(tension_N - scale.middle_N) / span);
  const end = below ? kLow : kHigh;
  return [0, 1, 2].map((i) => kMiddle[i] + (end[i] - kMiddle[i]) * share) as Colour;
}

export function css(colour: Colour): string {
  return `rgb(${colour.map((c) => Math.round(255 * c)).join(' ')})`;
}
