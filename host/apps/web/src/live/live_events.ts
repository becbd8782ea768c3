// Events as they come, newest first; a click takes the scene to that moment while it is in the last minute.
import type { LianaEvent } from '../data/sample';
import { weightOf } from '../model/weight';
import { h } from '../ui/dom';
import { eventRow } from '../ui/event_row';
import type { Live } from './live';

const SHOWN = 200;
type Which = 'all' | 'faults and stops' | 'refusals and troubles' | 'steps and people';

const WHICH: Record<Which, (event: LianaEvent) => boolean> = {
  all: () => true,
  'faults and stops': (event) => weightOf(event) === 'bad',
  'refusals and troubles': (event) => weightOf(event) === 'warning',
  'steps and people': (event) => ['step', 'operator', 'owner', 'tool', 'client'].includes(event.kind),
};

export class LiveEvents {
  readonly element: HTMLElement;
  private readonly list = h('ol', { 'aria-live': 'off' });
  private which: Which = 'all';
  private drawn = -1;

  constructor(private readonly live: Live, private readonly goTo: (time_s: number) => void) {
    const choice = h('select', { 'aria-label': 'which events', onchange: () => {
      this.which = choice.value as Which;
      this.drawn = -1;
      this.update();
    } }, ...Object.keys(WHICH).map((name) => h('option', { value: name }, name)));
    this.element = h('div', { class: 'events' }, h('div', { class: 'filter' }, choice), this.list);
  }

  update(): void {
    const { events, welcome, lostEvents, takenEvents } = this.live;
    if (takenEvents === this.drawn || !welcome) return;
    this.drawn = takenEvents;
    const rows = events.filter(WHICH[this.which]).slice(-SHOWN).reverse().map((event) => eventRow(event, welcome.period_s, this.goTo));
    if (lostEvents > 0) rows.push(h('li', { class: 'warning' }, `${lostEvents} events before were not kept by lianad`));
    this.list.replaceChildren(...rows);
  }
}
