// The events of a run, by kind; a click takes the scene there.
import type { Run } from '../data/run';
import { lastBefore } from '../data/run';
import { weightOf } from '../model/weight';
import { h, setClass } from '../ui/dom';

export class EventList {
  readonly element: HTMLElement;
  private readonly rows: HTMLElement[];
  private now = -1;

  constructor(private readonly run: Run, goTo: (time_s: number) => void) {
    const { events } = run;
    const { period_s } = run.head;
    this.rows = events.map((event) => {
      const time_s = event.tick * period_s;
      return h('li', { class: weightOf(event), 'data-kind': event.kind },
        h('button', { type: 'button', onclick: () => goTo(time_s) },
          h('span', { class: 'when' }, `${time_s.toFixed(2)} s`), h('span', { class: 'kind' }, event.kind), h('span', { class: 'text' }, event.text)));
    });
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
    const box = h('input', { type: 'checkbox', checked: true });
    box.addEventListener('change', () => {
      for (const row of this.rows) if (row.dataset.kind === kind) row.hidden = !box.checked;
    });
    return h('label', {}, box, kind);
  }
}
