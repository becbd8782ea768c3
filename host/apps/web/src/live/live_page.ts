// The console: the running arm, what can be told to it, and what happens.
import type { Sample } from '../data/sample';
import { value, values } from '../data/sample';
import type { Condition } from '../model/alarms';
import type { CableRobot } from '../model/robot';
import { slowdownText } from '../model/distances';
import { sentenceOf } from '../model/sentence';
import { lengthText } from '../model/text';
import { distance } from '../model/vector';
import { SceneView } from '../scene/scene_view';
import { sceneColours, type Theme } from '../scene/palette';
import { DevicePanel } from '../steer/device_panel';
import { Vr } from '../vr/vr';
import { TipHandle } from '../steer/handle';
import { Jogger } from '../steer/jogger';
import { JogPanel } from '../steer/jog_panel';
import { JointPanel } from '../steer/joint_panel';
import { actionOf, isField } from '../steer/keyboard';
import { MissionPanel } from '../steer/mission_panel';
import { MotionPanel } from '../steer/motion_panel';
import type { PlannerOffer } from '../steer/planner_offer';
import { PracticePanel } from '../steer/practice_panel';
import { ShapePanel } from '../steer/shape_panel';
import { h, setText } from '../ui/dom';
import { PushCard } from '../ui/push_card';
import { Tabs } from '../ui/tabs';
import { themeButton, themeNow } from '../ui/theme';
import { AlarmPanel } from './alarm_panel';
import { Connection } from './connection';
import { Live } from './live';
import { LiveEvents } from './live_events';
import { LivePlots } from './live_plots';
import { HistoryScrubber } from './history_scrubber';
import { displayName } from './display_name';
import { PROTOCOL, type FromGateway, type Welcome } from './protocol';
import { RunList } from './run_list';
import { StatusBar } from './status_bar';
import { StopButton } from './stop_button';
import { PendingCommand } from './pending_command';
import { keptToken, tokenForm } from './token_form';

const WORDS_MS = 250; // texts are written anew at most so often

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
  private readonly historyScrubber: HistoryScrubber;
  private readonly sentence = h('p', { class: 'sentence' });
  private readonly pending: PendingCommand;
  private readonly middle = h('div', { class: 'middle' }, h('p', { class: 'no-scene' }, 'waiting for the arm'));
  private panels: { update(now_s: number): void }[] = [];
  private pushCard: PushCard | null = null;
  private scene: SceneView | null = null;
  private plots: LivePlots | null = null;
  private planner: PlannerOffer | null = null;
  private handle: TipHandle | null = null;
  vr: Vr | null = null;
  private readonly vrButton = h('button', { type: 'button', hidden: true, title: 'steer with the handles of a headset', onclick: () => void this.toggleVr() }, 'VR');
  private robotShown = '';
  private shownAge_s = NaN;
  private measured: Measured | null = null;
  private lastFrame_ms = NaN;

  constructor(url: string) {
    this.connection = new Connection(url, {
      name: displayName,
      token: keptToken,
      wantsToken: (why) => this.middle.replaceChildren(tokenForm(why, () => this.connection.open())),
      status: (text) => (this.live.status = text),
      welcome: (message) => this.welcome(message),
      message: (message) => this.message(message),
      record: (bytes) => this.record(bytes),
    });
    this.pending = new PendingCommand(this.live, this.connection);
    this.jogger = new Jogger(this.live, this.connection);
    this.jogger.onError = (answer) => this.pending.error('jog', answer);
    this.stop = new StopButton(this.live, this.connection);
    this.stop.onPress = () => this.jogger.letGo();
    this.status = new StatusBar(this.live);
    this.alarms = new AlarmPanel(this.live, () => {
      this.alarms.update();
      this.words();
    });
    this.historyScrubber = new HistoryScrubber(this.live, () => this.draw());
    const header = h('header', { class: 'top' }, h('h1', {}, 'Liana'), this.sentence, this.status.element, this.vrButton, themeButton((theme) => this.build(theme)), this.stop.element);
    const told = h('div', { class: 'told' }, this.pending.element, this.stop.report);
    this.element = h('div', { class: 'page live' }, header, told, this.alarms.element, this.middle, this.historyScrubber.element);
    document.addEventListener('keydown', (event) => this.keyDown(event), { capture: true });
    document.addEventListener('keyup', (event) => this.jogger.release(event.code));
    window.addEventListener('blur', () => this.jogger.letGo());
    document.addEventListener('visibilitychange', () => document.hidden && this.jogger.letGo());
    window.setInterval(() => this.words(), WORDS_MS);
    this.connection.open();
  }

  // From here on every frame is kept, for endMeasurement().
  beginMeasurement(): void {
    this.measured = { intervals_ms: [], ages_ms: [] };
    this.lastFrame_ms = NaN;
  }

  endMeasurement(): Measured & { pixelRatio: number } {
    const measured = this.measured ?? { intervals_ms: [], ages_ms: [] };
    this.measured = null;
    return { ...measured, pixelRatio: this.scene?.stage.pace.pixelRatio ?? 0 };
  }

  // More that a person should act on: of parts that are not the arm.
  private moreConditions(): Condition[] {
    return this.vr?.conditions() ?? [];
  }

  private welcome(welcome: Welcome): void {
    if (welcome.protocol !== PROTOCOL) {
      this.live.status = `the gateway speaks protocol ${welcome.protocol}, this page ${PROTOCOL}: load the page again`;
      return;
    }
    this.jogger.letGo();
    this.pending.forget();
    this.planner?.forget();
    this.live.takeWelcome(welcome);
    this.historyScrubber.goTo(null);
    const robot = JSON.stringify([welcome.robot, welcome.scene, welcome.layout]);
    if (robot !== this.robotShown || !this.plots) this.build(themeNow());
    this.robotShown = robot;
  }

  // Everything that depends on the robot, the scene or the colours.
  private build(theme: Theme): void {
    const { welcome } = this.live;
    if (!welcome) return;
    this.scene?.stage.renderer.dispose();
    const { ask } = this.pending;
    const motion = new MotionPanel(this.live, this.connection, ask);
    const mission = new MissionPanel(this.live, ask);
    const joints = new JointPanel(this.live, welcome, this.connection, ask, (places_m) => this.scene?.way.set(places_m));
    this.planner = joints.planner;
    const device = new DevicePanel(this.live, ask);
    const jog = new JogPanel(this.live, this.jogger, ask);
    const shape = welcome.robot.kind === 'serial' ? null : new ShapePanel(this.live, welcome.robot, ask);
    this.panels = [motion, mission, device, joints, ...(shape ? [shape] : [])];
    const practice = welcome.practice ? [new PracticePanel(welcome.robot, this.connection)] : [];
    this.pushCard = new PushCard(welcome.scene);
    const cards = [mission, motion, this.pushCard, device, jog, joints, ...(shape ? [shape] : []), ...practice];
    const steer = h('div', { class: 'panel' }, ...cards.map(({ element }) => element));
    const goTo = (time_s: number) => this.historyScrubber.goTo(time_s);
    this.plots = new LivePlots(this.live, welcome, theme, goTo);
    const events = new LiveEvents(this.live, goTo);
    this.panels.push(events);
    const runs = new RunList(welcome.ticket);
    const tabs = new Tabs([
      { name: 'Steer', panel: steer, shown: () => joints.reset() },
      { name: 'Plots', panel: h('div', { class: 'panel plots' }, this.plots.element) },
      { name: 'Events', panel: h('div', { class: 'panel' }, events.element) },
      { name: 'Runs', panel: runs.element, shown: () => void runs.load() },
    ], 'Steering and information');
    this.middle.replaceChildren(this.sceneOf(welcome, theme), tabs.element);
  }

  private sceneOf(welcome: Welcome, theme: Theme): HTMLElement {
    try {
      this.scene = new SceneView(welcome.robot, welcome.scene, theme);
    } catch (error) {
      this.scene = null;
      return h('p', { class: 'no-scene' }, `No 3-D here: ${String(error)}. Everything else works.`);
    }
    this.scene.onDrawn = (now_ms) => this.drawn(now_ms);
    if (welcome.robot.kind !== 'serial') this.addVr(welcome.robot, this.scene);
    this.handle = new TipHandle(this.scene.stage, sceneColours(theme).ghost);
    this.handle.onDrag = (place_m) => this.jogger.dragTo(place_m);
    this.handle.onDrop = () => this.jogger.drop();
    this.scene.addHelper(this.handle.ball);
    return h('div', { class: 'scene-place' }, this.scene.element);
  }

  private addVr(robot: CableRobot, scene: SceneView): void {
    this.vr?.end();
    this.vr = new Vr(robot, this.live, this.connection, scene, () => void this.stop.press());
    void Vr.isThere().then((isThere) => (this.vrButton.hidden = !isThere));
  }

  private async toggleVr(): Promise<void> {
    if (this.vr?.isOn) return this.vr.end();
    try {
      await this.vr?.begin();
    } catch (error) {
      this.pending.error('VR', { op: 'answer', ok: false, code: 'no session', message: String(error) });
    }
  }

  private message(message: FromGateway): void {
    const newest = this.live.newestEvent;
    this.live.take(message);
    if (message.op === 'plan') this.planner?.take(message);
    if (message.op === 'event' && message.sequence > newest && newest !== 0) this.pending.event(message);
  }

  private record(bytes: ArrayBuffer): number | null {
    const sequence = this.live.takeRecord(bytes, performance.now() / 1000);
    if (sequence !== null && this.historyScrubber.time_s === null) this.draw();
    return sequence;
  }

  // The newest state, or the one that is looked back at.
  private draw(): void {
    const sample = this.historyScrubber.sample();
    if (!sample || !this.scene) return;
    if (this.handle) {
      this.handle.isEnabled = this.live.status === '' && this.live.isMine && sample.facts.state === 'ENABLED' && this.historyScrubber.time_s === null;
      this.handle.place(values(sample, 'setpoint_cp'));
      this.scene.dragTarget_m = this.handle.isEnabled ? this.jogger.target : null;
      this.scene.tipLabel = this.handle.isEnabled ? this.tipText(sample) : '';
    }
    if (this.historyScrubber.time_s === null) this.scene.trail.add(values(sample, 'measured_cp'));
    this.scene.show(sample);
  }

  // Of a drag what is left to its target, and what slows the tip.
  private tipText(sample: Sample): string {
    if (!this.jogger.isJogging) return 'drag the tip';
    const { target } = this.jogger;
    const left = target ? `${lengthText(distance(target, values(sample, 'setpoint_cp')))} to the target` : '';
    return [left, slowdownText(sample)].filter(Boolean).join(', ');
  }

  private drawn(now_ms: number): void {
    this.plots?.update(now_ms);
    this.shownAge_s = this.live.age.age_s(performance.now() / 1000);
    if (!this.measured || this.historyScrubber.time_s !== null) return;
    if (Number.isFinite(this.lastFrame_ms)) this.measured.intervals_ms.push(now_ms - this.lastFrame_ms);
    this.lastFrame_ms = now_ms;
    this.measured.ages_ms.push(1000 * this.shownAge_s);
  }

  private words(): void {
    const now_s = performance.now() / 1000;
    if (this.live.updateAlarms(now_s, this.moreConditions())) this.alarms.update();
    this.status.update(now_s);
    this.pending.update();
    this.stop.update();
    this.historyScrubber.update();
    for (const panel of this.panels) panel.update(now_s);
    const sample = this.historyScrubber.sample();
    const { welcome } = this.live;
    if (!sample || !welcome) return setText(this.sentence, this.live.status);
    if (this.live.sample) this.pushCard?.show(this.live.sample);
    const isLive = this.live.isLive(now_s);
    this.sentence.classList.toggle('stale', !isLive);
    setText(this.sentence, `${isLive ? '' : 'last heard: '}${sentenceOf(sample, welcome.robot, welcome.scene, null)}`);
    this.scene?.sayInCorner(this.corner(sample, now_s));
  }

  // Age of what is seen, how often states come, how fine the picture is.
  private corner(sample: Sample, now_s: number): string {
    if (!this.live.isLive(now_s)) return 'NOT LIVE';
    const age_ms = 1000 * this.shownAge_s;
    const ratio = this.scene?.stage.pace.pixelRatio ?? 1;
    const coarse = ratio < 1 ? `, drawn at ${Math.round(100 * ratio)} %` : '';
    const share = value(sample, 'path.share');
    const path = Number.isFinite(share) ? `, path ${(100 * share).toFixed(0)} %` : '';
    return `state ${age_ms.toFixed(0)} ms old, ${this.live.states.perSecond(now_s)} a second${coarse}${path}`;
  }

  private keyDown(event: KeyboardEvent): void {
    const action = actionOf(event, isField(event.target as HTMLElement));
    if (!action || event.repeat) return;
    if (action.kind === 'stop') void this.stop.press();
    if (action.kind === 'hold') this.pending.ask('hold', { op: 'hold' });
    if (action.kind === 'jog') this.jogger.press(event.code, action.direction);
    if (action.kind === 'view') {
      const view = this.scene?.views[action.index];
      if (view) this.scene?.look(view);
    }
    event.preventDefault();
  }
}
