// How fine and how often the picture is drawn: coarser while a state waits long before it is in the picture, finer again slowly.

const kPixelRatios = [1, 0.75]; // still coarser ones save less than 2 ms of CPU a frame and look bad
const kWindow_ms = 2000;
const kSlow_ms = 35; // mean wait of a state before its frame was drawn
const kQuick_ms = 20;
const kCalmWindows = 5; // before it becomes finer again
const kFewest = 5; // frames that say anything

export class FramePace {
  private step = 0;
  private since_ms = NaN;
  private sum_ms = 0;
  private frames = 0;
  private calm = 0;

  get pixel_ratio(): number {
    return kPixelRatios[this.step];
  }

  // A frame was drawn at `now_ms`, for a state that came `waited_ms` before. True when the pixel ratio changed.
  drawn(now_ms: number, waited_ms: number): boolean {
    this.sum_ms += waited_ms;
    ++this.frames;
    if (Number.isNaN(this.since_ms)) this.since_ms = now_ms;
    if (now_ms - this.since_ms < kWindow_ms) return false;
    const mean_ms = this.frames < kFewest ? NaN : this.sum_ms / this.frames;
    this.since_ms = now_ms;
    this.sum_ms = this.frames = 0;
    return this.judge(mean_ms);
  }

  private judge(mean_ms: number): boolean {
    if (mean_ms > kSlow_ms) {
      this.calm = 0;
      if (this.step + 1 >= kPixelRatios.length) return false;
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

const kMaxLate = 0.03; // share of a window's frames whose state was overtaken by a newer one: 50 states come a second
const kEverySecond_ms = 25; // between two frames, to leave out every second turn
const kSteady_ms = 60000; // then every turn is tried again

// Which turns of the screen are drawn: all, or every second one while this machine cannot keep up with all of them. Steady
// 30 pictures a second look calmer than 40 that come after one, two or three turns.
export class FrameTurns {
  private drawn_ms = -Infinity;
  private since_ms = NaN;
  private frames = 0;
  private late = 0;
  private steady_until_ms = -Infinity;

  // Whether this turn is drawn.
  takes(now_ms: number): boolean {
    if (now_ms < this.steady_until_ms && now_ms - this.drawn_ms < kEverySecond_ms) return false;
    this.drawn_ms = now_ms;
    return true;
  }

  // A frame was drawn at `now_ms`; a state had come before the one that it shows, and was in no frame.
  drawn(now_ms: number, has_missed_one: boolean): void {
    if (now_ms < this.steady_until_ms) return;
    if (Number.isNaN(this.since_ms)) this.since_ms = now_ms;
    ++this.frames;
    if (has_missed_one) ++this.late;
    if (now_ms - this.since_ms < kWindow_ms) return;
    if (this.frames >= kFewest && this.late > kMaxLate * this.frames) this.steady_until_ms = now_ms + kSteady_ms;
    this.since_ms = NaN;
    this.frames = this.late = 0;
  }
}
