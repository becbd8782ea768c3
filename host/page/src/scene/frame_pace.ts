// How fine the picture is drawn: coarser while frames take too long, finer again slowly.

const kSteps = [1, 0.75, 0.6]; // pixel ratios
const kWindow_ms = 2000;
const kSlow_ms = 45; // mean interval of frames that had something new to show
const kQuick_ms = 26;
const kCalmWindows = 5; // before it becomes finer again

export class FramePace {
  private step = 0;
  private since_ms = NaN;
  private last_ms = NaN;
  private sum_ms = 0;
  private frames = 0;
  private calm = 0;

  get pixel_ratio(): number {
    return kSteps[this.step];
  }

  // A frame was drawn at `now_ms`, `busy` where the one before it was due, too (states come all the time). True when
  // the pixel ratio changed.
  drawn(now_ms: number, busy: boolean): boolean {
    if (busy && now_ms - this.last_ms < 500) {
      this.sum_ms += now_ms - this.last_ms;
      ++this.frames;
    }
    this.last_ms = now_ms;
    if (Number.isNaN(this.since_ms)) this.since_ms = now_ms;
    if (now_ms - this.since_ms < kWindow_ms) return false;
    const mean_ms = this.frames < 5 ? NaN : this.sum_ms / this.frames;
    this.since_ms = now_ms;
    this.sum_ms = this.frames = 0;
    return this.judge(mean_ms);
  }

  private judge(mean_ms: number): boolean {
    if (mean_ms > kSlow_ms) {
      this.calm = 0;
      if (this.step + 1 >= kSteps.length) return false;
      ++this.step;
      return true;
    }
    this.calm = mean_ms < kQuick_ms ? this.calm + 1 : 0;
    if (this.calm < kCalmWindows || this.step === 0) return false;
    this.calm = 0;
    --this.step;
    return true;
  }
}
