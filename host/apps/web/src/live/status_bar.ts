// State, owner, device and link as short words at the top.
import { alarmBadge, deviceBadge, ownerBadge, stateBadge, type Badge } from '../model/badges';
import { h, setClass, setText } from '../ui/dom';
import type { Live } from './live';

function show(element: HTMLElement, badge: Badge): void {
  element.hidden = badge.text === '';
  setText(element, badge.text);
  for (const look of ['good', 'bad', 'stale']) setClass(element, look, badge.look === look);
}

export class StatusBar {
  private readonly state = h('span', { class: 'badge' });
  private readonly owner = h('span', { class: 'badge' });
  private readonly device = h('span', { class: 'badge', hidden: true });
  private readonly link = h('span', { class: 'badge' });
  private readonly alarms = h('span', { class: 'badge alarm-count', hidden: true });
  readonly element = h('div', { class: 'status', role: 'status', 'aria-label': 'State' }, this.state, this.owner, this.device, this.alarms, this.link);

  constructor(private readonly live: Live) {}

  update(now_s: number): void {
    const { facts, alarms, isMine } = this.live;
    const isLive = this.live.isLive(now_s);
    show(this.state, stateBadge(facts, isLive));
    show(this.owner, ownerBadge(facts, isMine, isLive));
    show(this.device, deviceBadge(facts, this.live.sampleRate.perSecond(now_s), isLive));
    show(this.alarms, alarmBadge(alarms.list()));
    show(this.link, isLive ? { text: 'live', look: '' } : { text: 'NOT LIVE', look: 'bad' });
  }
}
