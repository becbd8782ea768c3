// The card of an arm that pushes a payload or is led by its camera; not there for others.
import type { Sample } from '../data/sample';
import { pushLines } from '../model/force_control_text';
import type { Scene } from '../model/robot';
import { h, setText } from './dom';

export class PushCard {
  readonly element: HTMLElement;
  private readonly list = h('dl');

  constructor(private readonly scene: Scene) {
    const attributes = { class: 'card push', 'aria-label': 'Push and servo', hidden: true };
    this.element = h('section', attributes, h('h2', {}, 'Push and servo'), this.list);
  }

  show(sample: Sample): void {
    const lines = pushLines(sample, this.scene);
    if (this.list.children.length === 0) this.list.append(...lines.flatMap(([name]) => [h('dt', {}, name), h('dd')]));
    this.element.hidden = lines.every(([, text]) => text === '');
    lines.forEach(([, text], i) => {
      const [name, place] = [this.list.children[2 * i], this.list.children[2 * i + 1]] as HTMLElement[];
      name.hidden = place.hidden = text === '';
      setText(place, text);
    });
  }
}
