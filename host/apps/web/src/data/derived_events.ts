// What a state tells of push, adapter, servo and payload has no events of its own: here they are made of facts that
// changed.
import type { Facts, LianaEvent } from './sample';

export const kTrouble = 1; // an event's number when somebody should look at it

type Change = Pick<LianaEvent, 'kind' | 'number' | 'text'>;

const kGoodEnds = ['none', 'captured', 'stopped'];

function change(kind: string, text: string, is_trouble = false): Change {
  return { kind, number: is_trouble ? kTrouble : 0, text };
}

function of_push({ push: before }: Facts, { push: now }: Facts): Change[] {
  if (!before || !now) return [];
  const changes: Change[] = [];
  const is_new = before.number !== now.number;
  if (now.end !== 'none' && (is_new || before.end !== now.end))
    changes.push(change('push', `push ${now.number} ended: ${now.end}`, !kGoodEnds.includes(now.end)));
  if (now.phase !== 'none' && (is_new || before.phase !== now.phase))
    changes.push(change('push', `push ${now.number}: ${now.phase}`));
  if (now.touched && (is_new || !before.touched)) changes.push(change('push', `push ${now.number}: touches`));
  if (before.wrist !== now.wrist)
    changes.push(change('wrist', `wrist sensor: ${now.wrist}`, !['good', 'not_at_rest'].includes(now.wrist)));
  return changes;
}

function of_adapter({ adapter: before }: Facts, { adapter: now }: Facts): Change[] {
  if (!before || !now) return [];
  const changes: Change[] = [];
  if (before.captured !== now.captured)
    changes.push(change('adapter', now.captured ? 'captured' : 'captured no longer'));
  for (const part of ['latch', 'lock'] as const) {
    if (before[part] !== now[part]) changes.push(change('adapter', `${part} ${now[part]}`, now[part] === 'failed'));
  }
  return changes;
}

function of_servo({ servo: before }: Facts, { servo: now }: Facts): Change[] {
  if (!before || !now || (before.phase === now.phase && before.target === now.target)) return [];
  const why = now.reason ? `: ${now.reason}` : '';
  const text = `servo to ${now.target || 'nothing'}: ${now.phase.replaceAll('_', ' ')}${why}`;
  return [change('servo', text, ['lost', 'timed_out'].includes(now.phase))];
}

function of_payload({ payload: before }: Facts, { payload: now }: Facts): Change[] {
  if (!before || !now || before.mass_kg === now.mass_kg) return [];
  return [change('payload', now.mass_kg > 0 ? `carries ${now.mass_kg} kg` : 'carries nothing')];
}

// Between two states; none where one of them does not tell of it.
export function derived_events(before: Facts, now: Facts, tick: number, sequence: number): LianaEvent[] {
  const all = [of_payload, of_servo, of_push, of_adapter].flatMap((changes_of) => changes_of(before, now));
  return all.map((each) => ({ ...each, sequence, tick, subject: '', values: {} }));
}

// The events of a run with those made of its facts between them.
export function with_told_changes(
  events: readonly LianaEvent[],
  facts: readonly { tick: number; state: Facts }[],
): LianaEvent[] {
  const told = facts.slice(1).flatMap(({ tick, state }, i) => derived_events(facts[i].state, state, tick, 0));
  return [...events, ...told].sort((a, b) => a.tick - b.tick);
}
