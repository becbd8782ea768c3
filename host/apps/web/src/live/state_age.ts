// How old what is seen is, without a clock that both sides share: of the states of the last moments the one that came
// quickest counts as new. (Paced time may run slower than this clock for a while, so the moments are few.)

const WINDOW_S = 0.3;

export class StateAge {
  private readonly came_s: number[] = []; // on this clock
  private readonly way_s: number[] = []; // this clock less the arm's when it came

  // A state of arm time `time_s` came at `now_s` of this clock.
  came(time_s: number, now_s: number): void {
    this.came_s.push(now_s);
    this.way_s.push(now_s - time_s);
    while (this.came_s.length > 1 && this.came_s[0] < now_s - WINDOW_S) {
      this.came_s.shift();
      this.way_s.shift();
    }
  }

  // Of the newest state when it is seen at `now_s` [s]; NaN before the first.
  age_s(now_s: number): number {
    const last = this.came_s.length - 1;
    if (last < 0) return NaN;
    const late_s = this.way_s[last] - Math.min(...this.way_s);
    return late_s + now_s - this.came_s[last];
  }
}
