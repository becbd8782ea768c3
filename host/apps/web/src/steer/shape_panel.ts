// Shape of a cable arm: where a node should be while the tip stays, and pitch angles that are held.
import { value, values } from '../data/sample';
import type { Live } from '../live/live';
import type { Ask } from '../live/pending_command';
import { feedCount, type CableRobot } from '../model/robot';
import { h, setText } from '../ui/dom';

export class ShapePanel {
  readonly element: HTMLElement;
  private readonly node: HTMLSelectElement;
  private readonly fields: HTMLInputElement[];
  private readonly missing = h('span', { class: 'hint' });
  private readonly boxes: HTMLInputElement[];
  private readonly heldNow = h('span', { class: 'hint' });

  constructor(private readonly live: Live, robot: CableRobot, ask: Ask) {
    const base = feedCount(robot) / 2;
    const nodes = robot.segments.slice(0, -1).map((_, m) => base + m + 1);
    this.node = h('select', { 'aria-label': 'node', onchange: () => this.take() }, ...nodes.map((n) => h('option', { value: n, selected: n === 3 }, `node ${n}`)));
    this.fields = ['x', 'y', 'z'].map((axis) => h('input', { type: 'number', step: 0.01, 'aria-label': `${axis} of the node in metres`, class: 'metres' }));
    const search = h('input', { type: 'checkbox' });
    const place = () => this.fields.map((field) => Number(field.value));
    this.boxes = robot.segments.map((_, m) => h('input', { type: 'checkbox', 'aria-label': `hold the pitch of segment ${base + m + 1} at 0` }));
    const held = () => this.boxes.flatMap((box, m) => (box.checked ? [{ theta: 2 * (base + m) + 1, target_deg: 0 }] : []));
    this.element = h('section', { class: 'card', 'aria-label': 'Shape' }, h('h2', {}, 'Shape'),
      h('div', { class: 'filter' }, this.node, ...this.fields, ' m'),
      h('div', { class: 'filter' },
        h('button', { type: 'button', onclick: () => this.take() }, 'as it is now'),
        h('button', { type: 'button', onclick: () => ask('shape', { op: 'shape', nodes: [{ node: Number(this.node.value), position_m: place() }], search: search.checked }) }, 'go'),
        h('button', { type: 'button', onclick: () => ask('shape', { op: 'shape', nodes: [] }) }, 'no target'),
        h('label', { title: 'the best of all shapes is looked for first; the arm has to be at rest, and its middle may move far' }, search, 'search'), this.missing),
      h('div', { class: 'filter' }, 'hold pitch at 0: ', ...this.boxes.map((box, m) => h('label', {}, box, String(base + m + 1))),
        h('button', { type: 'button', title: 'held angles go to their targets slowly while the tip stays', onclick: () => ask('hold angles', { op: 'hold_theta', held: held() }) }, 'go'), this.heldNow));
  }

  update(): void {
    const { sample, facts } = this.live;
    const missing_m = value(sample, 'shape.missing_m');
    const searching = facts.shape?.searching ? 'searching; ' : '';
    setText(this.missing, Number.isFinite(missing_m) ? `${searching}missing ${(1000 * missing_m).toFixed(0)} mm${facts.shape?.settled ? ', settled' : ''}` : '');
    const held = facts.held ?? [];
    setText(this.heldNow, held.length === 0 ? 'now: none' : `now: theta ${held.join(', ')}${facts.held_at_target ? ', there' : ', on the way'}`);
  }

  private take(): void {
    if (!this.live.sample) return;
    const nodes = values(this.live.sample, 'node_m');
    const at = 3 * (Number(this.node.value) - 1);
    this.fields.forEach((field, r) => (field.value = nodes[at + r]?.toFixed(3) ?? ''));
  }
}
