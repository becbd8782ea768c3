// What a state tells of push, adapter, servo and payload has no events of its own: here they are made of facts that
// changed.
import type { Facts, LianaEvent } from './sample';
import { spoken } from '../model/text';

export const TROUBLE = 1; // an event's number when somebody should look at it

type Change = Pick<LianaEvent, 'kind' | 'number' | 'text'>;

const GOOD_ENDS = ['none', 'captured', 'stopped'];

function change(kind: string, text: string, isTrouble = false): Change {
  return { kind, number: isTrouble ? TROUBLE : 0, text };
}

function ofPush({ insert: before }: Facts, { insert: now }: Facts): Change[] {
  if (!before || !now) return [];
  const changes: Change[] = [];
  const isNew = before.number !== now.number;
  if (now.end !== 'none' && (isNew || before.end !== now.end))
    changes.push(change('push', `push ${now.number} ended: ${now.end}`, !GOOD_ENDS.includes(now.end)));
  if (now.phase !== 'none' && (isNew || before.phase !== now.phase))
    changes.push(change('push', `push ${now.number}: ${now.phase}`));
  if (now.touched && (isNew || !before.touched)) changes.push(change('push', `push ${now.number}: touches`));
  if (before.wrist !== now.wrist)
    changes.push(change('wrist', `wrist sensor: ${now.wrist}`, !['good', 'not_at_rest'].includes(now.wrist)));
  return changes;
}

function ofAdapter({ adapter: before }: Facts, { adapter: now }: Facts): Change[] {
  if (!before || !now) return [];
  const changes: Change[] = [];
  if (before.captured !== now.captured)
    changes.push(change('adapter', now.captured ? 'captured' : 'captured no longer'));
  for (const part of ['latch', 'lock'] as const) {
    if (before[part] !== now[part]) changes.push(change('adapter', `${part} ${now[part]}`, now[part] === 'failed'));
  }
  return changes;
}

function ofServo({ servo: before }: Facts, { servo: now }: Facts): Change[] {
  if (!before || !now || (before.phase === now.phase && before.target === now.target)) return [];
  const why = now.reason ? `: ${now.reason}` : '';
  const text = `servo to ${now.target || 'nothing'}: ${spoken(now.phase)}${why}`;
  return [change('servo', text, ['lost', 'timed_out'].includes(now.phase))];
}

function ofPayload({ payload: before }: Facts, { payload: now }: Facts): Change[] {
  if (!before || !now || before.mass_kg === now.mass_kg) return [];
  return [change('payload', now.mass_kg > 0 ? `carries ${now.mass_kg} kg` : 'carries nothing')];
}

// Between two states; none where one of them does not tell of it.
export function derivedEvents(before: Facts, now: Facts, tick: number, sequence: number): LianaEvent[] {
  const all = [ofPayload, ofServo, ofPush, ofAdapter].flatMap((changesOf) => changesOf(before, now));
  return all.map((each) => ({ ...each, sequence, tick, subject: '', values: {} }));
}

// The events of a run with those made of its facts between them.
export function withDerivedEvents(
  events: readonly LianaEvent[],
  facts: readonly { tick: number; state: Facts }[],
): LianaEvent[] {
  const derived = facts.slice(1).flatMap(({ tick, state }, i) => derivedEvents(facts[i].state, state, tick, 0));
  return [...events, ...derived].sort((a, b) => a.tick - b.tick);
}
