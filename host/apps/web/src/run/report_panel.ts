// The report of a run as a table that people read.
import type { RunHead } from '../data/run';
import { h } from '../ui/dom';
import { spoken } from '../model/text';

function row(name: string, ...cells: string[]): HTMLElement {
  return h('tr', {}, h('th', { scope: 'row' }, name), ...cells.map((text) => h('td', {}, text)));
}

function figure(value: number): string {
  return String(Number(value.toPrecision(4)));
}

export function reportPanel(head: RunHead): HTMLElement {
  const { report } = head;
  if (!report) return h('div', { class: 'panel report' }, h('p', {}, 'The run left no report.'));
  const steps = (report.steps ?? []).map((s, i) => row(`${i + 1} ${s.name}`, s.device, `${s.duration_s.toFixed(1)} s`, s.outcome, s.reason));
  const criteria = (report.criteria ?? []).map((c) => row(spoken(c.name), figure(c.value), `limit ${figure(c.limit)}`, c.met ? 'met' : 'not met'));
  const rest = Object.entries(report).filter((entry): entry is [string, string | number] => ['string', 'number'].includes(typeof entry[1]));
  return h('div', { class: 'panel report' },
    h('h2', {}, 'Steps'), h('table', {}, h('tbody', {}, ...steps)),
    criteria.length > 0 ? h('h2', {}, 'Criteria') : null, h('table', {}, h('tbody', {}, ...criteria)),
    h('h2', {}, 'Figures'), h('table', {}, h('tbody', {}, ...rest.map(([name, value]) => row(name, typeof value === 'number' ? figure(value) : value)))));
}
