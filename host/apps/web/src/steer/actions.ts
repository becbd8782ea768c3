// What a person can tell the arm by a button: what it will do, and why it cannot be done now.
import type { Facts } from '../data/sample';
import type { Role } from '../live/protocol';
import { faultRow } from '../model/tables';

export interface Action {
  name: string;
  request: { op: string; command?: string };
  does: string; // what will happen
  // Why not now; empty: it can be asked for. lianad decides in the end.
  blocked(facts: Facts, isMine: boolean): string;
}

const NOT_MINE = 'Take motion first.';

function mine(also: (facts: Facts) => string): (facts: Facts, isMine: boolean) => string {
  return (facts, isMine) => (isMine ? also(facts) : NOT_MINE);
}

function enabled(facts: Facts): string {
  return facts.state === 'ENABLED' ? '' : 'Enable first.';
}

function enableBlocked(facts: Facts): string {
  if (facts.stop) return 'An emergency stop is in force: clear it first.';
  if ((facts.faults ?? []).length > 0) return 'Faults are latched: clear them first.';
  if (facts.is_homed === false) return `The arm is not homed${facts.not_homed ? `: ${facts.not_homed.text}` : ''}.`;
  return facts.state === 'DISABLED' ? '' : `It is ${facts.state ?? 'not known'}.`;
}

function retractBlocked(facts: Facts): string {
  const worse = (facts.faults ?? []).find((fault) => faultRow(fault.number)?.retract === false);
  if (worse) return `Fault ${worse.number} does not allow it: clear first.`;
  return facts.retracted ? 'It is all the way back.' : enabled(facts);
}

function isClear(facts: Facts): boolean {
  return (facts.faults ?? []).length === 0 && !facts.stop;
}

export const ACTIONS: readonly Action[] = [
  {
    name: 'take motion', request: { op: 'acquire' },
    does: 'You alone can move the arm from now on. An emergency stop is cleared by it.',
    blocked: (facts, isMine) => (isMine ? 'It is yours.' : facts.owner ? `${facts.owner} has it.` : ''),
  },
  { name: 'give back motion', request: { op: 'release' }, does: 'The arm comes to rest and holds; somebody else may take motion.', blocked: mine(() => '') },
  {
    name: 'enable', request: { op: 'state_command', command: 'enable' },
    does: 'Brakes open, cables are tightened as planned (some seconds); the arm stays where it is.', blocked: mine(enableBlocked),
  },
  {
    name: 'disable', request: { op: 'state_command', command: 'disable' },
    does: 'The arm comes to rest, brakes close, drives lose their power.', blocked: mine((f) => (f.state === 'DISABLED' ? 'It is disabled.' : '')),
  },
  { name: 'hold', request: { op: 'hold' }, does: 'The arm comes to rest along its verified path and stays enabled. Key H.', blocked: mine(enabled) },
  {
    name: 'retract', request: { op: 'retract' },
    does: 'Stops, then goes back along the verified path it has come, to its beginning, a little slower than the way in. Hold ends it.',
    blocked: mine(retractBlocked),
  },
  {
    name: 'clear', request: { op: 'state_command', command: 'clear' },
    does: 'Looks again at what each fault names and clears those whose cause is gone; clears an emergency stop. Nothing moves.',
    blocked: mine((f) => (isClear(f) ? 'There is nothing to clear.' : '')),
  },
  {
    name: 'home', request: { op: 'state_command', command: 'home' },
    does: 'Takes the pose from the lengths of the cables. Nothing moves.', blocked: mine((f) => (f.is_homed ? 'It is homed.' : '')),
  },
];

// Why a person of this role cannot ask for motion; empty: may ask.
export function roleBlocked(role: Role | undefined): string {
  return role === 'watch' ? 'Your role is to watch: you may stop the arm, nothing else.' : '';
}
