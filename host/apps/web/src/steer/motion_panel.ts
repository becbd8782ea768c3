// Who moves the arm, and the buttons of its operating states, each with what it will do.
import type { Connection } from '../live/connection';
import type { Live } from '../live/live';
import { NameForm } from '../live/display_name';
import type { Ask } from '../live/pending_command';
import { h, set_class, set_text } from '../ui/dom';
import { kActions, role_blocked, type Action } from './actions';

export class MotionPanel {
  readonly element: HTMLElement;
  private readonly owner = h('p', { class: 'owner' });
  private readonly hint = h('p', { class: 'hint does', id: 'what-it-does' });
  private readonly buttons: HTMLButtonElement[];

  constructor(private readonly live: Live, connection: Connection, ask: Ask) {
    this.buttons = kActions.map((action) => {
      const tell = () => this.explain(action);
      return h('button', {
        type: 'button', 'data-action': action.name, 'aria-describedby': 'what-it-does', onfocus: tell, onpointerenter: tell,
        onclick: () => ask(action.name, action.request),
      }, action.name);
    });
    set_text(this.hint, 'What a button will do stands here when you point at it.');
    this.element = h('section', { class: 'card', 'aria-label': 'Motion' }, h('h2', {}, 'Motion'), this.owner, h('div', { class: 'buttons' }, ...this.buttons), this.hint, new NameForm(live, connection).element);
  }

  private explain(action: Action): void {
    const why = role_blocked(this.live.welcome?.role) || action.blocked(this.live.facts, this.live.is_mine);
    set_text(this.hint, `${action.name}: ${action.does}${why ? ` Not now: ${why}` : ''}`);
  }

  update(now_s: number): void {
    const { facts, welcome, is_mine } = this.live;
    const role = role_blocked(welcome?.role);
    const whose = is_mine ? `Motion is yours (${welcome!.name}).` : facts.owner ? `Motion is owned by ${facts.owner}.` : 'Nobody owns motion.';
    set_text(this.owner, role || (this.live.is_live(now_s) ? whose : 'Nothing is heard from the arm: who owns motion now is not known.'));
    kActions.forEach((action, i) => {
      const why = role || action.blocked(facts, is_mine);
      const button = this.buttons[i];
      // Not `disabled`: what is shown may be old, and lianad's answer says more; so it is asked for all the same.
      set_class(button, 'blocked', why !== '');
      if (button.title !== (why || action.does)) button.title = why || action.does;
    });
  }
}
