// The console: the running arm, what can be told to it, and what happens.
import type { Sample } from '../data/sample';
import { value, values } from '../data/sample';
import type { Condition } from '../model/alarms';
import type { CableRobot } from '../model/robot';
import { sentence_of } from '../model/sentence';
import { SceneView } from '../scene/scene_view';
import { scene_colours, type Theme } from '../scene/palette';
import { DevicePanel } from '../steer/device_panel';
import { Vr } from '../vr/vr';
import { TipHandle } from '../steer/handle';
import { Jogger } from '../steer/jogger';
import { JogPanel } from '../steer/jog_panel';
import { JointPanel } from '../steer/joint_panel';
import { action_of, is_field } from '../steer/keyboard';
import { MotionPanel } from '../steer/motion_panel';
import { ShapePanel } from '../steer/shape_panel';
import { h, set_text } from '../ui/dom';
import { PushCard } from '../ui/push_card';
import { Tabs } from '../ui/tabs';
import { theme_button, theme_now } from '../ui/theme';
import { AlarmPanel } from './alarm_panel';
import { Connection } from './connection';
import { Live } from './live';
import { LiveEvents } from './live_events';
import { LivePlots } from './live_plots';
import { LookBack } from './history_scrubber';
import { display_name } from './display_name';
import { kProtocol, type FromGateway, type Welcome } from './protocol';
import { RunList } from './run_list';
import { StatusBar } from './status_bar';
import { StopButton } from './stop_button';
import { Told } from './pending_command';
import { kept_token, token_form } from './token_form';

const kWords_ms = 250; // texts are written anew at most so often

// Of each frame that was drawn.
interface Measured {
  intervals_ms: number[];
  ages_ms: number[];
}

export class LivePage {
  readonly element: HTMLElement;
  readonly live = new Live();
  readonly connection: Connection;
  readonly jogger: Jogger;
  private readonly stop: StopButton;
  private readonly status: StatusBar;
  private readonly alarms: AlarmPanel;
  private readonly history_scrubber: LookBack;
  private readonly sentence = h('p', { class: 'sentence' });
  private readonly told: Told;
  private readonly middle = h('div', { class: 'middle' }, h('p', { class: 'no-scene' }, 'waiting for the arm'));
  private panels: { update(now_s: number): void }[] = [];
  private push_card: PushCard | null = null;
  private scene: SceneView | null = null;
  private plots: LivePlots | null = null;
  private handle: TipHandle | null = null;
  vr: Vr | null = null;
  private readonly vr_button = h('button', { type: 'button', hidden: true, title: 'steer with the handles of a headset', onclick: () => void this.toggle_vr() }, 'VR');
  private robot_shown = '';
  private shown_age_s = NaN;
  private measured: Measured | null = null;
  private last_frame_ms = NaN;

  constructor(url: string) {
    this.connection = new Connection(url, {
      name: display_name,
      token: kept_token,
      wants_token: (why) => this.middle.replaceChildren(token_form(why, () => this.connection.open())),
      status: (text) => (this.live.status = text),
      welcome: (message) => this.welcome(message),
      message: (message) => this.message(message),
      record: (bytes) => this.record(bytes),
    });
    this.told = new Told(this.live, this.connection);
    this.jogger = new Jogger(this.live, this.connection);
    this.jogger.on_error = (answer) => this.told.error('jog', answer);
    this.stop = new StopButton(this.live, this.connection);
    this.stop.on_press = () => this.jogger.let_go();
    this.status = new StatusBar(this.live);
    this.alarms = new AlarmPanel(this.live, () => {
      this.alarms.update();
      this.words();
    });
    this.history_scrubber = new LookBack(this.live, () => this.draw());
    const header = h('header', { class: 'top' }, h('h1', {}, 'Liana'), this.sentence, this.status.element, this.vr_button, theme_button((theme) => this.build(theme)), this.stop.element);
    const told = h('div', { class: 'told' }, this.told.element, this.stop.report);
    this.element = h('div', { class: 'page live' }, header, told, this.alarms.element, this.middle, this.history_scrubber.element);
    document.addEventListener('keydown', (event) => this.key_down(event), { capture: true });
    document.addEventListener('keyup', (event) => this.jogger.release(event.code));
    window.addEventListener('blur', () => this.jogger.let_go());
    document.addEventListener('visibilitychange', () => document.hidden && this.jogger.let_go());
    window.setInterval(() => this.words(), kWords_ms);
    this.connection.open();
  }

  // From here on every frame is kept, for end_measurement().
  begin_measurement(): void {
    this.measured = { intervals_ms: [], ages_ms: [] };
    this.last_frame_ms = NaN;
  }

  end_measurement(): Measured & { pixel_ratio: number } {
    const measured = this.measured ?? { intervals_ms: [], ages_ms: [] };
    this.measured = null;
    return { ...measured, pixel_ratio: this.scene?.stage.pace.pixel_ratio ?? 0 };
  }

  // More that a person should act on: of parts that are not the arm.
  private more_conditions(): Condition[] {
    return this.vr?.conditions() ?? [];
  }

  private welcome(welcome: Welcome): void {
    if (welcome.protocol !== kProtocol) {
      this.live.status = `the gateway speaks protocol ${welcome.protocol}, this page ${kProtocol}: load the page again`;
      return;
    }
    this.jogger.let_go();
    this.told.forget();
    this.live.take_welcome(welcome);
    this.history_scrubber.go_to(null);
    const robot = JSON.stringify([welcome.robot, welcome.scene, welcome.layout]);
    if (robot !== this.robot_shown || !this.plots) this.build(theme_now());
    this.robot_shown = robot;
  }

  // Everything that depends on the robot, the scene or the colours.
  private build(theme: Theme): void {
    const { welcome } = this.live;
    if (!welcome) return;
    this.scene?.stage.renderer.dispose();
    const { ask } = this.told;
    const motion = new MotionPanel(this.live, this.connection, ask);
    const joints = new JointPanel(this.live, welcome, ask);
    const device = new DevicePanel(this.live, ask);
    const jog = new JogPanel(this.live, this.jogger, ask);
    const shape = welcome.robot.kind === 'serial' ? null : new ShapePanel(this.live, welcome.robot, ask);
    this.panels = [motion, device, joints, ...(shape ? [shape] : [])];
    this.push_card = new PushCard(welcome.scene);
    const cards = [motion, this.push_card, device, jog, joints, ...(shape ? [shape] : [])];
    const steer = h('div', { class: 'panel' }, ...cards.map(({ element }) => element));
    const go_to = (time_s: number) => this.history_scrubber.go_to(time_s);
    this.plots = new LivePlots(this.live, welcome, theme, go_to);
    const events = new LiveEvents(this.live, go_to);
    this.panels.push(events);
    const runs = new RunList(welcome.ticket);
    const tabs = new Tabs([
      { name: 'Steer', panel: steer, shown: () => joints.reset() },
      { name: 'Plots', panel: h('div', { class: 'panel plots' }, this.plots.element) },
      { name: 'Events', panel: h('div', { class: 'panel' }, events.element) },
      { name: 'Runs', panel: runs.element, shown: () => void runs.load() },
    ], 'Steering and information');
    this.middle.replaceChildren(this.scene_of(welcome, theme), tabs.element);
  }

  private scene_of(welcome: Welcome, theme: Theme): HTMLElement {
    try {
      this.scene = new SceneView(welcome.robot, welcome.scene, theme);
    } catch (error) {
      this.scene = null;
      return h('p', { class: 'no-scene' }, `No 3-D here: ${String(error)}. Everything else works.`);
    }
    this.scene.on_drawn = (now_ms) => this.drawn(now_ms);
    if (welcome.robot.kind !== 'serial') this.add_vr(welcome.robot, this.scene);
    this.handle = new TipHandle(this.scene.stage, scene_colours(theme).ghost);
    this.handle.on_drag = (place_m) => this.jogger.drag_to(place_m);
    this.handle.on_drop = () => this.jogger.drop();
    this.scene.add_helper(this.handle.ball);
    return h('div', { class: 'scene-place' }, this.scene.element);
  }

  private add_vr(robot: CableRobot, scene: SceneView): void {
    this.vr?.end();
    this.vr = new Vr(robot, this.live, this.connection, scene, () => void this.stop.press());
    void Vr.is_there().then((is_there) => (this.vr_button.hidden = !is_there));
  }

  private async toggle_vr(): Promise<void> {
    if (this.vr?.is_on) return this.vr.end();
    try {
      await this.vr?.begin();
    } catch (error) {
      this.told.error('VR', { op: 'answer', ok: false, code: 'no session', message: String(error) });
    }
  }

  private message(message: FromGateway): void {
    const newest = this.live.newest_event;
    this.live.take(message);
    if (message.op === 'event' && message.sequence > newest && newest !== 0) this.told.event(message);
  }

  private record(bytes: ArrayBuffer): number | null {
    const sequence = this.live.take_record(bytes, performance.now() / 1000);
    if (sequence !== null && this.history_scrubber.time_s === null) this.draw();
    return sequence;
  }

  // The newest state, or the one that is looked back at.
  private draw(): void {
    const sample = this.history_scrubber.sample();
    if (!sample || !this.scene) return;
    if (this.handle) {
      this.handle.is_enabled = this.live.status === '' && this.live.is_mine && sample.facts.state === 'ENABLED' && this.history_scrubber.time_s === null;
      this.handle.place(values(sample, 'setpoint_cp'));
      this.scene.tip_label = this.handle.is_enabled && !this.jogger.is_jogging ? 'drag the tip' : '';
    }
    if (this.history_scrubber.time_s === null) this.scene.trail.add(values(sample, 'measured_cp'));
    this.scene.show(sample);
  }

  private drawn(now_ms: number): void {
    this.plots?.update(now_ms);
    this.shown_age_s = this.live.age.age_s(performance.now() / 1000);
    if (!this.measured || this.history_scrubber.time_s !== null) return;
    if (Number.isFinite(this.last_frame_ms)) this.measured.intervals_ms.push(now_ms - this.last_frame_ms);
    this.last_frame_ms = now_ms;
    this.measured.ages_ms.push(1000 * this.shown_age_s);
  }

  private words(): void {
    const now_s = performance.now() / 1000;
    if (this.live.update_alarms(now_s, this.more_conditions())) this.alarms.update();
    this.status.update(now_s);
    this.told.update();
    this.stop.update();
    this.history_scrubber.update();
    for (const panel of this.panels) panel.update(now_s);
    const sample = this.history_scrubber.sample();
    const { welcome } = this.live;
    if (!sample || !welcome) return set_text(this.sentence, this.live.status);
    if (this.live.sample) this.push_card?.show(this.live.sample);
    const is_live = this.live.is_live(now_s);
    this.sentence.classList.toggle('stale', !is_live);
    set_text(this.sentence, `${is_live ? '' : 'last heard: '}${sentence_of(sample, welcome.robot, welcome.scene, null)}`);
    this.scene?.say_in_corner(this.corner(sample, now_s));
  }

  // Age of what is seen, how often states come, how fine the picture is.
  private corner(sample: Sample, now_s: number): string {
    if (!this.live.is_live(now_s)) return 'NOT LIVE';
    const age_ms = 1000 * this.shown_age_s;
    const ratio = this.scene?.stage.pace.pixel_ratio ?? 1;
    const coarse = ratio < 1 ? `, picture at ${Math.round(100 * ratio)} %` : '';
    const share = value(sample, 'path.share');
    const path = Number.isFinite(share) ? `, path ${(100 * share).toFixed(0)} %` : '';
    return `age ${age_ms.toFixed(0)} ms, ${this.live.states.per_second(now_s)} states/s${coarse}${path}`;
  }

  private key_down(event: KeyboardEvent): void {
    const action = action_of(event, is_field(event.target as HTMLElement));
    if (!action || event.repeat) return;
    if (action.kind === 'stop') void this.stop.press();
    if (action.kind === 'hold') this.told.ask('hold', { op: 'hold' });
    if (action.kind === 'jog') this.jogger.press(event.code, action.direction);
    if (action.kind === 'view') {
      const view = this.scene?.views[action.index];
      if (view) this.scene?.look(view);
    }
    event.preventDefault();
  }
}
