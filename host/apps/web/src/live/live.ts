// What is known of the running system: the newest state, facts, events, alarms, and who we are.
import { RecordReader } from '../data/record';
import type { Facts, LianaEvent, Sample } from '../data/sample';
import { derivedEvents } from '../data/derived_events';
import { AlarmBook, conditionsOf, type Condition } from '../model/alarms';
import { History } from './history';
import type { FromGateway, Welcome } from './protocol';
import { Rate } from './rate';
import { StateAge } from './state_age';

const MAX_EVENTS = 1000;
const SILENT_S = 2; // without a state

export class Live {
  welcome: Welcome | null = null;
  facts: Facts = {};
  history: History | null = null;
  readonly events: LianaEvent[] = [];
  readonly alarms = new AlarmBook();
  readonly age = new StateAge();
  readonly states = new Rate();
  readonly sampleRate = new Rate(); // of the device that steers
  status = 'connecting to the gateway'; // empty: all is well
  lostEvents = 0;
  takenEvents = 0; // since the page was loaded
  private reader: RecordReader | null = null;
  private deviceSamples = NaN;
  private came_s = NaN;

  // The newest state; null before the first.
  get sample(): Sample | null {
    const { reader, facts } = this;
    return reader && reader.sequence > 0 ? { tick: reader.tick, time_s: reader.time_s, numbers: reader.numbers, facts } : null;
  }

  // Does what is shown come from the arm now?
  isLive(now_s: number): boolean {
    return this.status === '' && !(now_s - this.came_s > SILENT_S);
  }

  // Sequence of the newest event; 0 before the first.
  get newestEvent(): number {
    return this.events[this.events.length - 1]?.sequence ?? 0;
  }

  get isMine(): boolean {
    return !!this.welcome && this.facts.owner === this.welcome.name;
  }

  // A new life of lianad, or a new gateway.
  takeWelcome(welcome: Welcome): void {
    this.welcome = welcome;
    this.reader = new RecordReader(welcome.layout);
    this.history = new History(welcome.layout);
    this.events.length = 0;
    this.facts = {};
  }

  take(message: FromGateway): void {
    if (message.op === 'facts') this.takeFacts(message.state);
    if (message.op === 'events_lost') this.lostEvents += message.count;
    if (message.op === 'event') this.addEvent(message);
  }

  private takeFacts(facts: Facts): void {
    for (const event of derivedEvents(this.facts, facts, this.reader?.tick ?? 0, this.newestEvent)) this.addEvent(event);
    this.facts = facts;
  }

  private addEvent(event: LianaEvent): void {
    ++this.takenEvents;
    this.events.push(event);
    if (this.events.length > MAX_EVENTS) this.events.shift();
  }

  // Its sequence; null when it is no record of this layout.
  takeRecord(bytes: ArrayBuffer, now_s: number): number | null {
    const { reader } = this;
    if (!reader || !reader.read(bytes)) return null;
    this.states.add(now_s);
    this.age.came(reader.time_s, now_s);
    this.came_s = now_s;
    this.history?.add(reader.tick, reader.time_s, reader.numbers);
    const samples = reader.numbers.get('device_samples')?.[0] ?? NaN;
    if (samples > this.deviceSamples) this.sampleRate.add(now_s, Math.min(200, samples - this.deviceSamples));
    this.deviceSamples = samples;
    return reader.sequence;
  }

  // Looks what a person should act on; true when the alarms changed.
  updateAlarms(now_s: number, more: readonly Condition[]): boolean {
    const conditions = [...conditionsOf(this.facts), ...more];
    if (!this.welcome) return this.alarms.update(conditions, now_s); // the page has only begun; its title says so
    const [cause, todo] = this.status
      ? [this.status, 'What is shown is old. To stop the arm use the switch beside it, or liana estop.']
      : [`No state for ${SILENT_S} s.`, 'What is shown is old: wait, or look at lianad.'];
    if (!this.isLive(now_s)) conditions.push({ key: 'link', priority: 1, passes: true, title: 'nothing comes from the arm', cause, todo });
    return this.alarms.update(conditions, now_s);
  }
}
