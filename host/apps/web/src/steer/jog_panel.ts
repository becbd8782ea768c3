// The tip by buttons: a short press is a step along a verified line, a long one jogs while it is held.
import { isKnown, values } from '../data/sample';
import type { Live } from '../live/live';
import type { Ask } from '../live/pending_command';
import { moved } from '../model/vector';
import { h } from '../ui/dom';
import type { Jogger } from './jogger';
import { JOGS, type Direction } from './keyboard';

const LONG_MS = 300;
const STEPS_MM = [1, 5, 20, 50, 100];
const SPEEDS_MM_S = [5, 15, 30, 60, 100];
const TURN_OF_SPEED = 3; // rad/s for a speed of 1 m/s: 30 mm/s turns 5 deg/s

export class JogPanel {
  readonly element: HTMLElement;
  private step_m = 0.02;
  private step_rad = 0.06;

  constructor(private readonly live: Live, private readonly jogger: Jogger, private readonly ask: Ask) {
    const steps = h('select', { 'aria-label': 'step of a short press', onchange: () => this.setStep(Number(steps.value)) },
      ...STEPS_MM.map((s) => h('option', { value: s, selected: s === 20 }, `${s} mm, ${(s * 0.18).toFixed(1)} deg`)));
    const speeds = h('select', { 'aria-label': 'speed while held', onchange: () => this.setSpeed(Number(speeds.value)) },
      ...SPEEDS_MM_S.map((s) => h('option', { value: s, selected: s === 30 }, `${s} mm/s`)));
    const frame = h('select', { 'aria-label': 'axes', onchange: () => (jogger.speed = { ...jogger.speed, inTip: frame.value === 'tip' }) },
      h('option', { value: 'base' }, 'axes of the base'), h('option', { value: 'tip' }, 'axes of the tip'));
    this.setStep(20);
    this.setSpeed(30);
    this.element = h('section', { class: 'card', 'aria-label': 'Tip' }, h('h2', {}, 'Tip'),
      h('div', { class: 'filter' }, frame, h('label', {}, 'step ', steps), h('label', {}, 'speed ', speeds)),
      h('div', { class: 'jog' }, ...JOGS.map(([name, direction, key]) => this.button(name, direction, key))),
      h('p', { class: 'hint' }, 'Press for a step, hold to move; or hold the key; or drag the ball at the tip in the scene. Letting go holds the arm.'));
  }

  private setStep(step_mm: number): void {
    this.step_m = step_mm / 1000;
    this.step_rad = (step_mm * 0.18 * Math.PI) / 180;
  }

  private setSpeed(speed_mm_s: number): void {
    this.jogger.speed = { ...this.jogger.speed, tip_m_s: speed_mm_s / 1000, turn_rad_s: (TURN_OF_SPEED * speed_mm_s) / 1000 };
  }

  private button(name: string, direction: Direction, key: string): HTMLElement {
    let timer = 0;
    let held = false;
    const release = () => {
      window.clearTimeout(timer);
      if (held) this.jogger.release(name);
    };
    return h('button', {
      type: 'button', title: `key ${key}`, 'data-jog': name,
      onpointerdown: () => {
        held = false;
        timer = window.setTimeout(() => {
          held = true;
          this.jogger.press(name, direction);
        }, LONG_MS);
      },
      onpointerup: release, onpointercancel: release, onpointerleave: release,
      onclick: () => {
        if (!held) this.step(name, direction);
        held = false;
      },
    }, name, h('kbd', {}, key));
  }

  private step(name: string, direction: Direction): void {
    const commanded = values(this.live.sample, 'setpoint_cp');
    if (!isKnown(commanded)) return;
    const way = direction.slice(0, 3).map((d) => d * this.step_m);
    const turn = direction.slice(3).map((d) => d * this.step_rad);
    const goal = moved(commanded, way, turn, this.jogger.speed.inTip);
    this.ask(`step ${name}`, { op: 'move_cp', goal });
  }
}
