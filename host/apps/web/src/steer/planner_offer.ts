// A way around, where the straight way to a goal of angles is refused: the planner's command to copy, and its file to
// carry out. The planner is a program of its own, which may take a minute.
import { values, type LianaEvent } from '../data/sample';
import type { Live } from '../live/live';
import type { Welcome } from '../live/protocol';
import type { Ask } from '../live/pending_command';
import { refusalText } from '../model/outcome_text';
import { angleCount, type Scene } from '../model/robot';
import { h, setText } from '../ui/dom';

const FILE = 'way.json';
const MAX_POINTS = 500; // of move_path

const listed = (angles_deg: ArrayLike<number>) => Array.from(angles_deg, (angle) => Number(angle.toFixed(3))).join(',');

// What plans a way from here to the goal in this scene, with the margin that verification asks for.
export function plannerCommand(robot: string, scene: Scene, from_deg: ArrayLike<number>, to_deg: ArrayLike<number>): string {
  const { prediction_m = 0, refuse_m = 0 } = scene.margins ?? {};
  const margin = prediction_m + refuse_m > 0 ? ` --margin=${(prediction_m + refuse_m).toFixed(4)}` : '';
  return `liana plan --robot ${robot} --scene ${scene.name || 'none'} --from-deg=${listed(from_deg)} --to-deg=${listed(to_deg)}${margin} --out ${FILE}`;
}

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

export class PlannerOffer {
  readonly element: HTMLElement;
  private readonly why = h('p', { class: 'warning' }, 'The straight way is refused, as the line at the top says. Plan a way around:');
  private readonly command = h('code');
  private readonly offer: HTMLElement;
  private goal_deg: number[] | null = null; // asked for and not yet refused
  private lastEvent = 0;

  constructor(private readonly live: Live, private readonly welcome: Welcome, ask: Ask) {
    const answer = h('span', { class: 'hint', role: 'status' });
    const file = h('input', { type: 'file', accept: '.json', 'aria-label': 'plan to carry out', onchange: () => {
      const [chosen] = file.files ?? [];
      if (chosen) void this.carryOut(chosen, ask).catch((error: Error) => error.message).then((text) => setText(answer, `${chosen.name}: ${text}`));
      file.value = '';
    } });
    const copy = h('button', { type: 'button', 'data-action': 'copy plan', onclick: () => {
      void navigator.clipboard?.writeText(this.command.textContent ?? '').then(() => setText(answer, 'copied: run it in a terminal, then open its file here'));
    } }, 'copy the planner\u2019s command');
    this.offer = h('div', { class: 'offer', hidden: true }, this.why, this.command, h('div', { class: 'filter' }, copy));
    this.element = h('div', {}, this.offer, h('label', { class: 'filter' }, `carry out a plan (${FILE}): `, file), answer);
  }

  private async carryOut(file: File, ask: Ask): Promise<string> {
    ask('plan', { op: 'move_path', points_deg: pointsOfPlan(await file.text(), angleCount(this.welcome.robot)) });
    return 'checked as a whole, then carried out';
  }

  // A goal has just been asked for.
  asked(goal_deg: number[]): void {
    this.goal_deg = goal_deg;
    this.lastEvent = this.live.newestEvent;
    this.offer.hidden = true;
  }

  // Offers the planner when the way to the goal was refused.
  update(): void {
    if (!this.goal_deg) return;
    const isRefused = this.live.events.some((event: LianaEvent) => event.sequence > this.lastEvent && refusalText(event) !== '');
    if (!isRefused) return;
    const { robot, scene } = this.welcome;
    setText(this.command, plannerCommand(robot.name, scene, values(this.live.sample, 'setpoint_js_deg'), this.goal_deg));
    this.goal_deg = null;
    this.offer.hidden = false;
  }
}
