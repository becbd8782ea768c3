// The scene as a part of the page: canvas, tip picture, labels, legend, views; draws when something new is there.
import * as THREE from 'three';
import { isKnown, value, values, type Facts, type Sample } from '../data/sample';
import { isAtSite, payloadPlace } from '../model/payload_place';
import { lostCables, segmentsOf } from '../model/drive_names';
import type { Robot, Scene } from '../model/robot';
import { boundText, deviationText, NEAR_M } from '../model/distances';
import { spoken } from '../model/text';
import { distance, moved } from '../model/vector';
import { h, setClass, setText } from '../ui/dom';
import { ArmBody, GhostArm } from './arm_body';
import { AXES, Labels, type Label } from './labels';
import { legendOf } from './legend';
import type { Area } from './spread_labels';
import { FrameTurns } from './frame_pace';
import { ClosestPoint, GOAL_AXES_M, GoalCross, NodeBalls, Trail } from './markers';
import { sceneColours, type Theme } from './palette';
import { PayloadBody } from './payload_body';
import { Stage } from './stage';
import { surroundings } from './surroundings';
import { viewsOf, type View } from './views';

const WIDE_PX = 760; // narrower: the view from the tip is smaller
const LEGEND_PX = 1000; // narrower: the legend begins closed, for it would hide the arm
const TIP_PICTURE = { width: 280, height: 180 };
const BASE_POSE = [0, 0, 0, 1, 0, 0, 0];
const BASE_AXES_M = 0.45;
const EXAGGERATION = 10;
const LABELS_MS = 200; // words are laid out at most so often: that costs more than the whole scene's script

export class SceneView {
  readonly element: HTMLElement;
  readonly stage: Stage;
  readonly views: View[];
  readonly trail: Trail;
  readonly way: Trail; // the whole way of a recorded run
  onDrawn: (now_ms: number) => void = () => {};
  exaggerate = false;
  tipLabel = '';
  dragTarget_m: ArrayLike<number> | null = null;
  private errorText = '';
  private readonly arm: ArmBody;
  private readonly ghost: GhostArm;
  private readonly predicted: GhostArm;
  private readonly closest: ClosestPoint;
  private readonly drag: ClosestPoint; // the target of a drag
  private readonly goal = new GoalCross();
  private readonly nodes: NodeBalls;
  private readonly payload: PayloadBody | null;
  private readonly labels: Labels;
  private readonly corner = h('div', { class: 'corner' });
  private readonly error = h('div', { class: 'error-number' });
  private readonly tipFrame = h('div', { class: 'tip-frame', hidden: true }, h('span', {}, 'drawn from the tip'));
  private readonly viewButtons: HTMLButtonElement[];
  private readonly controls: HTMLElement[]; // what lies over the scene
  private controlAreas: Area[] | null = null; // null: to be measured anew
  private wantsTipView = true;
  private readonly legend: HTMLDetailsElement;
  private hasSize = false;
  private readonly colours;
  private view: View;
  private sample: Sample | null = null;
  private isDue = false;
  private hadState = false; // one came since the last frame
  private hasMissedOne = false; // one more came
  private labelsAt_ms = 0;
  private waitsSince_ms = 0;
  private readonly turns = new FrameTurns();
  private readonly drawnAngles = new Float32Array(16);

  // Throws when the browser has no WebGL.
  constructor(private readonly robot: Robot, private readonly scene: Scene, theme: Theme) {
    this.colours = sceneColours(theme);
    const canvas = h('canvas', { class: 'scene', tabindex: '0', 'aria-label': 'The arm in its scene: drag to turn, wheel to zoom' });
    this.stage = new Stage(canvas);
    this.stage.scene.background = new THREE.Color(this.colours.background);
    this.arm = new ArmBody(robot, this.colours.held, this.colours.lost);
    this.ghost = new GhostArm(robot, this.colours.ghost, 0.22);
    this.predicted = new GhostArm(robot, this.colours.predicted, 0.16);
    this.predicted.mesh.visible = false;
    this.closest = new ClosestPoint(this.colours.near);
    this.drag = new ClosestPoint(this.colours.predicted);
    this.nodes = new NodeBalls(this.arm.chain.nodes.length / 3, this.colours);
    this.trail = new Trail(this.colours.trail);
    this.way = new Trail(this.colours.way);
    const axes = new THREE.AxesHelper(0.9 * BASE_AXES_M);
    const world = [this.arm.group, this.ghost.mesh, this.predicted.mesh, this.closest.group, this.drag.group, this.goal.group, this.nodes.mesh];
    this.stage.scene.add(surroundings(scene, robot, this.colours), ...world, axes, this.way.line, this.trail.line);
    this.payload = scene.payload && scene.adapter ? new PayloadBody(scene.payload, scene.adapter, this.colours) : null;
    if (this.payload) this.stage.scene.add(this.payload.mesh, this.payload.adapter);
    const inTheWay = [axes, ...world.slice(1), ...this.arm.details, this.way.line, this.trail.line];
    for (const object of inTheWay) this.stage.hiddenFromTip.add(object);
    if (this.payload) this.stage.tipLooks = 'z'; // the way in
    this.labels = new Labels(this.stage);
    this.views = viewsOf(robot, scene);
    this.view = this.views[0];
    this.viewButtons = this.views.map((view, i) =>
      h('button', { type: 'button', title: `view: ${view.name} (key ${i + 1})`, onclick: () => this.look(view) }, view.name),
    );
    const bar = h('div', { class: 'views', role: 'group', 'aria-label': 'Views' }, ...this.viewButtons);
    const switches = { exaggerate: (on: boolean) => this.setExaggerated(on), predict: (on: boolean) => this.showPredicted(on), tipView: hasBodies(scene) ? (on: boolean) => this.showTipView(on) : null };
    this.legend = legendOf(robot, scene, this.colours, switches, () => this.controlsMoved());
    this.controls = [bar, this.legend, this.error, this.corner, this.tipFrame];
    this.element = h('section', { class: 'scene-view', 'aria-label': 'Scene' }, canvas, this.tipFrame, this.labels.layer, bar, this.legend, this.error, this.corner);
    new ResizeObserver(() => this.resize()).observe(this.element);
    const sizes = new ResizeObserver(() => this.controlsMoved());
    for (const control of this.controls) sizes.observe(control);
    this.look(this.view);
  }

  look(view: View): void {
    this.view = view;
    this.stage.look(view, this.arm.chain.tip.subarray(12, 15));
    this.stage.onMoved = () => this.drawSoon(false);
    this.viewButtons.forEach((button, i) => {
      setClass(button, 'chosen', this.views[i] === view);
      button.setAttribute('aria-pressed', String(this.views[i] === view));
    });
    this.drawSoon(false);
  }

  // Shows a moment of the arm with the next frame.
  show(sample: Sample): void {
    const isFirst = this.sample === null;
    this.sample = sample;
    if (isFirst) this.placeTipView(this.element.clientWidth);
    this.drawSoon(true);
  }

  // Something of other parts of the page that stands in the scene, but not in the picture of the tip's camera.
  addHelper(object: THREE.Object3D): void {
    this.stage.scene.add(object);
    this.stage.hiddenFromTip.add(object);
  }

  sayInCorner(text: string): void {
    setText(this.corner, text);
  }

  // Moves everything to the newest state without drawing: a headset draws by itself.
  moveNow(): void {
    if (this.sample) this.moveAll(this.sample);
  }

  tipFrameNow(): Float32Array {
    return this.arm.chain.tip;
  }

  // The headset is off: the canvas is this view's again.
  afterVr(): void {
    this.resize();
    this.look(this.view);
  }

  private setExaggerated(on: boolean): void {
    this.exaggerate = on;
    this.drawSoon(false);
  }

  private showTipView(on: boolean): void {
    this.wantsTipView = on;
    this.resize();
    this.drawSoon(false);
  }

  // Where labels may not be has changed.
  private controlsMoved(): void {
    this.controlAreas = null;
    this.drawSoon(false);
  }

  private showPredicted(on: boolean): void {
    this.predicted.mesh.visible = on;
    this.drawSoon(false);
  }

  private drawSoon(isState: boolean): void {
    if (isState && !this.hadState) this.waitsSince_ms = performance.now();
    this.hasMissedOne ||= isState && this.hadState;
    this.hadState ||= isState;
    if (this.isDue || this.stage.renderer.xr.isPresenting) return;
    this.isDue = true;
    requestAnimationFrame((now_ms) => this.draw(now_ms));
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0 || this.stage.renderer.xr.isPresenting) return;
    if (!this.hasSize) this.legend.open = width >= LEGEND_PX;
    this.hasSize = true;
    this.stage.resize(width, height);
    this.controlAreas = null;
    this.placeTipView(width);
    this.stage.render(this.arm.chain.tip); // at once: another size has emptied the canvas, and nobody may see that
    this.placeLabels();
  }

  // In the upper right corner; none before the first state, and where nothing could be seen.
  private placeTipView(width: number): void {
    const isShown = this.wantsTipView && this.sample !== null && hasBodies(this.scene);
    this.tipFrame.hidden = !isShown;
    if (!isShown) return void (this.stage.inset = null);
    const share = Math.min(1, width / WIDE_PX);
    const inset = { width: Math.round(TIP_PICTURE.width * share), height: Math.round(TIP_PICTURE.height * share), top: 8, left: 0 };
    inset.left = width - inset.width - 8;
    this.stage.inset = inset;
    Object.assign(this.tipFrame.style, { left: `${inset.left}px`, top: `${inset.top}px`, width: `${inset.width}px`, height: `${inset.height}px` });
  }

  private draw(now_ms: number): void {
    this.isDue = false;
    if (this.stage.renderer.xr.isPresenting) return;
    if (!this.turns.takes(now_ms)) return this.drawSoon(false);
    if (this.sample) this.moveAll(this.sample);
    const tip = this.arm.chain.tip;
    if (this.view.followsTip) this.stage.follow(tip.subarray(12, 15));
    this.stage.render(tip);
    if (now_ms - this.labelsAt_ms > LABELS_MS || !this.hadState) {
      this.labelsAt_ms = now_ms;
      this.placeLabels();
      setText(this.error, this.errorText);
    }
    const done_ms = performance.now();
    const isCoarserOrFiner = this.hadState && this.stage.pace.drawn(done_ms, done_ms - this.waitsSince_ms);
    if (this.hadState) this.turns.drawn(now_ms, this.hasMissedOne);
    this.hadState = this.hasMissedOne = false;
    if (isCoarserOrFiner) this.resize();
    this.onDrawn(now_ms);
  }

  private moveAll(sample: Sample): void {
    const measured = values(sample, 'measured_js_deg');
    const setpoint = values(sample, 'setpoint_js_deg');
    this.arm.markHeld(new Set((sample.facts.held ?? []).map((theta) => (theta - 1) >> 1)));
    this.arm.set(measured, values(sample, 'tension_N'), lostCables(sample.facts));
    this.moveGhost(sample, measured, setpoint);
    const stop = values(sample, 'verdict.stop_js_deg');
    const predicted = isKnown(stop) ? stop : values(sample, 'verdict.twin_js_deg');
    if (this.predicted.mesh.visible && isKnown(predicted)) this.predicted.set(predicted);
    this.nodes.set(this.arm.chain.nodes);
    this.goal.set(values(sample, 'goal_cp'));
    this.drag.set(this.dragTarget_m ?? [NaN], this.arm.chain.tip, 0);
    this.movePayload(sample.facts);
    const link = value(sample, 'clearance.link') - 1;
    const piece = this.arm.chain.pieces[link];
    this.closest.set(values(sample, 'clearance.where_m'), piece ? this.arm.chain.matrices.subarray(16 * link, 16 * link + 16) : null, piece?.length_m ?? 0);
  }

  // A payload on the tip goes along with the measured arm. The camera then looks past it, as the one that sees the adapter
  // does.
  private movePayload(facts: Facts): void {
    if (!this.payload) return;
    const place = payloadPlace(facts, this.scene);
    this.payload.set(place, this.arm.chain.tip);
    this.payload.adapter.visible = isAtSite(facts, this.scene, this.robot);
    if (place === 'tip') this.stage.hiddenFromTip.add(this.payload.mesh);
    else this.stage.hiddenFromTip.delete(this.payload.mesh);
  }

  // The commanded arm beside the measured one.
  private moveGhost(sample: Sample, measured: Float32Array, setpoint: Float32Array): void {
    this.ghost.mesh.visible = isKnown(setpoint);
    if (!this.ghost.mesh.visible) return;
    const factor = this.exaggerate ? EXAGGERATION : 1;
    for (let i = 0; i < setpoint.length; ++i) this.drawnAngles[i] = setpoint[i];
    this.ghost.set(this.drawnAngles);
    const deviation_m = distance(this.ghost.chain.tip.subarray(12, 15), this.arm.chain.tip.subarray(12, 15));
    if (factor > 1) {
      for (let i = 0; i < setpoint.length; ++i) this.drawnAngles[i] = measured[i] + factor * (setpoint[i] - measured[i]);
      this.ghost.set(this.drawnAngles);
    }
    const drawn = this.exaggerate ? `, drawn ${EXAGGERATION} times as large` : '';
    this.errorText = `${deviationText(sample, this.robot, deviation_m)}${drawn}`;
  }

  private placeLabels(): void {
    const { scene, sample } = this;
    const chain = this.arm.chain;
    const labels: Label[] = [];
    const clear_m = value(sample, 'clearance.distance_m');
    const isNear = clear_m < NEAR_M;
    if (sample && isNear) {
      labels.push({ text: boundText(sample), place_m: values(sample, 'clearance.where_m').slice() });
    }
    if (scene.rod) labels.push({ text: 'press rod: the goal', place_m: scene.rod.position_m });
    if (scene.slit) labels.push({ text: `slit, ${Math.round(2000 * scene.slit.half_gap_m)} mm`, place_m: scene.slit.frame.position_m });
    if (this.payload) labels.push({ text: 'payload', place_m: this.payload.centre_m });
    if (scene.adapter) labels.push({ text: 'adapter', place_m: scene.adapter.position_m });
    for (const body of scene.spheres ?? []) labels.push({ text: spoken(body.name), place_m: body.center_m });
    labels.push({ text: this.robot.kind === 'serial' ? 'base' : `base: ${segmentsOf(this.robot).length} motors`, place_m: [-0.16, 0, 0.1] });
    if (this.tipLabel) labels.push({ text: this.tipLabel, place_m: chain.tip.subarray(12, 15) });
    for (const body of scene.convex ?? []) {
      const at = body.points_m?.[0] ?? body.cylinder?.from_m ?? body.chain?.points_m[0];
      if (at) labels.push({ text: spoken(body.name), place_m: at });
    }
    const lost = lostCables(sample?.facts ?? {});
    if (lost.length > 0) {
      const segment = segmentsOf(this.robot)[lost[0]];
      labels.unshift({ text: `cable ${lost.map((drive) => drive + 1).join(', ')} lost`, place_m: chain.nodes.subarray(3 * (segment - 1), 3 * segment) });
    }
    const taken = (this.controlAreas ??= this.controls.filter((control) => !control.hidden).map(areaOf));
    const goalEnds = this.goal.group.visible ? axisEnds(values(sample, 'goal_cp'), 1.25 * GOAL_AXES_M) : [];
    const letters = this.labels.showLetters([...axisEnds(BASE_POSE, BASE_AXES_M), ...goalEnds], taken);
    this.labels.show(labels, [...taken, ...letters]);
  }
}

function areaOf(element: HTMLElement): Area {
  return { x: element.offsetLeft, y: element.offsetTop, width: element.offsetWidth, height: element.offsetHeight };
}

// Is there anything that could be seen from the tip?
function hasBodies(scene: Scene): boolean {
  return [scene.boxes, scene.spheres, scene.convex].some((bodies) => (bodies ?? []).length > 0) || !!(scene.slit ?? scene.rod ?? scene.payload ?? scene.adapter);
}

// The ends of a pose's axes, so long.
function axisEnds(pose: ArrayLike<number>, long_m: number): number[][] {
  return AXES.map((_, axis) => moved(pose, AXES.map((_axis, i) => (i === axis ? long_m : 0)), [0, 0, 0], true));
}
