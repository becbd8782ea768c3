// The short words at the top, and how they look: nothing looks good that is only remembered.
import type { Facts } from '../data/sample';
import type { Alarm } from './alarms';

export type Look = 'good' | 'bad' | 'stale' | '';

export interface Badge {
  text: string; // empty: not shown
  look: Look;
}

// The operating state; `isLive` false: it is the last that was heard, and may be another by now.
export function stateBadge(facts: Facts, isLive: boolean): Badge {
  if (!facts.state) return { text: 'no state', look: isLive ? '' : 'stale' };
  if (!isLive) return { text: `was ${facts.state}`, look: 'stale' };
  return { text: facts.state, look: facts.state === 'ENABLED' ? 'good' : facts.state === 'FAULT' ? 'bad' : '' };
}

// Who may move the arm.
export function ownerBadge(facts: Facts, isMine: boolean, isLive: boolean): Badge {
  const owner = isMine ? 'you' : facts.owner || 'nobody';
  if (!isLive) return { text: `motion was: ${owner}`, look: 'stale' };
  return { text: `motion: ${owner}`, look: isMine ? 'good' : '' };
}

// Alarms whose cause is there and that nobody has seen; when there are none of these, those that are over and unseen.
export function alarmBadge(alarms: readonly Alarm[]): Badge {
  const unseen = alarms.filter((alarm) => alarm.acknowledgedBy === '');
  const active = unseen.filter((alarm) => alarm.isActive).length;
  if (active > 0) return { text: `${active} alarm${active === 1 ? '' : 's'}`, look: 'bad' };
  return { text: unseen.length > 0 ? `${unseen.length} over, not seen` : '', look: '' };
}
