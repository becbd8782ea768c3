// How fine and how often the picture is drawn: coarser while a state waits long before it is in the picture, finer again slowly.

const PIXEL_RATIOS = [1, 0.75]; // still coarser ones save less than 2 ms of CPU a frame and look bad
const WINDOW_MS = 2000;
const SLOW_MS = 35; // mean wait of a state before its frame was drawn
const QUICK_MS = 20;
const CALM_WINDOWS = 5; // before it becomes finer again
const FEWEST = 5; // frames that say anything

export class FramePace {
  private step = 0;
  private since_ms = NaN;
  private sum_ms = 0;
  private frames = 0;
  private calm = 0;

  get pixelRatio(): number {
    return PIXEL_RATIOS[this.step];
  }

  // A frame was drawn at `now_ms`, for a state that came `waited_ms` before. True when the pixel ratio changed.
  drawn(now_ms: number, waited_ms: number): boolean {
    this.sum_ms += waited_ms;
    ++this.frames;
    if (Number.isNaN(this.since_ms)) this.since_ms = now_ms;
    if (now_ms - this.since_ms < WINDOW_MS) return false;
    const mean_ms = this.frames < FEWEST ? NaN : this.sum_ms / this.frames;
    this.since_ms = now_ms;
    this.sum_ms = this.frames = 0;
    return this.judge(mean_ms);
  }

  private judge(mean_ms: number): boolean {
    if (mean_ms > SLOW_MS) {
      this.calm = 0;
      if (this.step + 1 >= PIXEL_RATIOS.length) return false;
      ++this.step;
      return true;
    }
    this.calm = mean_ms < QUICK_MS ? this.calm + 1 : 0;
    if (this.calm < CALM_WINDOWS || this.step === 0) return false;
    this.calm = 0;
    --this.step;
    return true;
  }
}

const MAX_LATE = 0.03; // share of a window's frames whose state was overtaken by a newer one: 50 states come a second
const EVERY_SECOND_MS = 25; // between two frames, to leave out every second turn
const STEADY_MS = 60000; // then every turn is tried again

// Which turns of the screen are drawn: all, or every second one while this machine cannot keep up with all of them. Steady
// 30 pictures a second look calmer than 40 that come after one, two or three turns.
export class FrameTurns {
  private drawn_ms = -Infinity;
  private since_ms = NaN;
  private frames = 0;
  private late = 0;
  private steadyUntil_ms = -Infinity;

  // Whether this turn is drawn.
  takes(now_ms: number): boolean {
    if (now_ms < this.steadyUntil_ms && now_ms - this.drawn_ms < EVERY_SECOND_MS) return false;
    this.drawn_ms = now_ms;
    return true;
  }

  // A frame was drawn at `now_ms`; a state had come before the one that it shows, and was in no frame.
  drawn(now_ms: number, hasMissedOne: boolean): void {
    if (now_ms < this.steadyUntil_ms) return;
    if (Number.isNaN(this.since_ms)) this.since_ms = now_ms;
    ++this.frames;
    if (hasMissedOne) ++this.late;
    if (now_ms - this.since_ms < WINDOW_MS) return;
    if (this.frames >= FEWEST && this.late > MAX_LATE * this.frames) this.steadyUntil_ms = now_ms + STEADY_MS;
    this.since_ms = NaN;
    this.frames = this.late = 0;
  }
}
