// How old what is seen is, without a clock that both sides share: the quickest state of the last seconds counts as new.

const kForget = 0.02; // of the difference to the quickest, each second: the arm's clock and this one drift

export class StateAge {
  private quickest_s = Infinity; // this clock less the arm's, for the state that came quickest
  private last_s = NaN;

  // A state of arm time `time_s` came at `now_s` of this clock.
  came(time_s: number, now_s: number): void {
    const way_s = now_s - time_s;
    if (!Number.isFinite(this.quickest_s) || Math.abs(way_s - this.quickest_s) > 30) this.quickest_s = way_s; // begins anew
    const passed_s = Number.isFinite(this.last_s) ? Math.max(0, now_s - this.last_s) : 0;
    this.quickest_s += Math.min(1, kForget * passed_s) * Math.max(0, way_s - this.quickest_s);
    this.quickest_s = Math.min(this.quickest_s, way_s);
    this.last_s = now_s;
  }

  // Of the state of arm time `time_s` when it is seen at `now_s` [s].
  age_s(time_s: number, now_s: number): number {
    return Math.max(0, now_s - time_s - this.quickest_s);
  }
}
