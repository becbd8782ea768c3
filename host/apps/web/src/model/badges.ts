// The short words at the top, and how they look: nothing looks good that is only remembered.
import type { Facts } from '../data/sample';
import type { Alarm } from './alarms';

export type Look = 'good' | 'bad' | 'stale' | '';

export interface Badge {
  text: string; // empty: not shown
  look: Look;
}

// The operating state; `is_live` false: it is the last that was heard, and may be another by now.
export function state_badge(facts: Facts, is_live: boolean): Badge {
  if (!facts.state) return { text: 'no state', look: is_live ? '' : 'stale' };
  if (!is_live) return { text: `was ${facts.state}`, look: 'stale' };
  return { text: facts.state, look: facts.state === 'ENABLED' ? 'good' : facts.state === 'FAULT' ? 'bad' : '' };
}

// Who may move the arm.
export function owner_badge(facts: Facts, is_mine: boolean, is_live: boolean): Badge {
  const owner = is_mine ? 'you' : facts.owner || 'nobody';
  if (!is_live) return { text: `motion was: ${owner}`, look: 'stale' };
  return { text: `motion: ${owner}`, look: is_mine ? 'good' : '' };
}

// Alarms whose cause is there and that nobody has seen; when there are none of these, those that are over and unseen.
export function alarm_badge(alarms: readonly Alarm[]): Badge {
  const unseen = alarms.filter((alarm) => alarm.acknowledged_by === '');
  const active = unseen.filter((alarm) => alarm.is_active).length;
  if (active > 0) return { text: `${active} alarm${active === 1 ? '' : 's'}`, look: 'bad' };
  return { text: unseen.length > 0 ? `${unseen.length} over, not seen` : '', look: '' };
}
