// What is known of the running system: the newest state, facts, events, alarms, and who we are.
import { RecordReader } from '../data/record';
import type { Facts, LianaEvent, Sample } from '../data/sample';
import { derived_events } from '../data/derived_events';
import { AlarmBook, conditions_of, type Condition } from '../model/alarms';
import { History } from './history';
import type { FromGateway, Welcome } from './protocol';
import { Rate } from './rate';
import { StateAge } from './state_age';

const kMaxEvents = 1000;
const kSilent_s = 2; // without a state

export class Live {
  welcome: Welcome | null = null;
  facts: Facts = {};
  history: History | null = null;
  readonly events: LianaEvent[] = [];
  readonly alarms = new AlarmBook();
  readonly age = new StateAge();
  readonly states = new Rate();
  readonly samples_per_s = new Rate(); // of the device that steers
  status = 'connecting to the gateway'; // empty: all is well
  lost_events = 0;
  taken_events = 0; // since the page was loaded
  private reader: RecordReader | null = null;
  private device_samples = NaN;
  private came_s = NaN;

  // The newest state; null before the first.
  get sample(): Sample | null {
    const { reader, facts } = this;
    return reader && reader.sequence > 0 ? { tick: reader.tick, time_s: reader.time_s, numbers: reader.numbers, facts } : null;
  }

  // Does what is shown come from the arm now?
  is_live(now_s: number): boolean {
    return this.status === '' && !(now_s - this.came_s > kSilent_s);
  }

  // Sequence of the newest event; 0 before the first.
  get newest_event(): number {
    return this.events[this.events.length - 1]?.sequence ?? 0;
  }

  get is_mine(): boolean {
    return !!this.welcome && this.facts.owner === this.welcome.name;
  }

  // A new life of lianad, or a new gateway.
  take_welcome(welcome: Welcome): void {
    this.welcome = welcome;
    this.reader = new RecordReader(welcome.layout);
    this.history = new History(welcome.layout);
    this.events.length = 0;
    this.facts = {};
  }

  take(message: FromGateway): void {
    if (message.op === 'facts') this.take_facts(message.state);
    if (message.op === 'events_lost') this.lost_events += message.count;
    if (message.op === 'event') this.add_event(message);
  }

  private take_facts(facts: Facts): void {
    for (const event of derived_events(this.facts, facts, this.reader?.tick ?? 0, this.newest_event)) this.add_event(event);
    this.facts = facts;
  }

  private add_event(event: LianaEvent): void {
    ++this.taken_events;
    this.events.push(event);
    if (this.events.length > kMaxEvents) this.events.shift();
  }

  // Its sequence; null when it is no record of this layout.
  take_record(bytes: ArrayBuffer, now_s: number): number | null {
    const { reader } = this;
    if (!reader || !reader.read(bytes)) return null;
    this.states.add(now_s);
    this.age.came(reader.time_s, now_s);
    this.came_s = now_s;
    this.history?.add(reader.tick, reader.time_s, reader.numbers);
    const samples = reader.numbers.get('device_samples')?.[0] ?? NaN;
    if (samples > this.device_samples) this.samples_per_s.add(now_s, Math.min(200, samples - this.device_samples));
    this.device_samples = samples;
    return reader.sequence;
  }

  // Looks what a person should act on; true when the alarms changed.
  update_alarms(now_s: number, more: readonly Condition[]): boolean {
    const conditions = [...conditions_of(this.facts), ...more];
    if (!this.welcome) return this.alarms.update(conditions, now_s); // the page has only begun; its title says so
    if (this.status) {
      conditions.push({ key: 'link', priority: 1, passes: true, title: 'nothing comes from the arm', cause: this.status, todo: 'What is shown is old. To stop the arm use the switch beside it, or liana estop.' });
    } else if (!this.is_live(now_s)) {
      conditions.push({ key: 'link', priority: 1, passes: true, title: 'nothing comes from the arm', cause: `No state for ${kSilent_s} s.`, todo: 'What is shown is old: wait, or look at lianad.' });
    }
    return this.alarms.update(conditions, now_s);
  }
}
