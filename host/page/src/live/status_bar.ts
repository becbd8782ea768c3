// State, owner, device and link as short words at the top.
import { h, set_class, set_text } from '../ui/dom';
import type { Live } from './live';

export class StatusBar {
  private readonly state = h('span', { class: 'badge' });
  private readonly owner = h('span', { class: 'badge' });
  private readonly link = h('span', { class: 'badge' });
  private readonly alarms = h('span', { class: 'badge bad', hidden: true });
  readonly element = h('div', { class: 'status', role: 'status', 'aria-label': 'State' }, this.state, this.owner, this.alarms, this.link);

  constructor(private readonly live: Live) {}

  update(): void {
    const { facts, status, alarms, is_mine } = this.live;
    set_text(this.state, facts.state ?? 'no state');
    set_class(this.state, 'good', facts.state === 'ENABLED');
    set_class(this.state, 'bad', facts.state === 'FAULT');
    set_text(this.owner, is_mine ? 'motion: you' : facts.owner ? `motion: ${facts.owner}` : 'motion: nobody');
    set_class(this.owner, 'good', is_mine);
    const active = alarms.list().filter((alarm) => alarm.acknowledged_by === '').length;
    this.alarms.hidden = active === 0;
    set_text(this.alarms, `${active} alarm${active === 1 ? '' : 's'}`);
    set_text(this.link, status === '' ? 'live' : 'NOT LIVE');
    set_class(this.link, 'bad', status !== '');
  }
}
