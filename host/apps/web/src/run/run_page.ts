// The page of a recorded run: what became of it, the scene along its time, and everything that was recorded.
import type { Run } from '../data/run';
import { value, values } from '../data/sample';
import { sentenceOf } from '../model/sentence';
import { SceneView } from '../scene/scene_view';
import type { Theme } from '../scene/palette';
import { h, setText } from '../ui/dom';
import { PushCard } from '../ui/push_card';
import { Tabs } from '../ui/tabs';
import { themeButton, themeNow } from '../ui/theme';
import { CommandList } from './command_list';
import { EventList } from './event_list';
import { outcomeOf, type Outcome } from './outcome';
import { replayLine } from './replay_line';
import { reportPanel } from './report_panel';
import { RunPlots } from './run_plots';
import { TimeLine } from './time_line';

const WAY_POINTS = 1500;

export class RunPage {
  readonly element: HTMLElement;
  private readonly timeLine: TimeLine;
  private readonly plots: RunPlots;
  private readonly events: EventList;
  private readonly pushCard: PushCard;
  private readonly sentence = h('p', { class: 'sentence' });
  private readonly scenePlace = h('div', { class: 'scene-place' });
  private scene: SceneView | null = null;
  private wayRows: number[] = [];

  constructor(private readonly run: Run) {
    const goTo = (time_s: number) => this.timeLine.goTo(time_s);
    const outcome = outcomeOf(run.head);
    this.timeLine = new TimeLine(run, (time_s) => this.show(time_s));
    this.plots = new RunPlots(run, themeNow(), goTo);
    this.pushCard = new PushCard(run.head.scene);
    this.plots.element.prepend(this.pushCard.element);
    this.events = new EventList(run, goTo);
    const commands = new CommandList(run, goTo);
    const tabs = new Tabs([
      { name: 'Plots', panel: this.plots.element },
      { name: 'Events', panel: this.events.element },
      { name: 'Commands', panel: commands.element },
      { name: 'Report', panel: reportPanel(run.head) },
    ], 'Information');
    const header = h('header', { class: 'top' },
      h('h1', {}, 'Liana ', h('small', {}, run.head.title)), this.sentence,
      h('span', { class: `badge ${outcome.success ? 'good' : 'bad'}` }, outcome.success ? 'success' : run.head.report?.outcome ?? 'no report'),
      themeButton((theme) => this.setTheme(theme)));
    this.element = h('div', { class: 'page run' }, header, finding(outcome, run, goTo), h('div', { class: 'middle' }, this.scenePlace, tabs.element), this.timeLine.element);
    this.setScene(themeNow());
    document.addEventListener('keydown', (event) => this.key(event));
    const failedAt = outcome.tick === null ? null : outcome.tick * run.head.period_s;
    this.timeLine.goTo(failedAt ?? run.time_s(Math.floor(0.62 * run.rows)));
  }

  private show(time_s: number): void {
    const row = this.run.rowAt(time_s);
    const sample = this.run.at(row);
    const { report, robot, scene, steps } = this.run.head;
    const isWhole = report?.outcome === 'success'; // of others the rest is not known
    const last = isWhole ? Math.max(...steps.map(({ index }) => index)) : null; // a mission may leave steps out
    setText(this.sentence, sentenceOf(sample, robot, scene, last));
    this.plots.at(time_s);
    this.events.at(sample.tick);
    this.pushCard.show(sample);
    if (!this.scene) return;
    this.scene.trail.show(this.wayRows.findIndex((wayRow) => wayRow > row) + 1 || this.wayRows.length);
    const truth_m = value(sample, 'truth.clearance_m');
    this.scene.sayInCorner(Number.isFinite(truth_m) && truth_m < 100 ? `true clearance ${(1000 * truth_m).toFixed(1)} mm` : '');
    this.scene.show(sample);
  }

  private setScene(theme: Theme): void {
    try {
      this.scene = new SceneView(this.run.head.robot, this.run.head.scene, theme);
    } catch (error) {
      this.scenePlace.replaceChildren(h('p', { class: 'no-scene' }, `No 3-D here: ${String(error)}. Plots, events and commands are all there.`));
      return;
    }
    this.scene.tipLabel = 'tip';
    this.scenePlace.replaceChildren(this.scene.element);
    const every = Math.max(1, Math.ceil(this.run.rows / WAY_POINTS));
    const places: number[] = [];
    this.wayRows = [];
    for (let row = 0; row < this.run.rows; row += every) {
      const sample = this.run.at(row);
      const tip = values(sample, 'measured_cp');
      if (sample.facts.is_homed === false || !Number.isFinite(tip[0])) continue; // where it is, is not known yet
      this.wayRows.push(row);
      places.push(tip[0], tip[1], tip[2]);
    }
    this.scene.way.set(Float32Array.from(places));
    this.scene.trail.set(Float32Array.from(places));
  }

  private setTheme(theme: Theme): void {
    this.scene?.stage.renderer.dispose();
    this.setScene(theme);
    this.plots.setTheme(theme);
    this.show(this.timeLine.time_s);
  }

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (['INPUT', 'SELECT', 'BUTTON'].includes(target.tagName) && event.key === ' ') return;
    if (target.tagName === 'SELECT' || target.getAttribute('role') === 'tab' || event.ctrlKey || event.altKey) return;
    if (this.timeLine.key(event)) return;
    const view = this.scene?.views[Number(event.key) - 1];
    if (view) this.scene?.look(view);
  }
}

// What failed, where, why and what to do; of a success one line.
function finding(outcome: Outcome, run: Run, goTo: (time_s: number) => void): HTMLElement {
  if (outcome.success) return h('section', { class: 'finding good', 'aria-label': 'Outcome' }, h('p', {}, outcome.what), replayLine(run.head));
  const { tick } = outcome;
  const there = tick === null ? null : h('button', { type: 'button', onclick: () => goTo(tick * run.head.period_s) }, 'show that moment');
  return h('section', { class: 'finding bad', 'aria-label': 'Outcome' },
    h('h2', {}, outcome.what),
    h('dl', {},
      ...(outcome.where ? [h('dt', {}, 'Where'), h('dd', {}, outcome.where, ' ', there)] : []),
      ...(outcome.why ? [h('dt', {}, 'Why'), h('dd', {}, outcome.why)] : []),
      h('dt', {}, 'What to do'), h('dd', {}, outcome.todo.join(' '))),
    replayLine(run.head));
}
