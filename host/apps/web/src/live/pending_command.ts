// What was last asked of the arm, and what became of it: taken, until the controller says how it ended.
import type { LianaEvent } from '../data/sample';
import { endingOf, refusalText, type Taken } from '../model/outcome_text';
import { spoken } from '../model/text';
import { h, setText } from '../ui/dom';
import type { Connection } from './connection';
import type { Live } from './live';
import type { Answer } from './protocol';

// Asks lianad for something that people know by the name `what`.
export type Ask = (what: string, request: { op: string; [field: string]: unknown }) => void;

export class PendingCommand {
  readonly element = h('p', { class: 'answer', role: 'status' });
  private what = '';
  private taken: Taken | null = null; // null: nothing is waited for
  private asked = 0;

  constructor(private readonly live: Live, private readonly connection: Connection) {}

  readonly ask: Ask = (what, request) => void this.send(what, request);

  // An error of something that nobody waits for.
  error(what: string, answer: Answer): void {
    this.taken = null;
    this.show(`${what}: ${spoken(answer.code ?? 'error')}: ${answer.message ?? ''}`, true);
  }

  // An event that has just happened: what verification refuses comes after the answer that a request was taken.
  event(event: LianaEvent): void {
    const words = this.taken ? '' : refusalText(event);
    if (words) this.show(`verification: ${words}`, true);
  }

  // A new life of lianad knows nothing of what was asked.
  forget(): void {
    this.taken = null;
    this.show('', false);
  }

  update(): void {
    const { live, taken } = this;
    if (!taken || !live.sample) return;
    const ending = endingOf(taken, { time_s: live.sample.time_s, facts: live.facts, isMine: live.isMine, events: live.events });
    if (!ending) return;
    this.taken = null;
    this.show(`${this.what}: ${ending.text}`, !ending.ok);
  }

  private async send(what: string, request: Parameters<Ask>[1]): Promise<void> {
    const { live } = this;
    const asked = ++this.asked;
    const lastEvent = live.newestEvent;
    const answer = await this.connection.request(request);
    if (asked !== this.asked) return; // something else was asked for meanwhile
    if (!answer.ok) return this.error(what, answer);
    const { op, command, device } = request as { op: string; command?: string; device?: string };
    this.what = what;
    this.taken = { op, command, device, time_s: live.sample?.time_s ?? 0, lastEvent };
    this.show(`${what}: taken`, false);
  }

  private show(text: string, isBad: boolean): void {
    this.element.classList.toggle('bad', isBad);
    setText(this.element, text);
  }
}
