// Labels that do not overlap: moved up or down, and kept inside the picture.

export interface Area {
  x: number; // of its left upper corner, pixels
  y: number;
  width: number;
  height: number;
}

function overlap(a: Area, b: Area): boolean {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

// Is this pixel in one of the areas?
export function isIn(at: readonly [number, number], areas: readonly Area[]): boolean {
  return areas.some((a) => at[0] >= a.x && at[0] <= a.x + a.width && at[1] >= a.y && at[1] <= a.y + a.height);
}

function clamped(value: number, low: number, high: number): number {
  return Math.max(low, Math.min(high, value));
}

// How far a label goes; downwards counts double, for it would hide what it names.
function way(y: number, wished: number): number {
  return y > wished ? 2 * (y - wished) : wished - y;
}

// Moves the areas, which are in order of importance: what comes first stays where it is, what follows goes to the
// nearest free place above or below. `taken`: parts of the picture where no label may be. False for each area that has no
// free place: it is not to be shown.
export function spreadLabels(areas: Area[], width: number, height: number, taken: readonly Area[] = []): boolean[] {
  const placed: Area[] = [...taken];
  return areas.map((area) => {
    area.x = clamped(area.x, 2, width - area.width - 2);
    area.y = clamped(area.y, 2, height - area.height - 2);
    const wished = area.y;
    const places = [wished, ...placed.flatMap((other) => [other.y - area.height - 1, other.y + other.height + 1])];
    const free = places.filter((y) => y >= 0 && y + area.height <= height && !placed.some((other) => overlap({ ...area, y }, other)));
    if (free.length === 0) return false;
    area.y = free.sort((a, b) => way(a, wished) - way(b, wished))[0];
    placed.push(area);
    return true;
  });
}
