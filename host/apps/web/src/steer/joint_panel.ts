// Goals of all angles: by sliders, or a named pose of the robot table; nothing moves before "go". What nobody has touched
// stays where the arm is commanded to be.
import { values } from '../data/sample';
import type { Connection } from '../live/connection';
import type { Live } from '../live/live';
import type { Welcome } from '../live/protocol';
import type { Ask } from '../live/pending_command';
import { angleCount, angleName, angleRange_deg } from '../model/robot';
import { segmentColour } from '../scene/palette';
import { h, setText } from '../ui/dom';
import { PlannerOffer } from './planner_offer';
import { spoken } from '../model/text';

export class JointPanel {
  readonly element: HTMLElement;
  private readonly sliders: HTMLInputElement[];
  private readonly outputs: HTMLElement[];
  private readonly now: HTMLElement[];
  readonly planner: PlannerOffer;
  private readonly touched = new Set<number>();

  constructor(private readonly live: Live, welcome: Welcome, connection: Connection, ask: Ask, showWay: (places_m: Float32Array) => void) {
    const { robot } = welcome;
    this.planner = new PlannerOffer(live, welcome, connection, ask, showWay);
    const count = angleCount(robot);
    this.outputs = Array.from({ length: count }, () => h('output', {}));
    this.now = Array.from({ length: count }, () => h('span', { class: 'now' }));
    this.sliders = Array.from({ length: count }, (_, i) => {
      const [min, max] = angleRange_deg(robot, i);
      return h('input', { type: 'range', min, max, step: 0.1, value: 0, 'aria-label': `goal of ${angleName(robot, i)} in degrees`, oninput: () => this.touch(i) });
    });
    const rows = this.sliders.map((slider, i) =>
      h('div', { class: 'joint' }, h('span', { class: 'name', style: `border-color:${segmentColour(robot.kind === 'serial' ? i : i >> 1)}` }, angleName(robot, i)), slider, this.outputs[i], this.now[i]));
    const poses = h('select', { 'aria-label': 'named pose', onchange: () => this.set(robot.named_poses_deg[poses.value] ?? []) },
      h('option', { value: '' }, 'named pose'), ...Object.keys(robot.named_poses_deg).map((name) => h('option', { value: name }, spoken(name))));
    this.element = h('section', { class: 'card', 'aria-label': 'Angles' }, h('h2', {}, 'Angles [deg]'), ...rows,
      h('div', { class: 'filter' }, poses,
        h('button', { type: 'button', onclick: () => this.reset() }, 'as they are now'),
        h('button', { type: 'button', 'data-action': 'go', title: 'all angles together, verified, at most 2 deg/s', onclick: () => this.go(ask) }, 'go')),
      h('p', { class: 'hint' }, 'The whole way is checked before anything moves.'), this.planner.element);
  }

  // All sliders follow the arm again.
  reset(): void {
    this.touched.clear();
    this.update();
  }

  update(): void {
    const measured = values(this.live.sample, 'measured_js_deg');
    this.now.forEach((element, i) => setText(element, i < measured.length ? measured[i].toFixed(1) : ''));
    this.commanded_deg().forEach((angle_deg, i) => {
      if (!this.touched.has(i) && i < this.sliders.length) this.sliders[i].value = String(angle_deg);
    });
    this.planner.update();
    this.say();
  }

  private go(ask: Ask): void {
    const goal_deg = this.goal_deg();
    this.planner.asked(goal_deg);
    ask('angles', { op: 'move_jp', goal_deg });
  }

  private commanded_deg(): Float32Array {
    return values(this.live.sample, 'setpoint_js_deg');
  }

  private goal_deg(): number[] {
    const commanded = this.commanded_deg();
    return this.sliders.map((slider, i) => (this.touched.has(i) ? Number(slider.value) : commanded[i]));
  }

  private touch(i: number): void {
    this.touched.add(i);
    this.say();
  }

  private set(angles_deg: ArrayLike<number>): void {
    this.sliders.forEach((slider, i) => {
      if (angles_deg[i] === undefined) return;
      slider.value = String(angles_deg[i]);
      this.touched.add(i);
    });
    this.say();
  }

  private say(): void {
    this.outputs.forEach((output, i) => setText(output, Number(this.sliders[i].value).toFixed(1)));
  }
}
