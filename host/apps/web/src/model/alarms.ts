// What a person should act on: one alarm for each cause, by priority, acknowledged by name, none that flickers.
import type { Facts } from '../data/sample';
import { placesText } from './drive_names';
import { faultRow } from './tables';
import { spoken } from './text';

export type Priority = 1 | 2 | 3; // 1: act now; 2: act soon; 3: know it

// Something that is not as it should be, now.
export interface Condition {
  key: string; // the same cause has the same key
  priority: Priority;
  title: string;
  cause: string;
  todo: string;
  follows?: string[]; // what is its consequence, and goes with it
  passes?: boolean; // goes by itself when it is over: nobody has to have seen it
}

export interface Alarm extends Condition {
  since_s: number;
  isActive: boolean; // false: gone, and not yet acknowledged
  acknowledgedBy: string; // empty: nobody has
}

// A condition that comes has to last so long [s] by priority; one that goes has to be gone so long.
const ON_DELAY_S = [0, 0, 0.5, 1];
const OFF_DELAY_S = 3;

interface Entry extends Alarm {
  seen_s: number; // last time that its condition was there
  shown: boolean;
}

export class AlarmBook {
  private readonly entries = new Map<string, Entry>();

  // What is the case at `now_s`, which never goes back. True when the list of alarms changed.
  update(conditions: readonly Condition[], now_s: number): boolean {
    const before = this.mark();
    for (const condition of conditions) this.see(condition, now_s);
    for (const entry of this.entries.values()) {
      if (entry.seen_s !== now_s && now_s - entry.seen_s >= (entry.shown ? OFF_DELAY_S : 0)) entry.isActive = false;
      if (!entry.isActive && (!entry.shown || entry.passes || entry.acknowledgedBy !== '')) this.entries.delete(entry.key);
    }
    return this.mark() !== before;
  }

  // The person has seen it: it stays while its cause does, and then goes.
  acknowledge(key: string, name: string): void {
    const entry = this.entries.get(key);
    if (!entry) return;
    entry.acknowledgedBy = name;
    if (!entry.isActive) this.entries.delete(key);
  }

  // All of them at once.
  acknowledgeAll(name: string): void {
    for (const alarm of this.list()) this.acknowledge(alarm.key, name);
  }

  // Those that are over last; then by priority, of one priority those first that nobody has acknowledged, then the
  // oldest.
  list(): Alarm[] {
    const rank = (a: Alarm) => 2 * a.priority + (a.acknowledgedBy === '' ? 0 : 1) + (a.isActive ? 0 : 10);
    return [...this.entries.values()].filter((e) => e.shown).sort((a, b) => rank(a) - rank(b) || a.since_s - b.since_s);
  }

  private see(condition: Condition, now_s: number): void {
    const entry = this.entries.get(condition.key);
    if (!entry) {
      const shown = ON_DELAY_S[condition.priority] === 0;
      this.entries.set(condition.key, { ...condition, since_s: now_s, seen_s: now_s, isActive: true, acknowledgedBy: '', shown });
      return;
    }
    if (!entry.isActive) Object.assign(entry, { since_s: now_s, acknowledgedBy: '' }); // it has come back
    Object.assign(entry, condition, { seen_s: now_s, isActive: true });
    entry.shown ||= now_s - entry.since_s >= ON_DELAY_S[entry.priority];
  }

  private mark(): string {
    return this.list().map((a) => `${a.key} ${a.isActive} ${a.acknowledgedBy} ${a.title} ${a.cause} ${a.follows?.join()}`).join('\n');
  }
}

type Fault = NonNullable<Facts['faults']>[number];
const DRIVE_IS_LOST = [3001, 3002, 3007];

// Those of one number in one line, with the drives and buses that have them.
function faultTitles(faults: readonly Fault[]): Map<number, string> {
  const places = new Map<number, string[]>();
  for (const fault of faults) places.set(fault.number, [...(places.get(fault.number) ?? []), ...(fault.where ? [fault.where] : [])]);
  const named = (number: number, where: string) => `${number} ${spoken(faults.find((f) => f.number === number)!.name)}${where === '' ? '' : `: ${where}`}`;
  return new Map([...places].map(([number, where]) => [number, named(number, placesText(where))]));
}

// One alarm for each cause; what follows from it is folded below.
function faultConditions(facts: Facts): Condition[] {
  const faults = facts.faults ?? [];
  const causes = faults.filter((fault) => typeof fault.cause !== 'number');
  return [...faultTitles(causes)].map(([number, title]) => {
    const row = faultRow(number);
    const follows = faults.filter((fault) => typeof fault.cause === 'number' && faults[fault.cause]?.number === number);
    const todo = row?.remedy ?? 'See docs/reference/faults.md.';
    return { key: `fault ${number}`, priority: 1, title, cause: row?.text ?? causes.find((f) => f.number === number)?.text ?? '', todo, follows: [...faultTitles(follows).values()] };
  });
}

// Of a lost cable after its fault was cleared, for the way back; and what an enable waits for.
function recoveryConditions(facts: Facts): Condition[] {
  const conditions: Condition[] = [];
  if (facts.recovery?.recovers) {
    conditions.push({ key: 'recovery', priority: 2, passes: true, title: `without ${facts.recovery.where}: only the way back is allowed`, cause: 'A cable of this arm is lost.', todo: facts.recovery.next });
  }
  if (facts.enabling_waits) {
    conditions.push({ key: 'enabling', priority: 2, passes: true, title: 'enabling waits', cause: facts.enabling_waits, todo: 'Wait up to a minute, or disable and look at what is named.' });
  }
  return conditions;
}

function busConditions(facts: Facts): Condition[] {
  return (facts.buses ?? [])
    .filter((bus) => bus.lost || bus.state !== 'active')
    .map((bus) => ({
      key: `bus ${bus.name}`,
      priority: bus.lost ? 1 : 2,
      title: `bus ${bus.name} ${bus.lost ? 'is lost' : `is ${spoken(bus.state)}`}`,
      cause: bus.lost ? 'It is out, or none of its drives is heard.' : 'Frames on it were damaged.',
      todo: 'Check connectors, termination and interface of this bus.',
    }));
}

// A loose plug is one alarm: a lost bus is told by its fault, and damaged frames go with the drive that is lost.
function withoutEchoes(faults: readonly Condition[], buses: readonly Condition[]): Condition[] {
  const lost = faults.find((fault) => fault.key === 'fault 4001') ?? faults.find((fault) => DRIVE_IS_LOST.some((number) => fault.key === `fault ${number}`));
  if (!lost) return [...faults, ...buses];
  const follows = [...(lost.follows ?? []), ...buses.map((bus) => bus.title)];
  return faults.map((fault) => (fault === lost ? { ...fault, follows } : fault));
}

// What in these facts a person should act on.
export function conditionsOf(facts: Facts): Condition[] {
  const conditions = [...withoutEchoes(faultConditions(facts), busConditions(facts)), ...recoveryConditions(facts)];
  const { clearance, stop, friction, step } = facts;
  if (stop) {
    conditions.push({ key: 'stop', priority: 1, title: `emergency stop by ${stop.by}`, cause: stop.reason || 'No reason was given.',
      todo: 'Find out why. Then clear and enable; who does not own motion takes it first.' });
  }
  if (step?.waits) {
    conditions.push({ key: 'mission', priority: 3, passes: true, title: 'the mission waits', cause: step.waits, todo: 'Do what it waits for; then confirm or resume it in Steer, or abort it.' });
  }
  if (clearance?.level === 'refuse') {
    conditions.push({ key: 'clearance', priority: 1, title: `no verified clearance from the ${spoken(clearance.body)}`, cause: 'The arm may touch it.', todo: 'Retract.' });
  } else if (clearance?.level === 'slow') {
    conditions.push({ key: 'clearance', priority: 2, title: `close to the ${spoken(clearance.body)}: slowed down`, cause: 'Verified clearance is under the margin of this scene.', todo: 'Move away from it, or go on slowly.' });
  }
  if (clearance && clearance.camera !== 'none' && clearance.camera !== '') {
    conditions.push({ key: 'camera', priority: 2, title: `tip camera: ${spoken(clearance.camera)}`, cause: 'Distances are guaranteed without it, with more margin.', todo: 'Look whether something covers the camera; go on with care.' });
  }
  if (friction?.not_as_declared) {
    const row = faultRow(5009);
    conditions.push({ key: 'friction', priority: 2, title: 'friction is not as declared', cause: row?.text ?? '', todo: row?.remedy ?? '' });
  }
  return conditions;
}
