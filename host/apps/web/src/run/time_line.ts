// The time of a run as a line: steps as blocks, events as marks, play, speed, and where the scene is.
import type { Run } from '../data/run';
import { weightOf } from '../model/weight';
import { h, setText } from '../ui/dom';

const SPEEDS = [0.5, 1, 2, 4, 8, 16];
const FIRST_SPEED = 3;
const KEY_STEP_S = 1;
const SHIFT_STEP_S = 10;

export class TimeLine {
  readonly element: HTMLElement;
  time_s: number;
  private playing = false;
  private last_ms = 0;
  private readonly from_s: number;
  private readonly to_s: number;
  private readonly button = h('button', { type: 'button', class: 'play', onclick: () => this.play(!this.playing) });
  private readonly speed = h('select', { 'aria-label': 'speed' }, ...SPEEDS.map((s, i) => h('option', { value: s, selected: i === FIRST_SPEED }, `${s}\u00d7`)));
  private readonly clock = h('output', { class: 'clock', 'aria-live': 'off' });
  private readonly slider: HTMLInputElement;
  private readonly needle = h('div', { class: 'needle' });

  constructor(private readonly run: Run, private readonly moved: (time_s: number) => void) {
    this.from_s = run.time_s(0);
    this.to_s = Math.max(this.from_s + 1e-3, run.time_s(run.rows - 1));
    this.time_s = this.from_s;
    this.slider = h('input', {
      type: 'range', min: this.from_s, max: this.to_s, step: 0.04, value: this.from_s, 'aria-label': 'time of the run',
      oninput: () => this.goTo(Number(this.slider.value)), onkeydown: (event: KeyboardEvent) => this.key(event),
    });
    const track = h('div', { class: 'track' }, ...this.steps(), ...this.marks(), this.needle, this.slider);
    this.element = h('footer', { class: 'time-line', 'aria-label': 'time' }, this.button, this.speed, this.clock, track);
    this.say();
  }

  goTo(time_s: number): void {
    this.time_s = Math.max(this.from_s, Math.min(this.to_s, time_s));
    this.say();
    this.moved(this.time_s);
  }

  play(on: boolean): void {
    if (on && this.time_s >= this.to_s) this.time_s = this.from_s;
    const begins = on && !this.playing;
    this.playing = on;
    this.say();
    if (begins) requestAnimationFrame((now_ms) => this.begin(now_ms));
  }

  // Keys that work wherever the focus is; true when the key was one of them.
  key(event: KeyboardEvent): boolean {
    const step_s = event.shiftKey ? SHIFT_STEP_S : KEY_STEP_S;
    if (event.key === ' ') this.play(!this.playing);
    else if (event.key === 'ArrowRight') this.goTo(this.time_s + step_s);
    else if (event.key === 'ArrowLeft') this.goTo(this.time_s - step_s);
    else if (event.key === 'Home') this.goTo(this.from_s);
    else if (event.key === 'End') this.goTo(this.to_s);
    else return false;
    event.preventDefault();
    event.stopPropagation();
    return true;
  }

  private begin(now_ms: number): void {
    this.last_ms = now_ms;
    this.next(now_ms);
  }

  private next(now_ms: number): void {
    if (!this.playing) return;
    this.goTo(this.time_s + ((now_ms - this.last_ms) / 1000) * Number(this.speed.value));
    this.last_ms = now_ms;
    if (this.time_s >= this.to_s) this.play(false);
    else requestAnimationFrame((next_ms) => this.next(next_ms));
  }

  private say(): void {
    setText(this.button, this.playing ? '\u275a\u275a' : '\u25b6');
    this.button.setAttribute('aria-label', this.playing ? 'pause' : 'play');
    this.button.title = this.playing ? 'pause (space)' : 'play (space)';
    this.slider.value = String(this.time_s);
    this.slider.setAttribute('aria-valuetext', `${this.time_s.toFixed(1)} seconds`);
    setText(this.clock, `${this.time_s.toFixed(1)} / ${this.to_s.toFixed(1)} s`);
    this.needle.style.left = `${this.percent(this.time_s)}%`;
  }

  private percent(time_s: number): number {
    return (100 * (time_s - this.from_s)) / (this.to_s - this.from_s);
  }

  private steps(): HTMLElement[] {
    const { steps, period_s } = this.run.head;
    return steps.map((step, i) => {
      const begin = this.percent(step.tick * period_s);
      const end = i + 1 < steps.length ? this.percent(steps[i + 1].tick * period_s) : 100;
      return h('div', { class: `step step-${i % 2}`, style: `left:${begin}%;width:${end - begin}%`, title: `step ${step.index}: ${step.name}` },
        `${step.index} ${step.name}`);
    });
  }

  private marks(): HTMLElement[] {
    return this.run.events
      .filter((event) => event.kind !== 'step')
      .map((event) => h('div', { class: `mark ${weightOf(event)}`, style: `left:${this.percent(event.tick * this.run.head.period_s)}%` }));
  }
}
