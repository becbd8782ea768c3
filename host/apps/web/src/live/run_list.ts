// The runs that the gateway has recorded, each a page of its own.
import { h } from '../ui/dom';

interface Entry {
  name: string;
  changed_s: number;
  page: boolean; // it has one
  ticket?: string; // for this page alone, where the gateway asks for tokens
}

const ticketQuery = (ticket: string | undefined) => (ticket ? `?ticket=${encodeURIComponent(ticket)}` : '');

export class RunList {
  readonly element = h('div', { class: 'panel' });

  // `ticket`: of the welcome, where the gateway asks for tokens.
  constructor(private readonly ticket: string | undefined) {}

  // Asks the gateway again.
  async load(): Promise<void> {
    try {
      const answer = await fetch(`runs${ticketQuery(this.ticket)}`);
      if (answer.status === 404) return this.say('This gateway shows no recorded runs.');
      if (!answer.ok) throw new Error(`${answer.status} ${answer.statusText}`);
      const runs = (await answer.json()) as Entry[];
      if (runs.length === 0) return this.say('No run is recorded yet: liana run makes one.');
      this.element.replaceChildren(h('ol', { class: 'runs' }, ...runs.map((run) => this.row(run))));
    } catch (error) {
      this.say(`No list of runs: ${String(error)}`);
    }
  }

  private row(run: Entry): HTMLElement {
    const when = new Date(1000 * run.changed_s).toLocaleString();
    const link = h('a', { href: `run/${encodeURIComponent(run.name)}${ticketQuery(run.ticket)}`, target: '_blank', rel: 'noopener' }, run.name);
    return h('li', {}, run.page ? link : `${run.name} (no page)`, h('span', { class: 'hint' }, ` ${when}`));
  }

  private say(text: string): void {
    this.element.replaceChildren(h('p', { class: 'hint' }, text));
  }
}
