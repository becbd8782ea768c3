// The events of a run, by kind; a click takes the scene there.
import type { Run } from '../data/run';
import { lastBefore } from '../data/run';
import { checkbox, h, setClass } from '../ui/dom';
import { eventRow } from '../ui/event_row';

export class EventList {
  readonly element: HTMLElement;
  private readonly rows: HTMLElement[];
  private now = -1;

  constructor(private readonly run: Run, goTo: (time_s: number) => void) {
    const { events } = run;
    const { period_s } = run.head;
    this.rows = events.map((event) => eventRow(event, period_s, goTo));
    const kinds = [...new Set(events.map((event) => event.kind))];
    const filter = h('div', { class: 'filter', role: 'group', 'aria-label': 'kinds of events' }, ...kinds.map((kind) => this.choice(kind)));
    this.element = h('div', { class: 'panel events' }, filter, h('ol', {}, ...this.rows));
  }

  // Marks the last event before this tick.
  at(tick: number): void {
    const now = lastBefore(this.run.events, tick);
    if (now === this.now) return;
    if (this.now >= 0) setClass(this.rows[this.now], 'now', false);
    if (now >= 0) setClass(this.rows[now], 'now', true);
    this.now = now;
  }

  private choice(kind: string): HTMLElement {
    return checkbox(kind, (on) => {
      for (const row of this.rows) if (row.dataset.kind === kind) row.hidden = !on;
    }, true);
  }
}
