// The page to try Liana without installing it: steer the tip through the slit, stop, see tensions and clearance.
import * as THREE from 'three';
import { value, values } from '../data/sample';
import type { CableRobot, Scene } from '../model/robot';
import { sentenceOf } from '../model/sentence';
import { lengthText } from '../model/text';
import { quaternionOf, type Pose } from '../model/vector';
import { sceneColours, type Theme } from '../scene/palette';
import { SceneView } from '../scene/scene_view';
import { TipHandle } from '../steer/handle';
import { nextGoal, sumOf } from '../steer/jog';
import { actionOf, isField, JOGS, type Direction } from '../steer/keyboard';
import { checkbox, h, setClass, setText } from '../ui/dom';
import { themeButton, themeNow } from '../ui/theme';
import { about } from './about';
import { hintOf } from './guide';
import { TensionBars } from './tension_bars';
import { INTERVAL_S, type Request, type TryArm, type TrySample } from './try_arm';
import { Way } from './way';

const SPEED = { tip_m_s: 0.06, turn_rad_s: 0.15, inTip: false };
const MAGNET_M = 0.2; // a line of sight that passes the way so near means the way
const LEAD_M = 0.12; // along the way, before the tip
const MOST_BEHIND_S = 0.1; // a page that stood still does not catch up
const BUDGET_MS = 24; // of a frame, for the arm
const WORDS_MS = 150;

// What moves the tip.
type Steering = { kind: 'drag'; place_m: [number, number, number] } | { kind: 'jog' } | { kind: 'show' };

export class TryPage {
  readonly element: HTMLElement;
  sample: TrySample;
  private readonly way: Way;
  private readonly bars: TensionBars;
  private readonly sentence = h('p', { class: 'sentence' });
  private readonly hint = h('p', { class: 'next', role: 'status' });
  private readonly clearance = h('p', { class: 'figure' });
  private readonly verdicts = h('p', { class: 'hint' });
  private readonly pace = h('span', { class: 'hint' });
  private readonly place = h('div', { class: 'scene-place' });
  private readonly buttons: Record<'enable' | 'disable' | 'clear', HTMLButtonElement>;
  private readonly showMe: HTMLButtonElement;
  private scene: SceneView | null = null;
  private handle: TipHandle | null = null;
  private steering: Steering | null = null;
  private readonly jogs = new Map<string, Direction>();
  private goal: Pose | null = null; // of jogging
  private request: Request = 'none';
  private keepsToLine = true;
  private times = 1;
  private behind_s = 0;
  private last_ms = NaN;
  private words_ms = 0;
  private leastClear_m = Infinity;

  constructor(private readonly arm: TryArm, private readonly robot: CableRobot, private readonly tables: Scene) {
    this.sample = arm.sample();
    this.way = new Way(tables, [...values(this.sample, 'setpoint_cp')]);
    this.bars = new TensionBars(robot);
    const button = (name: 'enable' | 'disable' | 'clear') => h('button', { type: 'button', onclick: () => this.ask(name) }, name);
    this.buttons = { enable: button('enable'), disable: button('disable'), clear: button('clear') };
    this.showMe = h('button', { type: 'button', 'aria-pressed': 'false', onclick: () => this.toggleShow() }, 'show me');
    const stop = h('button', { type: 'button', class: 'stop', title: 'stop, brakes, power off (Escape)', onclick: () => this.stop() }, 'STOP ', h('kbd', {}, 'Esc'));
    const header = h('header', { class: 'top' }, h('h1', {}, 'Liana ', h('small', {}, 'try it')), this.sentence, themeButton((theme) => this.draw(theme)),
      h('div', { class: 'stop-place', role: 'region', 'aria-label': 'Stop' }, stop));
    const side = h('section', { class: 'side', 'aria-label': 'Steering' }, h('div', { class: 'panel', tabindex: '0' }, this.nextCard(), this.figures(), this.bars.element, this.jogCard(), about()));
    this.element = h('div', { class: 'page try' }, header, h('div', { class: 'middle' }, this.place, side));
    document.addEventListener('keydown', (event) => this.keyDown(event));
    document.addEventListener('keyup', (event) => this.release(event.code));
    window.addEventListener('blur', () => this.letGo());
    document.addEventListener('visibilitychange', () => document.hidden && this.letGo());
    this.draw(themeNow());
    this.show();
    requestAnimationFrame((now_ms) => this.frame(now_ms));
  }

  // Of everything that the arm remembers (for tests).
  hash(): string {
    return this.arm.hash();
  }

  // Where the tip is in the picture [pixels] (for tests).
  tipPixel(): [number, number] | null {
    return this.scene?.stage.pixelOf(values(this.sample, 'setpoint_cp')) ?? null;
  }

  private nextCard(): HTMLElement {
    const speeds = h('select', { 'aria-label': 'how fast time passes', onchange: () => (this.times = Number(speeds.value)) },
      ...[1, 2, 4].map((times) => h('option', { value: times }, times === 1 ? 'as fast as in truth' : `${times} times as fast`)));
    return h('section', { class: 'card', 'aria-label': 'Next step' }, h('h2', {}, 'Next'), this.hint,
      h('div', { class: 'buttons' }, this.buttons.enable, this.showMe, this.buttons.disable, this.buttons.clear),
      h('div', { class: 'filter' }, speeds, this.pace),
      checkbox('keep to the line while I drag near it', (on) => (this.keepsToLine = on), true));
  }

  private figures(): HTMLElement {
    return h('section', { class: 'card', 'aria-label': 'Clearance' }, h('h2', {}, 'Clearance'), this.clearance, this.verdicts);
  }

  private jogCard(): HTMLElement {
    const jog = ([name, direction, key]: (typeof JOGS)[number]) => {
      const release = () => this.release(name);
      return h('button', {
        type: 'button', title: `key ${key}`, 'data-jog': name, onpointerdown: () => this.press(name, direction),
        onpointerup: release, onpointercancel: release, onpointerleave: release,
        oncontextmenu: (event: Event) => event.preventDefault(),
      }, name, h('kbd', {}, key));
    };
    return h('section', { class: 'card', 'aria-label': 'Tip' }, h('h2', {}, 'Tip, axes of the base'), h('div', { class: 'jog' }, ...JOGS.map(jog)),
      h('p', { class: 'hint' }, 'Hold a button or its key to move. Letting go brings the arm to rest.'));
  }

  private draw(theme: Theme): void {
    this.scene?.stage.renderer.dispose();
    try {
      this.scene = new SceneView(this.robot, this.tables, theme);
    } catch (error) {
      this.scene = null;
      return this.place.replaceChildren(h('p', { class: 'no-scene' }, `No 3-D here: ${String(error)}. The buttons work all the same.`));
    }
    this.scene.way.set(this.way.points());
    this.handle = new TipHandle(this.scene.stage, sceneColours(theme).ghost);
    this.handle.onDrag = (place_m) => (this.steering = { kind: 'drag', place_m });
    this.handle.onDrop = () => this.letGo();
    this.scene.addHelper(this.handle.ball);
    this.place.replaceChildren(this.scene.element);
    this.scene.show(this.sample);
  }

  // Acts in the next interval.
  private ask(request: Request): void {
    this.request = request;
  }

  stop(): void {
    this.letGo();
    this.ask('stop');
  }

  private letGo(): void {
    this.jogs.clear();
    this.steering = null;
    this.goal = null;
  }

  private press(name: string, direction: Direction): void {
    this.jogs.set(name, direction);
    this.steering = { kind: 'jog' };
  }

  private release(name: string): void {
    if (this.jogs.delete(name) && this.jogs.size === 0) this.letGo();
  }

  private toggleShow(): void {
    const shows = this.steering?.kind !== 'show';
    this.letGo();
    if (!shows) return;
    if (this.sample.facts.state === 'DISABLED') this.ask('enable');
    this.steering = { kind: 'show' };
  }

  private keyDown(event: KeyboardEvent): void {
    const action = actionOf(event, isField(event.target as HTMLElement));
    if (!action || event.repeat) return;
    if (action.kind === 'stop') this.stop();
    if (action.kind === 'hold') this.letGo();
    if (action.kind === 'jog') this.press(event.code, action.direction);
    if (action.kind === 'view') {
      const view = this.scene?.views[action.index];
      if (view) this.scene?.look(view);
    }
    event.preventDefault();
  }

  // Where the tip should go in the next interval.
  private wanted(): Pose | null {
    if (!this.steering || this.sample.facts.state !== 'ENABLED') return null;
    const tip = values(this.sample, 'setpoint_cp');
    if (this.steering.kind === 'show') return this.along(tip, this.way.length_m);
    if (this.steering.kind === 'drag') return this.dragged(tip, this.steering.place_m);
    this.goal = nextGoal(this.goal, tip, sumOf(this.jogs.values()), SPEED, INTERVAL_S, this.robot.limits);
    return this.goal;
  }

  // On the way, from beside the tip towards `s_m`.
  private along(tip: Float32Array, s_m: number): Pose {
    const now_m = this.way.nearestTo(tip).s_m;
    return this.way.at(Math.max(now_m - LEAD_M, Math.min(now_m + LEAD_M, s_m)));
  }

  private dragged(tip: Float32Array, place_m: [number, number, number]): Pose {
    if (!this.keepsToLine || !this.scene) return [...place_m, ...quaternionOf(tip)];
    const eye = this.scene.stage.camera.getWorldPosition(new THREE.Vector3()).toArray();
    const meant = this.way.nearestToSight(eye, place_m);
    const isOnLine = this.way.nearestTo(tip).off_m < MAGNET_M && meant.off_m < MAGNET_M;
    return isOnLine ? this.along(tip, meant.s_m) : [...place_m, ...this.way.attitudeAt(place_m)];
  }

  private frame(now_ms: number): void {
    requestAnimationFrame((next_ms) => this.frame(next_ms));
    const passed_s = Number.isNaN(this.last_ms) ? 0 : (now_ms - this.last_ms) / 1000;
    this.last_ms = now_ms;
    this.behind_s = Math.min(this.behind_s + this.times * passed_s, this.times * MOST_BEHIND_S);
    let ran = 0;
    for (const begun_ms = performance.now(); this.behind_s >= INTERVAL_S && performance.now() - begun_ms < BUDGET_MS; ++ran) {
      this.arm.interval(this.request, this.wanted());
      this.request = 'none';
      this.behind_s -= INTERVAL_S;
      if (this.steering) this.sample = this.arm.sample(); // the next goal begins where the tip is
    }
    if (ran > 0) this.show();
    if (now_ms - this.words_ms < WORDS_MS) return;
    this.words_ms = now_ms;
    this.words();
  }

  private show(): void {
    this.sample = this.arm.sample();
    if (!this.scene) return;
    const tip = values(this.sample, 'setpoint_cp');
    const isEnabled = this.sample.facts.state === 'ENABLED';
    if (this.handle) {
      this.handle.isEnabled = isEnabled;
      this.handle.place(tip);
    }
    this.scene.tipLabel = isEnabled && !this.steering ? 'drag the tip' : '';
    if (isEnabled) this.scene.trail.add(tip);
    this.scene.show(this.sample);
  }

  private words(): void {
    const { sample } = this;
    const { state, commands, clearance } = sample.facts;
    const clear_m = value(sample, 'clearance.distance_m');
    if (state === 'ENABLED') this.leastClear_m = Math.min(this.leastClear_m, clear_m);
    const hint = hintOf(sample, this.way);
    if (hint.weight === 'done' && this.steering?.kind === 'show') this.letGo();
    setText(this.hint, hint.text);
    this.hint.dataset.weight = hint.weight;
    setText(this.sentence, sentenceOf(sample, this.robot, this.tables, null));
    const least = Number.isFinite(this.leastClear_m) ? `, least so far ${lengthText(this.leastClear_m)}` : '';
    setText(this.clearance, `${lengthText(clear_m)} to the ${clearance?.body ?? 'scene'}${least}`);
    setText(this.verdicts, `${commands.released} commands verified and taken, ${commands.refused} refused`);
    this.bars.show(values(sample, 'tension_N'));
    const isOff = state === 'DISABLED';
    setClass(this.buttons.enable, 'primary', isOff);
    this.buttons.enable.disabled = !isOff;
    this.showMe.disabled = !isOff && state !== 'ENABLED';
    this.buttons.disable.disabled = state !== 'ENABLED';
    this.buttons.clear.disabled = state !== 'FAULT';
    this.showMe.setAttribute('aria-pressed', String(this.steering?.kind === 'show'));
    setText(this.showMe, this.steering?.kind === 'show' ? 'stop showing' : 'show me');
    setText(this.pace, this.behind_s > 0.9 * this.times * MOST_BEHIND_S ? 'this machine is slower' : '');
  }
}
