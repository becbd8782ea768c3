// How what was asked for ended. lianad's `ok` says that a request was taken; what became of it stands in the states and
// events that follow.
import type { Facts, LianaEvent } from '../data/sample';
import { refusal_row } from './tables';

// A request that lianad has taken.
export interface Taken {
  op: string;
  command?: string; // of state_command
  device?: string; // of use_device
  time_s: number; // arm time when it was taken
  last_event: number; // sequence of the newest event before it was sent
}

// What is known now.
export interface Seen {
  time_s: number;
  facts: Facts;
  is_mine: boolean;
  events: readonly LianaEvent[];
}

export interface Ending {
  ok: boolean;
  text: string;
}

const kSettles_s = 0.1; // arm time: what a state says of a request is there a few states after its answer
const kPathRefused = 207; // M_e of a path that was looked at as a whole
const kWhole: Ending = { ok: true, text: 'done' };

// "refused: link 27 and the wall. Steer away from it. [208 clearance, command 9]"; empty for an event that refuses no
// command. A verdict's event says all of it; that of a path only its reason.
export function refusal_words(event: LianaEvent): string {
  if (event.kind === 'verdict') return event.text;
  if (event.kind !== 'path' || event.number !== 0) return '';
  const row = refusal_row(kPathRefused);
  return `refused: ${event.text}. ${row?.remedy ?? ''} [${kPathRefused} ${row?.name ?? 'path'}]`;
}

function events_since(taken: Taken, seen: Seen): readonly LianaEvent[] {
  return seen.events.filter((event) => event.sequence > taken.last_event);
}

// What ends every motion, whatever was asked for.
function cut_short(taken: Taken, seen: Seen): Ending | null {
  const { stop, faults } = seen.facts;
  if (stop) return { ok: false, text: `ended by an emergency stop of ${stop.by}` };
  const refused = events_since(taken, seen).find((event) => refusal_words(event) !== '');
  if (refused) return { ok: false, text: refusal_words(refused) };
  if (faults && faults.length > 0) return { ok: false, text: `ended by fault ${faults[0].number} ${faults[0].name.replaceAll('_', ' ')}` };
  if (!seen.is_mine) return { ok: false, text: 'ended: motion is no longer yours' };
  return null;
}

function end_of_motion(taken: Taken, seen: Seen): Ending | null {
  const cut = cut_short(taken, seen);
  if (cut) return cut;
  if (seen.facts.state !== 'ENABLED') return { ok: false, text: `ended: the arm is ${seen.facts.state ?? 'not heard'}` };
  return seen.facts.at_rest && !seen.facts.is_busy && !seen.facts.shape?.searching ? kWhole : null;
}

function end_of_retract(taken: Taken, seen: Seen): Ending | null {
  const { retract, stop } = seen.facts;
  if (retract?.phase === 'done') return kWhole;
  if (retract?.phase === 'ended') return { ok: false, text: `ended: ${retract.reason ?? ''}` };
  return stop || !seen.is_mine ? cut_short(taken, seen) : null; // faults may be why it was asked for
}

function end_of_enable(taken: Taken, seen: Seen): Ending | null {
  if (seen.facts.state === 'ENABLED') return kWhole;
  const cut = cut_short(taken, seen);
  if (cut) return cut;
  return seen.facts.state === 'ENABLING' || seen.facts.state === 'DISABLED' ? null : { ok: false, text: `ended: the arm is ${seen.facts.state ?? 'not heard'}` };
}

function end_of_clear(taken: Taken, seen: Seen): Ending | null {
  const looked = events_since(taken, seen).find((event) => event.kind === 'clear');
  if (looked) return { ok: looked.number === 0, text: looked.number === 0 ? 'done' : looked.text };
  return null;
}

function end_of_state_command(taken: Taken, seen: Seen): Ending | null {
  if (taken.command === 'enable') return end_of_enable(taken, seen);
  if (taken.command === 'disable') return seen.facts.state === 'DISABLED' ? kWhole : null;
  if (taken.command === 'clear') return end_of_clear(taken, seen);
  return kWhole; // home: encoders are absolute, so it has happened with its answer
}

// How it ended; null while it has not, or nobody can know yet.
export function ending_of(taken: Taken, seen: Seen): Ending | null {
  if (!(seen.time_s >= taken.time_s + kSettles_s)) return null;
  if (taken.op === 'acquire') return seen.is_mine ? kWhole : null;
  if (taken.op === 'release') return seen.is_mine ? null : kWhole;
  if (taken.op === 'use_device') return seen.facts.device === taken.device ? kWhole : null;
  if (taken.op === 'state_command') return end_of_state_command(taken, seen);
  if (taken.op === 'retract') return end_of_retract(taken, seen);
  return end_of_motion(taken, seen);
}
