// The emergency stop: one button that is always there, one key (Escape), and what the controller acknowledged.
import { h, setText } from '../ui/dom';
import type { Connection } from './connection';
import type { Live } from './live';

const ACKNOWLEDGED_FOR_MS = 60000;

export class StopButton {
  readonly element: HTMLElement;
  onPress: () => void = () => {}; // whatever else moves the arm lets go
  readonly report = h('output', { class: 'stop-report', 'aria-live': 'assertive' });
  private pressed_ms = NaN;
  private answered_ms = NaN;
  private isAnswered = false;

  constructor(private readonly live: Live, private readonly connection: Connection) {
    const button = h('button', { type: 'button', class: 'stop', title: 'stop, brakes, power off: at once (Escape)', onclick: () => void this.press() }, 'STOP ', h('kbd', {}, 'Esc'));
    this.element = h('div', { class: 'stop-place', role: 'region', 'aria-label': 'Emergency stop' }, button);
  }

  async press(): Promise<void> {
    this.onPress();
    this.pressed_ms = performance.now();
    this.isAnswered = false;
    setText(this.report, 'stop sent');
    const answer = await this.connection.stop('button or Escape in the console');
    this.answered_ms = performance.now();
    this.isAnswered = answer.ok;
    if (!answer.ok) setText(this.report, `NOT stopped: ${answer.message ?? answer.code}`);
    else this.update();
  }

  // Says when the controller took it and when the drives are off, by the state.
  update(): void {
    if (!this.isAnswered) return;
    const { facts, sample } = this.live;
    const took = `answered after ${Math.round(this.answered_ms - this.pressed_ms)} ms`;
    const by = facts.stop ? `, in force since tick ${facts.stop.tick} (${facts.stop.by})` : '';
    setText(this.report, `stop ${took}${by}${facts.state ? `, ${facts.state}` : ''}`);
    if (performance.now() - this.pressed_ms > ACKNOWLEDGED_FOR_MS && !facts.stop && sample) {
      this.isAnswered = false;
      setText(this.report, '');
    }
  }
}
