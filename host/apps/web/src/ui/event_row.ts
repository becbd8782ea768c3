// An event in a list; a click takes the scene to its moment.
import type { LianaEvent } from '../data/sample';
import { weightOf } from '../model/weight';
import { spoken } from '../model/text';
import { h } from './dom';

export function eventRow(event: LianaEvent, period_s: number, goTo: (time_s: number) => void): HTMLElement {
  const time_s = event.tick * period_s;
  return h('li', { class: weightOf(event), 'data-kind': event.kind },
    h('button', { type: 'button', onclick: () => goTo(time_s) },
      h('span', { class: 'when' }, `${time_s.toFixed(2)} s`), h('span', { class: 'kind' }, spoken(event.kind)), h('span', { class: 'text' }, event.text)));
}
