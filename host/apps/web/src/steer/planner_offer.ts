// A way around, where the straight way to a goal of angles is refused: one click has the planner look for it, a second one
// carries it out. The plan is good for where the arm stands now; lianad checks it like every path.
import { values, type LianaEvent } from '../data/sample';
import type { Connection } from '../live/connection';
import type { Live } from '../live/live';
import type { FromPlanner, PlannedWay, Welcome } from '../live/protocol';
import type { Ask } from '../live/pending_command';
import { chainOf } from '../model/arm_chain';
import { refusalText } from '../model/outcome_text';
import { angleCount, type Robot } from '../model/robot';
import { lengthText, spoken } from '../model/text';
import { distance } from '../model/vector';
import { h, setClass, setText } from '../ui/dom';

const FILE = 'way.json';
const MAX_POINTS = 500; // of move_path
const MOVED_DEG = 0.01; // in any angle: the arm stands elsewhere
const MAX_PLACES = 3000; // of a line in the scene
const MAX_PIECES = 10; // straight ones that the tip's way has from point to point
const REFUSED = 'The straight way is refused, as the line at the top says.';

// The points of a plan for an arm of so many angles. Throws with what is wrong in words.
export function pointsOfPlan(text: string, count: number): number[][] {
  let plan: { waypoints_deg?: unknown };
  try {
    plan = JSON.parse(text) as typeof plan;
  } catch (error) {
    throw new Error(`this file is not JSON (${String(error)}): give one that liana plan --out has written`);
  }
  const points = plan?.waypoints_deg;
  const isPoint = (point: unknown) => Array.isArray(point) && point.length === count && point.every((x) => Number.isFinite(x));
  if (!Array.isArray(points) || points.length < 1 || points.length > MAX_POINTS || !points.every(isPoint))
    throw new Error(`waypoints_deg: allowed 1 to ${MAX_POINTS} points of ${count} angles: give a file that liana plan --out has written for this robot`);
  return points as number[][];
}

// Where the tip goes: x, y, z of each place.
export function tipWay_m(robot: Robot, points_deg: readonly number[][]): Float32Array {
  const chain = chainOf(robot);
  const places: number[] = [];
  const pieces = Math.min(MAX_PIECES, Math.floor(MAX_PLACES / points_deg.length));
  points_deg.forEach((to, k) => {
    const from = points_deg[Math.max(0, k - 1)];
    for (let i = 1; i <= pieces; ++i) {
      chain.set(to.map((angle, j) => from[j] + (i / pieces) * (angle - from[j])));
      places.push(...chain.tip.subarray(12, 15));
    }
  });
  return Float32Array.from(places);
}

export function length_m(places_m: Float32Array): number {
  let sum_m = 0;
  for (let i = 3; i < places_m.length; i += 3) sum_m += distance(places_m.subarray(i, i + 3), places_m.subarray(i - 3, i));
  return sum_m;
}

// Length of the tip's way, time at its speed limits, and least clearance.
export function wayText(robot: Robot, way: PlannedWay, tip_m: number): string {
  const clear = way.min_clearance_m === null ? 'nothing in the scene' : `at least ${lengthText(way.min_clearance_m)} to ${spoken(way.nearest)}`;
  const min_s = Math.max(way.duration_s, tip_m / robot.limits.tip_speed_m_s);
  return `Way found: ${lengthText(tip_m)} of the tip, at least ${Math.round(min_s)} s, ${clear}.`;
}

// Whether the arm is no longer commanded to be where the way begins.
export function hasMoved(from_deg: readonly number[], setpoint_deg: ArrayLike<number>): boolean {
  return from_deg.some((angle, i) => !(Math.abs(angle - setpoint_deg[i]) <= MOVED_DEG));
}

type Step = 'none' | 'refused' | 'planning' | 'found';

export class PlannerOffer {
  readonly element: HTMLElement;
  private readonly says = h('p', { role: 'status' });
  private readonly plan = h('button', { type: 'button', 'data-action': 'plan a way', title: 'nothing moves yet', onclick: () => void this.begin() }, 'plan a way');
  private readonly cancel = h('button', { type: 'button', 'data-action': 'cancel plan', onclick: () => void this.connection.request({ op: 'end_plan' }) }, 'cancel');
  private readonly carry = h('button', { type: 'button', 'data-action': 'carry out', title: 'checked as a whole, then carried out', onclick: () => this.carryOut() }, 'carry it out');
  private readonly offer = h('div', { class: 'offer', hidden: true }, this.says, h('div', { class: 'filter' }, this.plan, this.cancel, this.carry));
  private readonly file: HTMLElement;
  private goal_deg: number[] = [];
  private number = 0; // of the goal: what comes about others is late
  private lastEvent = 0;
  private isAsked = false; // the goal, and it is not yet refused
  private way: PlannedWay | null = null;

  // `show` draws the tip's way in the scene; nothing: none.
  constructor(private readonly live: Live, private readonly welcome: Welcome, private readonly connection: Connection, private readonly ask: Ask, private readonly show: (places_m: Float32Array) => void) {
    const answer = h('span', { class: 'hint', role: 'status' });
    const file = h('input', { type: 'file', accept: '.json', 'aria-label': 'plan to carry out', onchange: () => {
      const [chosen] = file.files ?? [];
      if (chosen) void this.carryFile(chosen).catch((error: Error) => error.message).then((text) => setText(answer, `${chosen.name}: ${text}`));
      file.value = '';
    } });
    this.file = h('label', { class: 'filter' }, `carry out a plan (${FILE}): `, file);
    this.element = h('div', {}, this.offer, this.file, answer);
  }

  // A goal has just been asked for.
  asked(goal_deg: number[]): void {
    if (!this.cancel.hidden && !this.offer.hidden) void this.connection.request({ op: 'end_plan' });
    this.goal_deg = goal_deg;
    ++this.number;
    this.lastEvent = this.live.newestEvent;
    this.isAsked = this.welcome.robot.kind !== 'serial'; // the planner is for cable arms
    this.step('none');
  }

  // Offers the planner when the way to the goal was refused; withdraws a way that begins where the arm is no longer.
  update(): void {
    const { live } = this;
    const setpoint_deg = values(live.sample, 'setpoint_js_deg');
    if (this.isAsked && !hasMoved(this.goal_deg, setpoint_deg)) this.isAsked = false; // it has come there
    if (this.isAsked && live.events.some((event: LianaEvent) => event.sequence > this.lastEvent && refusalText(event) !== '')) {
      this.isAsked = false;
      this.step('refused', REFUSED);
    }
    if (this.way && hasMoved(this.way.from_deg, setpoint_deg)) this.step('refused', 'The arm has moved since the way was planned. Plan it again.');
  }

  // A new connection to the gateway knows nothing of what was planned.
  forget(): void {
    ++this.number;
    this.isAsked = false;
    this.step('none');
  }

  take(message: FromPlanner): void {
    if (message.number !== this.number) return;
    if (message.phase === 'planning') this.step('planning', `Planning for ${message.for_s} s: ${message.text}`);
    if (message.phase === 'none') this.step('refused', message.text);
    if (message.phase !== 'found') return;
    const tip_m = tipWay_m(this.welcome.robot, message.points_deg);
    this.step('found', wayText(this.welcome.robot, message, length_m(tip_m)));
    this.way = message;
    this.show(tip_m);
  }

  private async begin(): Promise<void> {
    const number = ++this.number;
    this.step('planning', 'Planning.');
    const answer = await this.connection.request({ op: 'plan', number, goal_deg: this.goal_deg });
    if (!answer.ok && number === this.number) this.step('refused', `Not planned: ${answer.message ?? ''}.`);
  }

  private carryOut(): void {
    if (this.way) this.ask('planned way', { op: 'move_path', points_deg: this.way.points_deg });
    this.step('none');
  }

  private async carryFile(file: File): Promise<string> {
    this.ask('plan', { op: 'move_path', points_deg: pointsOfPlan(await file.text(), angleCount(this.welcome.robot)) });
    return 'checked as a whole, then carried out';
  }

  private step(step: Step, text = ''): void {
    if (this.way) this.show(new Float32Array());
    this.way = null;
    setText(this.says, text);
    setClass(this.says, 'warning', step === 'refused');
    this.offer.hidden = step === 'none';
    this.plan.hidden = step !== 'refused';
    this.cancel.hidden = step !== 'planning';
    this.carry.hidden = step !== 'found';
  }
}
