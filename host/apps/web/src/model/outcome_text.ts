// How what was asked for ended. lianad's `ok` says that a request was taken; what became of it stands in the states and
// events that follow.
import type { Facts, LianaEvent } from '../data/sample';
import { refusalRow } from './tables';
import { spoken } from './text';

// A request that lianad has taken.
export interface Taken {
  op: string;
  command?: string; // of state_command, mission_control
  device?: string; // of use_device
  time_s: number; // arm time when it was taken
  lastEvent: number; // sequence of the newest event before it was sent
}

// What is known now.
export interface Seen {
  time_s: number;
  facts: Facts;
  isMine: boolean;
  events: readonly LianaEvent[];
}

export interface Ending {
  ok: boolean;
  text: string;
}

const SETTLES_S = 0.1; // arm time: what a state says of a request is there a few states after its answer
export const PATH_REFUSED = 207; // refusal code of a path that was looked at as a whole
const WHOLE: Ending = { ok: true, text: 'done' };

// "refused: link 27 and the wall. Steer away from it. [208 clearance, command 9]"; empty for an event that refuses no
// command. A verdict's event says all of it; that of a path only its reason.
export function refusalText(event: LianaEvent): string {
  if (event.kind === 'verdict') return event.text;
  if (event.kind !== 'path' || event.number !== 0) return '';
  const row = refusalRow(PATH_REFUSED);
  return `refused: ${event.text}. ${row?.remedy ?? ''} [${PATH_REFUSED} ${row?.name ?? 'path'}]`;
}

function eventsSince(taken: Taken, seen: Seen): readonly LianaEvent[] {
  return seen.events.filter((event) => event.sequence > taken.lastEvent);
}

// What ends every motion, whatever was asked for.
function cutShort(taken: Taken, seen: Seen): Ending | null {
  const { stop, faults } = seen.facts;
  if (stop) return { ok: false, text: `ended by an emergency stop of ${stop.by}` };
  const refusal = eventsSince(taken, seen).map(refusalText).find((text) => text !== '');
  if (refusal) return { ok: false, text: refusal };
  if (faults && faults.length > 0) return { ok: false, text: `ended by fault ${faults[0].number} ${spoken(faults[0].name)}` };
  if (!seen.isMine) return { ok: false, text: 'ended: motion is no longer yours' };
  return null;
}

function endOfMotion(taken: Taken, seen: Seen): Ending | null {
  const cut = cutShort(taken, seen);
  if (cut) return cut;
  if (seen.facts.state !== 'ENABLED') return { ok: false, text: `ended: the arm is ${seen.facts.state ?? 'not heard'}` };
  return seen.facts.at_rest && !seen.facts.is_busy && !seen.facts.shape?.searching ? WHOLE : null;
}

function endOfRetract(taken: Taken, seen: Seen): Ending | null {
  const { retract, stop } = seen.facts;
  if (retract?.phase === 'done') return WHOLE;
  if (retract?.phase === 'ended') return { ok: false, text: `ended: ${retract.reason ?? ''}` };
  return stop || !seen.isMine ? cutShort(taken, seen) : null; // faults may be why it was asked for
}

function endOfEnable(taken: Taken, seen: Seen): Ending | null {
  if (seen.facts.state === 'ENABLED') return WHOLE;
  const cut = cutShort(taken, seen);
  if (cut) return cut;
  return seen.facts.state === 'ENABLING' || seen.facts.state === 'DISABLED' ? null : { ok: false, text: `ended: the arm is ${seen.facts.state ?? 'not heard'}` };
}

function endOfClear(taken: Taken, seen: Seen): Ending | null {
  const looked = eventsSince(taken, seen).find((event) => event.kind === 'clear');
  if (looked) return { ok: looked.number === 0, text: looked.number === 0 ? 'done' : looked.text };
  return null;
}

function endOfStateCommand(taken: Taken, seen: Seen): Ending | null {
  if (taken.command === 'enable') return endOfEnable(taken, seen);
  if (taken.command === 'disable') return seen.facts.state === 'DISABLED' ? WHOLE : null;
  if (taken.command === 'clear') return endOfClear(taken, seen);
  return WHOLE; // home: encoders are absolute, so it has happened with its answer
}

// How it ended; null while it has not, or nobody can know yet.
export function endingOf(taken: Taken, seen: Seen): Ending | null {
  if (!(seen.time_s >= taken.time_s + SETTLES_S)) return null;
  if (taken.op === 'acquire') return seen.isMine ? WHOLE : null;
  if (taken.op === 'release') return seen.isMine ? null : WHOLE;
  if (taken.op === 'use_device') return seen.facts.device === taken.device ? WHOLE : null;
  if (taken.op === 'mission_control') return seen.facts.mission_control?.command === taken.command ? { ok: true, text: 'sent to the mission' } : null;
  if (taken.op === 'state_command') return endOfStateCommand(taken, seen);
  if (taken.op === 'retract') return endOfRetract(taken, seen);
  return endOfMotion(taken, seen);
}
