// How lengths and the API's keys are written for people.

// "drive box" of drive_box: no key of a table or of the API is shown as it is spelt there.
export function spoken(key: string): string {
  return key.replaceAll('_', ' ');
}

// 41 mm, 0.86 m.
export function lengthText(length_m: number): string {
  if (!Number.isFinite(length_m)) return '?';
  return Math.abs(length_m) < 0.2 ? `${(1000 * length_m).toFixed(length_m < 0.02 ? 1 : 0)} mm` : `${length_m.toFixed(2)} m`;
}
