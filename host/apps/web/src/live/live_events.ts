// Events as they come, newest first; a click takes the scene to that moment while it is in the last minute.
import type { LianaEvent } from '../data/sample';
import { weight_of } from '../model/weight';
import { h } from '../ui/dom';
import type { Live } from './live';

const kShown = 200;
type Which = 'all' | 'faults and stops' | 'refusals and troubles' | 'steps and people';

const kWhich: Record<Which, (event: LianaEvent) => boolean> = {
  all: () => true,
  'faults and stops': (event) => weight_of(event) === 'bad',
  'refusals and troubles': (event) => weight_of(event) === 'warning',
  'steps and people': (event) => ['step', 'operator', 'owner', 'tool', 'client'].includes(event.kind),
};

export class LiveEvents {
  readonly element: HTMLElement;
  private readonly list = h('ol', { 'aria-live': 'off' });
  private which: Which = 'all';
  private drawn = -1;

  constructor(private readonly live: Live, private readonly go_to: (time_s: number) => void) {
    const choice = h('select', { 'aria-label': 'which events', onchange: () => {
      this.which = choice.value as Which;
      this.drawn = -1;
      this.update();
    } }, ...Object.keys(kWhich).map((name) => h('option', { value: name }, name)));
    this.element = h('div', { class: 'events' }, h('div', { class: 'filter' }, choice), this.list);
  }

  update(): void {
    const { events, welcome, lost_events, taken_events } = this.live;
    if (taken_events === this.drawn || !welcome) return;
    this.drawn = taken_events;
    const rows = events.filter(kWhich[this.which]).slice(-kShown).reverse().map((event) => this.row(event, welcome.period_s));
    if (lost_events > 0) rows.push(h('li', { class: 'warning' }, `${lost_events} events before were not kept by lianad`));
    this.list.replaceChildren(...rows);
  }

  private row(event: LianaEvent, period_s: number): HTMLElement {
    const time_s = event.tick * period_s;
    return h('li', { class: weight_of(event) },
      h('button', { type: 'button', onclick: () => this.go_to(time_s) },
        h('span', { class: 'when' }, `${time_s.toFixed(2)} s`), h('span', { class: 'kind' }, event.kind), h('span', { class: 'text' }, event.text)));
  }
}
