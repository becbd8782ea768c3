// Fewer points of a curve without losing its peaks.

// Of each bucket of rows the smallest and the largest value, at two times of it; x of all curves is the same. NaN where
// a bucket has no value.
export function decimated(
  times_s: (row: number) => number,
  columns: readonly ArrayLike<number>[],
  firstRow: number,
  lastRow: number,
  mostPoints: number,
): Float64Array[] {
  const rows = Math.max(0, lastRow - firstRow + 1);
  const perBucket = Math.max(1, Math.ceil((2 * rows) / mostPoints));
  const buckets = Math.ceil(rows / perBucket);
  const out = Array.from({ length: columns.length + 1 }, () => new Float64Array(2 * buckets));
  for (let b = 0; b < buckets; ++b) {
    const from = firstRow + b * perBucket;
    const to = Math.min(lastRow, from + perBucket - 1);
    out[0][2 * b] = times_s(from);
    out[0][2 * b + 1] = times_s(from + (to - from + 1) / 2);
    columns.forEach((column, c) => {
      const [low, high] = extremes(column, from, to);
      const rises = column[from] <= column[to];
      out[c + 1][2 * b] = rises ? low : high;
      out[c + 1][2 * b + 1] = rises ? high : low;
    });
  }
  return out;
}

function extremes(column: ArrayLike<number>, from: number, to: number): [number, number] {
  let low = NaN;
  let high = NaN;
  for (let i = from; i <= to; ++i) {
    const value = column[i];
    if (!(value >= low)) low = Number.isNaN(value) ? low : value;
    if (!(value <= high)) high = Number.isNaN(value) ? high : value;
  }
  return [low, high];
}
