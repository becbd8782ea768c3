// The page of a recorded run: what became of it, the scene along its time, and everything that was recorded.
import type { Run } from '../data/run';
import { value, values } from '../data/sample';
import { sentence_of } from '../model/sentence';
import { SceneView } from '../scene/scene_view';
import type { Theme } from '../scene/palette';
import { h, set_text } from '../ui/dom';
import { PushCard } from '../ui/push_card';
import { Tabs } from '../ui/tabs';
import { theme_button, theme_now } from '../ui/theme';
import { CommandList } from './command_list';
import { EventList } from './event_list';
import { outcome_of, type Outcome } from './outcome';
import { report_panel } from './report_panel';
import { RunPlots } from './run_plots';
import { TimeLine } from './time_line';

const kWayPoints = 1500;

export class RunPage {
  readonly element: HTMLElement;
  private readonly time_line: TimeLine;
  private readonly plots: RunPlots;
  private readonly events: EventList;
  private readonly push_card: PushCard;
  private readonly sentence = h('p', { class: 'sentence' });
  private readonly scene_place = h('div', { class: 'scene-place' });
  private scene: SceneView | null = null;
  private way_rows: number[] = [];

  constructor(private readonly run: Run) {
    const go_to = (time_s: number) => this.time_line.go_to(time_s);
    const outcome = outcome_of(run.head);
    this.time_line = new TimeLine(run, (time_s) => this.show(time_s));
    this.plots = new RunPlots(run, theme_now(), go_to);
    this.push_card = new PushCard(run.head.scene);
    this.plots.element.prepend(this.push_card.element);
    this.events = new EventList(run, go_to);
    const commands = new CommandList(run, go_to);
    const tabs = new Tabs([
      { name: 'Plots', panel: this.plots.element },
      { name: 'Events', panel: this.events.element },
      { name: 'Commands', panel: commands.element },
      { name: 'Report', panel: report_panel(run.head) },
    ], 'Information');
    const header = h('header', { class: 'top' },
      h('h1', {}, 'Liana ', h('small', {}, run.head.title)), this.sentence,
      h('span', { class: `badge ${outcome.success ? 'good' : 'bad'}` }, outcome.success ? 'success' : run.head.report?.outcome ?? 'no report'),
      theme_button((theme) => this.set_theme(theme)));
    this.element = h('div', { class: 'page run' }, header, finding(outcome, run, go_to), h('div', { class: 'middle' }, this.scene_place, tabs.element), this.time_line.element);
    this.set_scene(theme_now());
    document.addEventListener('keydown', (event) => this.key(event));
    const failed_at = outcome.tick === null ? null : outcome.tick * run.head.period_s;
    this.time_line.go_to(failed_at ?? run.time_s(Math.floor(0.62 * run.rows)));
  }

  private show(time_s: number): void {
    const row = this.run.row_at(time_s);
    const sample = this.run.at(row);
    const { report, robot, scene, steps } = this.run.head;
    const is_whole = report?.outcome === 'success'; // of others the rest is not known
    const last = is_whole ? Math.max(...steps.map(({ index }) => index)) : null; // a mission may leave steps out
    set_text(this.sentence, sentence_of(sample, robot, scene, last));
    this.plots.at(time_s);
    this.events.at(sample.tick);
    this.push_card.show(sample);
    if (!this.scene) return;
    this.scene.trail.show(this.way_rows.findIndex((way_row) => way_row > row) + 1 || this.way_rows.length);
    const truth_m = value(sample, 'truth.clearance_m');
    this.scene.say_in_corner(Number.isFinite(truth_m) && truth_m < 100 ? `true clearance ${(1000 * truth_m).toFixed(1)} mm` : '');
    this.scene.show(sample);
  }

  private set_scene(theme: Theme): void {
    try {
      this.scene = new SceneView(this.run.head.robot, this.run.head.scene, theme);
    } catch (error) {
      this.scene_place.replaceChildren(h('p', { class: 'no-scene' }, `No 3-D here: ${String(error)}. Plots, events and commands are all there.`));
      return;
    }
    this.scene.tip_label = 'tip';
    this.scene_place.replaceChildren(this.scene.element);
    const every = Math.max(1, Math.ceil(this.run.rows / kWayPoints));
    const places: number[] = [];
    this.way_rows = [];
    for (let row = 0; row < this.run.rows; row += every) {
      const sample = this.run.at(row);
      const tip = values(sample, 'measured_cp');
      if (sample.facts.is_homed === false || !Number.isFinite(tip[0])) continue; // where it is, is not known yet
      this.way_rows.push(row);
      places.push(tip[0], tip[1], tip[2]);
    }
    this.scene.way.set(Float32Array.from(places));
    this.scene.trail.set(Float32Array.from(places));
  }

  private set_theme(theme: Theme): void {
    this.scene?.stage.renderer.dispose();
    this.set_scene(theme);
    this.plots.set_theme(theme);
    this.show(this.time_line.time_s);
  }

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (['INPUT', 'SELECT', 'BUTTON'].includes(target.tagName) && event.key === ' ') return;
    if (target.tagName === 'SELECT' || target.getAttribute('role') === 'tab' || event.ctrlKey || event.altKey) return;
    if (this.time_line.key(event)) return;
    const view = this.scene?.views[Number(event.key) - 1];
    if (view) this.scene?.look(view);
  }
}

// What failed, where, why and what to do; of a success one line.
function finding(outcome: Outcome, run: Run, go_to: (time_s: number) => void): HTMLElement {
  if (outcome.success) return h('section', { class: 'finding good', 'aria-label': 'Outcome' }, h('p', {}, outcome.what));
  const { tick } = outcome;
  const there = tick === null ? null : h('button', { type: 'button', onclick: () => go_to(tick * run.head.period_s) }, 'show that moment');
  return h('section', { class: 'finding bad', 'aria-label': 'Outcome' },
    h('h2', {}, outcome.what),
    h('dl', {},
      ...(outcome.where ? [h('dt', {}, 'Where'), h('dd', {}, outcome.where, ' ', there)] : []),
      ...(outcome.why ? [h('dt', {}, 'Why'), h('dd', {}, outcome.why)] : []),
      h('dt', {}, 'What to do'), h('dd', {}, outcome.todo.join(' '))));
}
