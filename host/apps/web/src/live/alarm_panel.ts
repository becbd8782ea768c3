// Alarms with cause and next step, their consequences folded below; acknowledged together, by the name of who has seen
// them. What is over stands in one line until then.
import type { Alarm } from '../model/alarms';
import { h } from '../ui/dom';
import type { Live } from './live';
import { displayName } from './display_name';

const PRIORITIES = ['', 'act now', 'act soon', 'know'];

function article(alarm: Alarm): HTMLElement {
  const seen = alarm.acknowledgedBy !== '';
  const follows = alarm.follows ?? [];
  const count = follows.length === 0 ? 'cause' : `cause, and ${follows.length} consequence${follows.length === 1 ? '' : 's'}`;
  return h('article', { class: `alarm priority-${alarm.priority} ${seen ? 'quiet' : ''}` },
    h('strong', {}, alarm.title), h('span', { class: 'hint' }, seen ? `seen by ${alarm.acknowledgedBy}` : PRIORITIES[alarm.priority]),
    h('p', { class: 'todo' }, alarm.todo),
    h('details', {}, h('summary', {}, count), h('p', {}, alarm.cause), ...follows.map((title) => h('p', {}, title))));
}

export class AlarmPanel {
  readonly element = h('section', { class: 'alarms', 'aria-label': 'Alarms', 'aria-live': 'polite' });

  constructor(private readonly live: Live, private readonly changed: () => void) {}

  // After the alarms changed: what did not change is not drawn again, nor read aloud.
  update(): void {
    const alarms = this.live.alarms.list();
    const over = alarms.filter((alarm) => !alarm.isActive);
    const unseen = alarms.filter((alarm) => alarm.acknowledgedBy === '').length;
    const button = h('button', { type: 'button', class: 'seen', onclick: () => {
      this.live.alarms.acknowledgeAll(this.live.welcome?.name ?? displayName());
      this.changed();
    } }, unseen === 1 ? 'seen' : `all ${unseen} seen`);
    this.element.hidden = alarms.length === 0;
    this.element.replaceChildren(...(unseen > 0 ? [button] : []), ...alarms.filter((alarm) => alarm.isActive).map(article),
      ...(over.length > 0 ? [h('p', { class: 'over hint' }, `over: ${over.map((alarm) => alarm.title).join('; ')}`)] : []));
  }
}
