// Looking back: the scene shows a moment of the last minute instead of now.
import { firstWhere } from '../data/run';
import type { Sample } from '../data/sample';
import { h, setText } from '../ui/dom';
import type { Live } from './live';

export class HistoryScrubber {
  readonly element: HTMLElement;
  time_s: number | null = null; // null: now
  private readonly slider: HTMLInputElement;
  private readonly clock = h('output', { class: 'clock' });
  private numbers = new Map<string, Float32Array>();

  constructor(private readonly live: Live, private readonly changed: () => void) {
    this.slider = h('input', { type: 'range', min: -60, max: 0, step: 0.1, value: 0, 'aria-label': 'how far back the scene is [s]', oninput: () => this.slid() });
    this.element = h('footer', { class: 'time-line', 'aria-label': 'time' }, h('button', { type: 'button', onclick: () => this.goTo(null) }, 'now'), this.slider, this.clock);
  }

  // To this arm time; now when it is null or no longer kept.
  goTo(time_s: number | null): void {
    const { history, sample } = this.live;
    const kept = history && sample && time_s !== null && history.rows > 0 && time_s >= history.time_s(0) && time_s < sample.time_s;
    this.time_s = kept ? time_s : null;
    this.changed();
  }

  // The moment that is looked at.
  sample(): Sample | null {
    const { history, sample } = this.live;
    if (!history || !sample || this.time_s === null || history.rows === 0) return sample;
    const wanted_s = (this.time_s = Math.max(this.time_s, history.time_s(0)));
    const row = firstWhere(history.rows - 1, (i) => history.time_s(i) >= wanted_s);
    if (this.numbers.size !== sample.numbers.size) this.numbers = new Map([...sample.numbers].map(([name, values]) => [name, new Float32Array(values.length)]));
    history.read(row, this.numbers);
    return { tick: history.tick(row), time_s: history.time_s(row), numbers: this.numbers, facts: sample.facts };
  }

  update(): void {
    const { sample } = this.live;
    const back_s = this.time_s === null || !sample ? 0 : this.time_s - sample.time_s;
    if (document.activeElement !== this.slider || this.time_s === null) this.slider.value = String(back_s);
    setText(this.clock, this.time_s === null ? `${sample?.time_s.toFixed(1) ?? '0.0'} s` : `${back_s.toFixed(1)} s: NOT NOW`);
  }

  private slid(): void {
    const { sample } = this.live;
    const back_s = Number(this.slider.value);
    this.goTo(sample && back_s < 0 ? sample.time_s + back_s : null);
  }
}
