// The mission that runs: its step, what it waits for, and the buttons that let it go on or end. Not there without one.
import type { Facts } from '../data/sample';
import type { Live } from '../live/live';
import type { Ask } from '../live/pending_command';
import { h, setClass, setText } from '../ui/dom';
import { roleBlocked } from './actions';

const COMMANDS = [
  ['confirm', 'What the step waits for has been done.'],
  ['resume', 'The paused mission goes on.'],
  ['pause', 'The mission pauses where its step allows it.'],
  ['step', 'The paused mission does one step.'],
  ['abort', 'The mission ends, and the arm comes to rest.'],
] as const;

type Command = (typeof COMMANDS)[number][0];

// Which of them do something now: one that waits for people can be confirmed or resumed, one that runs can pause.
export function missionCommands(facts: Facts): Command[] {
  if (!facts.step) return [];
  const waits = facts.step.waits ?? '';
  if (waits === '') return ['pause', 'abort'];
  return waits.startsWith('confirm') ? ['confirm', 'abort'] : ['resume', 'step', 'abort'];
}

export class MissionPanel {
  readonly element: HTMLElement;
  private readonly step = h('p');
  private readonly waits = h('p', { class: 'warning', role: 'status' });
  private readonly buttons: HTMLButtonElement[];

  constructor(private readonly live: Live, ask: Ask) {
    this.buttons = COMMANDS.map(([command, does]) =>
      h('button', { type: 'button', 'data-mission': command, title: does, onclick: () => ask(`mission ${command}`, { op: 'mission_control', command }) }, command));
    this.element = h('section', { class: 'card', 'aria-label': 'Mission', hidden: true }, h('h2', {}, 'Mission'), this.step, this.waits, h('div', { class: 'buttons' }, ...this.buttons));
  }

  update(): void {
    const { facts, welcome } = this.live;
    this.element.hidden = !facts.step;
    if (!facts.step) return;
    const { index, name, waits } = facts.step;
    setText(this.step, `Step ${index}: ${name}`);
    setText(this.waits, waits ? `Waits: ${waits}` : '');
    const useful = roleBlocked(welcome?.role) ? [] : missionCommands(facts);
    COMMANDS.forEach(([command], i) => setClass(this.buttons[i], 'blocked', !useful.includes(command)));
  }
}
