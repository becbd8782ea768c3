// Who moves the arm, and the buttons of its operating states, each with what it will do.
import type { Connection } from '../live/connection';
import type { Live } from '../live/live';
import { NameForm } from '../live/display_name';
import type { Ask } from '../live/pending_command';
import { h, setClass, setText } from '../ui/dom';
import { ACTIONS, roleBlocked, type Action } from './actions';

export class MotionPanel {
  readonly element: HTMLElement;
  private readonly owner = h('p', { class: 'owner' });
  private readonly hint = h('p', { class: 'hint does', id: 'what-it-does' });
  private readonly buttons: HTMLButtonElement[];

  constructor(private readonly live: Live, connection: Connection, ask: Ask) {
    this.buttons = ACTIONS.map((action) => {
      const tell = () => this.explain(action);
      return h('button', {
        type: 'button', 'data-action': action.name, 'aria-describedby': 'what-it-does', onfocus: tell, onpointerenter: tell,
        onclick: () => ask(action.name, action.request),
      }, action.name);
    });
    setText(this.hint, 'What a button will do stands here when you point at it.');
    this.element = h('section', { class: 'card', 'aria-label': 'Motion' }, h('h2', {}, 'Motion'), this.owner, h('div', { class: 'buttons' }, ...this.buttons), this.hint, new NameForm(live, connection).element);
  }

  private explain(action: Action): void {
    const why = roleBlocked(this.live.welcome?.role) || action.blocked(this.live.facts, this.live.isMine);
    setText(this.hint, `${action.name}: ${action.does}${why ? ` Not now: ${why}` : ''}`);
  }

  update(now_s: number): void {
    const { facts, welcome, isMine } = this.live;
    const role = roleBlocked(welcome?.role);
    const whose = isMine ? `Motion is yours (${welcome!.name}).` : facts.owner ? `Motion is owned by ${facts.owner}.` : 'Nobody owns motion.';
    setText(this.owner, role || (this.live.isLive(now_s) ? whose : 'Nothing is heard from the arm: who owns motion now is not known.'));
    ACTIONS.forEach((action, i) => {
      const why = role || action.blocked(facts, isMine);
      const button = this.buttons[i];
      // Not `disabled`: what is shown may be old, and lianad's answer says more; so it is asked for all the same.
      setClass(button, 'blocked', why !== '');
      if (button.title !== (why || action.does)) button.title = why || action.does;
    });
  }
}
