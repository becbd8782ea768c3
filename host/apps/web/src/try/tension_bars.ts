// Tension of every cable as a bar: how high, and in the colours of the scene.
import type { CableRobot } from '../model/robot';
import { css, scaleOf, tensionColour } from '../model/tension_colour';
import { segmentColour } from '../scene/palette';
import { h, setText } from '../ui/dom';

export class TensionBars {
  readonly element: HTMLElement;
  private readonly bars: HTMLElement[] = [];
  private readonly words = h('p', { class: 'hint' });
  private readonly scale;

  constructor(robot: CableRobot) {
    this.scale = scaleOf(robot.tension);
    const groups = robot.cables.phase_deg.map((phases, segment) => {
      const bars = phases.map(() => h('i', { class: 'tension' }));
      this.bars.push(...bars);
      return h('div', { class: 'tension-group', style: `border-color:${segmentColour(segment)}` }, ...bars);
    });
    this.element = h('section', { class: 'card', 'aria-label': 'Cable tensions' }, h('h2', {}, 'Cable tensions, segments 1 to 5'),
      h('div', { class: 'tensions', 'aria-hidden': 'true' }, ...groups), this.words);
  }

  show(tension_N: Float32Array): void {
    const { low_N, high_N } = this.scale;
    this.bars.forEach((bar, i) => {
      bar.style.height = `${Math.round(100 * Math.min(1, tension_N[i] / high_N))}%`;
      bar.style.background = css(tensionColour(tension_N[i], this.scale));
    });
    const [min, max] = [Math.min(...tension_N), Math.max(...tension_N)];
    setText(this.words, `${min.toFixed(0)} to ${max.toFixed(0)} N; allowed ${low_N} to ${high_N} N`);
  }
}
