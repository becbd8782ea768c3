// Commands with both verdicts and their margins: those that were refused, and samples of the others.
import type { Command, Judged, Run } from '../data/run';
import { lengthText, spoken } from '../model/text';
import { checkbox, h } from '../ui/dom';

const AT_MOST = 400; // rows in the page at a time

function judgedText(judged: Judged | null): string {
  if (!judged) return 'not asked';
  return judged.code !== 0 ? `refused, ${judged.code}` : `${(100 * judged.share).toFixed(0)} %`;
}

function marginsText(margins: Record<string, number | null> | undefined): string {
  if (!margins) return '';
  return Object.entries(margins)
    .filter((entry): entry is [string, number] => entry[1] !== null)
    .map(([name, value]) => {
      const [, what, unit] = /^(.*?)(?:_(m|deg|deg_s|N|us))?$/.exec(name) ?? [];
      return unit === 'm' ? `${what} ${lengthText(value)}` : `${spoken(what)} ${Number(value.toPrecision(3))} ${(unit ?? '').replace('_', '/')}`;
    })
    .join(', ');
}

export class CommandList {
  readonly element: HTMLElement;
  private readonly body = h('tbody');
  private refusedOnly = false;

  constructor(private readonly run: Run, private readonly goTo: (time_s: number) => void) {
    const heads = ['time', 'command', 'controller', 'simulation', 'margins'];
    const refused = run.head.commands.filter((c) => c.refusal).length;
    const choice = checkbox(`only the ${refused} refused`, (on) => {
      this.refusedOnly = on;
      this.fill();
    });
    this.element = h('div', { class: 'panel commands' },
      h('div', { class: 'filter' }, choice, h('span', { class: 'hint' }, 'share of the nearest limit that each of the two verdicts found')),
      h('table', {}, h('thead', {}, h('tr', {}, ...heads.map((text) => h('th', { scope: 'col' }, text)))), this.body));
    this.fill();
  }

  private fill(): void {
    const shown = this.run.head.commands.filter((c) => !this.refusedOnly || c.refusal);
    const every = Math.max(1, Math.ceil(shown.length / AT_MOST));
    this.body.replaceChildren(...shown.filter((c, i) => c.refusal || i % every === 0).map((c) => this.row(c)));
  }

  private row(command: Command): HTMLElement {
    const time_s = command.tick * this.run.head.period_s;
    const link = h('button', { type: 'button', class: 'link', onclick: () => this.goTo(time_s) }, `${time_s.toFixed(2)} s`);
    const { refusal } = command;
    const last = refusal ? h('td', {}, h('strong', {}, `${refusal.code ?? ''} ${refusal.name ?? ''}`), ` ${refusal.text} `, h('em', {}, refusal.remedy ?? '')) : h('td', {}, marginsText(command.simulation?.margins));
    return h('tr', { class: refusal ? 'bad' : '' }, h('td', {}, link), h('td', {}, `${command.command || ''} ${command.kind} (${command.owner})`),
      h('td', {}, judgedText(command.execution)), h('td', {}, judgedText(command.simulation)), last);
  }
}
