// How regularly the headset gives samples: a log of intervals, and an alarm below 50 Hz.
import type { Condition } from '../model/alarms';

const KEPT_MS = 60000;
const LOWEST_HZ = 50;
const JUDGED_MS = 1000;

export class IntervalLog {
  private readonly times_ms: number[] = [];

  sampled(now_ms: number): void {
    this.times_ms.push(now_ms);
    while (this.times_ms[0] < now_ms - KEPT_MS) this.times_ms.shift();
  }

  // Intervals of the last minute [ms], oldest first.
  intervals_ms(): number[] {
    return this.times_ms.slice(1).map((t, i) => t - this.times_ms[i]);
  }

  // Samples of the last second; NaN before a second has passed.
  rate_Hz(now_ms: number): number {
    if (this.times_ms.length === 0 || now_ms - this.times_ms[0] < JUDGED_MS) return NaN;
    return this.times_ms.filter((t) => t > now_ms - JUDGED_MS).length;
  }

  // Every how many frames the picture should be drawn: where that is too much work, sampling the handles comes first.
  framesPerPicture(now_ms: number): number {
    const rate_Hz = this.rate_Hz(now_ms);
    if (rate_Hz < 0.6 * LOWEST_HZ) return 6;
    return rate_Hz < 1.2 * LOWEST_HZ ? 3 : 1;
  }

  // What a person should act on.
  conditions(now_ms: number): Condition[] {
    const rate_Hz = this.rate_Hz(now_ms);
    if (!(rate_Hz < LOWEST_HZ)) return [];
    return [{
      key: 'vr rate', priority: 2, passes: true, title: `handles are sampled only ${rate_Hz} times a second`, cause: 'The headset or this browser is too slow: 50 are needed.',
      todo: 'Let go of the triggers; close other programs, or show less. The arm holds when no sample comes for 0.1 s.',
    }];
  }

  // As a table: for a file.
  csv(): string {
    return ['interval_ms', ...this.intervals_ms().map((i) => i.toFixed(2))].join('\n') + '\n';
  }
}
