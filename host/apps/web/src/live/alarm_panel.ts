// Alarms with cause and next step; each is acknowledged by the name of who has seen it.
import { h } from '../ui/dom';
import type { Live } from './live';
import { displayName } from './display_name';

const PRIORITIES = ['', 'act now', 'act soon', 'know'];

export class AlarmPanel {
  readonly element = h('section', { class: 'alarms', 'aria-label': 'Alarms', 'aria-live': 'polite' });

  constructor(private readonly live: Live, private readonly changed: () => void) {}

  // After the alarms changed: what did not change is not drawn again, nor read aloud.
  update(): void {
    const alarms = this.live.alarms.list();
    this.element.hidden = alarms.length === 0;
    this.element.replaceChildren(...alarms.map((alarm) => {
      const seen = alarm.acknowledgedBy !== '';
      const name = this.live.welcome?.name ?? displayName();
      const button = h('button', { type: 'button', onclick: () => {
        this.live.alarms.acknowledge(alarm.key, name);
        this.changed();
      } }, 'seen');
      const state = `${PRIORITIES[alarm.priority]}${alarm.isActive ? '' : ', over now'}`;
      return h('article', { class: `alarm priority-${alarm.priority} ${seen || !alarm.isActive ? 'quiet' : ''}` },
        h('strong', {}, alarm.title), h('span', { class: 'hint' }, state), seen ? h('span', { class: 'hint' }, `seen by ${alarm.acknowledgedBy}`) : button,
        h('p', {}, alarm.cause), h('p', { class: 'todo' }, alarm.todo));
    }));
  }
}
