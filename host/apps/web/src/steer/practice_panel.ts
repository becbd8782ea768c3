// Faults by a click, to practise on an arm that the console simulates. The bench lets them happen; nothing else knows of
// them before it is measured.
import type { Connection } from '../live/connection';
import type { Answer, FaultOn } from '../live/protocol';
import { driveText, segmentsOf } from '../model/drive_names';
import { feedCount, type Robot } from '../model/robot';
import { spoken } from '../model/text';
import { h, setText } from '../ui/dom';

interface Kind {
  kind: string;
  text: string;
  ofCable?: boolean;
  stays?: boolean; // nothing here repairs it
  with?: Record<string, number>;
}

const KINDS: readonly Kind[] = [
  { kind: 'cable_break', text: 'a cable breaks', ofCable: true, stays: true },
  { kind: 'slack', text: 'a cable slips to slack', ofCable: true },
  { kind: 'silent', text: 'a drive is lost' },
  { kind: 'fault', text: 'a drive reports over-current' },
  { kind: 'encoder_jump', text: 'an encoder jumps', with: { counts: 5000 }, stays: true },
];

// What can happen to an arm of this kind.
export function kindsFor(robot: Robot): readonly Kind[] {
  return robot.kind === 'serial' ? KINDS.filter((kind) => !kind.ofCable) : KINDS;
}

// Drives (from 1) that a fault of this kind can happen to.
export function drivesFor(robot: Robot, kind: Kind): number[] {
  const count = robot.kind === 'serial' ? robot.joints.length : segmentsOf(robot).length;
  const first = kind.ofCable && robot.kind !== 'serial' ? feedCount(robot) + 1 : 1; // the base's drives have no cables
  return Array.from({ length: count - first + 1 }, (_, i) => first + i);
}

// "a cable breaks: drive 5 (node 5, segment 2), until the console is started again"
export function faultText(fault: FaultOn, robot: Robot): string {
  const known = KINDS.find((kind) => kind.kind === fault.kind);
  const what = known?.text ?? spoken(fault.kind);
  const where = fault.drives.map((drive) => driveText(drive - 1, robot)).join(', ');
  const until = fault.can_end ? ', until it is repaired' : known?.stays ? ', until the console is started again' : ', once';
  return `${where ? `${what}: ${where}` : what}${until}`;
}

export class PracticePanel {
  readonly element: HTMLElement;
  private readonly kind: HTMLSelectElement;
  private readonly drive = h('select', { 'aria-label': 'drive of the fault' });
  private readonly list = h('ul', { class: 'practice' });
  private readonly answer = h('p', { class: 'hint', role: 'status' });

  constructor(private readonly robot: Robot, private readonly connection: Connection) {
    this.kind = h('select', { 'aria-label': 'fault', onchange: () => this.offerDrives() }, ...kindsFor(robot).map(({ kind, text }) => h('option', { value: kind }, text)));
    this.offerDrives();
    this.element = h('section', { class: 'card', 'aria-label': 'Practice' }, h('h2', {}, 'Practice'),
      h('p', { class: 'hint' }, 'Faults of the simulated arm.'),
      h('div', { class: 'filter' }, this.kind, this.drive,
        h('button', { type: 'button', 'data-action': 'let it happen', onclick: () => void this.begin() }, 'let it happen'),
        h('button', { type: 'button', 'data-action': 'repair', title: 'ends what can end; a broken cable cannot', onclick: () => void this.send({ end: true }) }, 'repair')),
      this.list, this.answer);
    void this.send({ faults: [] });
  }

  private chosen(): Kind {
    return KINDS.find(({ kind }) => kind === this.kind.value) ?? KINDS[0];
  }

  private offerDrives(): void {
    const options = drivesFor(this.robot, this.chosen()).map((drive) => h('option', { value: drive }, driveText(drive - 1, this.robot)));
    this.drive.replaceChildren(...options);
  }

  private begin(): Promise<void> {
    const { kind, with: parameters } = this.chosen();
    return this.send({ faults: [{ kind, drive: Number(this.drive.value), ...parameters }] });
  }

  private async send(what: { faults: object[] } | { end: true }): Promise<void> {
    const answer: Answer = await this.connection.request({ op: 'practice', ...what });
    setText(this.answer, answer.ok ? '' : `Not done: ${answer.message ?? ''}`);
    if (!answer.ok) return;
    const on = (answer.answer?.on ?? []) as FaultOn[];
    this.list.replaceChildren(...on.map((fault) => h('li', {}, faultText(fault, this.robot))));
  }
}
