// The runs that the gateway has recorded, each a page of its own.
import { h } from '../ui/dom';

interface Entry {
  name: string;
  title?: string;
  outcome?: string;
}

export class RunList {
  readonly element = h('div', { class: 'panel' }, h('p', { class: 'hint' }, 'asking for the recorded runs'));

  // Asks the gateway again.
  async load(): Promise<void> {
    try {
      const answer = await fetch('runs');
      if (!answer.ok) throw new Error(`${answer.status} ${answer.statusText}`);
      const found = (await answer.json()) as { runs?: (Entry | string)[] } | (Entry | string)[];
      const runs = (Array.isArray(found) ? found : found.runs ?? []).map((run) => (typeof run === 'string' ? { name: run } : run));
      const rows = runs.map((run) => h('li', {}, h('a', { href: `run/${encodeURIComponent(run.name)}`, target: '_blank', rel: 'noopener' }, run.title ?? run.name), run.outcome ? ` ${run.outcome}` : ''));
      this.element.replaceChildren(rows.length > 0 ? h('ol', {}, ...rows) : h('p', { class: 'hint' }, 'No run is recorded yet: liana run makes one.'));
    } catch (error) {
      this.element.replaceChildren(h('p', { class: 'hint' }, `No list of runs: ${String(error)}`));
    }
  }
}
