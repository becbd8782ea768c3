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

// The input device: which one leads, or was let go, and why; not shown where there is none.
export function deviceBadge(facts: Facts, samplesPerSecond: number, isLive: boolean): Badge {
  const name = facts.device && facts.device !== 'none' ? facts.device : 'device';
  if (facts.device_reason) return { text: `${name} let go: ${facts.device_reason}`, look: isLive ? 'bad' : 'stale' };
  if (name === 'device') return { text: '', look: '' };
  if (!isLive) return { text: `device was: ${name}`, look: 'stale' };
  if (!(samplesPerSecond > 0)) return { text: `${name}: no samples`, look: 'bad' };
  return { text: `${name}: ${facts.device_engaged ? 'moves the arm' : 'clutch open'}`, look: facts.device_engaged ? 'good' : '' };
}

// Alarms whose cause is there and that nobody has seen; when there are none of these, those that are over and unseen.
export function alarmBadge(alarms: readonly Alarm[]): Badge {
  const unseen = alarms.filter((alarm) => alarm.acknowledgedBy === '');
  const active = unseen.filter((alarm) => alarm.isActive).length;
  if (active > 0) return { text: `${active} alarm${active === 1 ? '' : 's'}`, look: 'bad' };
  return { text: unseen.length > 0 ? `${unseen.length} over, not seen` : '', look: '' };
}
