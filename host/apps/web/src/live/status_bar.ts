// State, owner, device and link as short words at the top.
import { alarm_badge, owner_badge, state_badge, type Badge } from '../model/badges';
import { h, set_class, set_text } from '../ui/dom';
import type { Live } from './live';

function show(element: HTMLElement, badge: Badge): void {
  element.hidden = badge.text === '';
  set_text(element, badge.text);
  for (const look of ['good', 'bad', 'stale']) set_class(element, look, badge.look === look);
}

export class StatusBar {
  private readonly state = h('span', { class: 'badge' });
  private readonly owner = h('span', { class: 'badge' });
  private readonly link = h('span', { class: 'badge' });
  private readonly alarms = h('span', { class: 'badge alarm-count', hidden: true });
  readonly element = h('div', { class: 'status', role: 'status', 'aria-label': 'State' }, this.state, this.owner, this.alarms, this.link);

  constructor(private readonly live: Live) {}

  update(now_s: number): void {
    const { facts, alarms, is_mine } = this.live;
    const is_live = this.live.is_live(now_s);
    show(this.state, state_badge(facts, is_live));
    show(this.owner, owner_badge(facts, is_mine, is_live));
    show(this.alarms, alarm_badge(alarms.list()));
    show(this.link, is_live ? { text: 'live', look: '' } : { text: 'NOT LIVE', look: 'bad' });
  }
}
