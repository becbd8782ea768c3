// Strips of a recorded run: all of it or a part, with a needle at the time of the scene.
import type uPlot from 'uplot';
import { csvOf, saveAs } from '../data/csv';
import type { Run } from '../data/run';
import { chartColours } from '../plots/chart_colours';
import { decimated } from '../plots/decimate';
import { groupsOf, type Group } from '../plots/groups';
import { Strip } from '../plots/strip';
import type { Theme } from '../scene/palette';
import { checkbox, h } from '../ui/dom';

const POINTS = 800;
const STRIP_PX = 132;
const WINDOWS_S = [0, 60, 20, 5]; // 0: everything

interface Shown {
  group: Group;
  strip: Strip;
  needle: HTMLElement;
  columns: Float32Array[];
}

export class RunPlots {
  readonly element: HTMLElement;
  private readonly list = h('div', { class: 'strips' });
  private shown: Shown[] = [];
  private window_s = 0;
  private time_s = 0;
  private range: [number, number];
  private width = 400;

  constructor(private readonly run: Run, private theme: Theme, private readonly goTo: (time_s: number) => void) {
    this.range = [run.time_s(0), run.time_s(run.rows - 1)];
    const span = h('select', { 'aria-label': 'how much time', onchange: () => this.setWindow(Number(span.value)) },
      ...WINDOWS_S.map((s) => h('option', { value: s }, s === 0 ? 'whole run' : `${s} s`)));
    const save = h('button', { type: 'button', onclick: () => saveAs(`${run.head.title.replace(/\W+/g, '_')}.csv`, csvOf(run, ...this.range)) }, 'CSV');
    save.title = 'keep the numbers of this time as a table';
    const filter = h('div', { class: 'filter', role: 'group', 'aria-label': 'strips' }, span, save);
    this.element = h('div', { class: 'panel plots' }, filter, this.list);
    this.build();
    for (const { group, strip } of this.shown) filter.append(this.choice(group.name, strip));
    new ResizeObserver(() => this.resize()).observe(this.list);
  }

  // Moves the needles; with a window that has gone, the curves, too.
  at(time_s: number): void {
    this.time_s = time_s;
    if (this.window_s > 0 && (time_s < this.range[0] || time_s > this.range[1])) this.setWindow(this.window_s);
    this.placeNeedles();
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    this.build();
  }

  private build(): void {
    const { telemetry } = this.run;
    // What never had a number has no curve: runs of older versions lack some.
    const has = (field: string, index: number) => telemetry.columns.get(field)?.[index]?.some(Number.isFinite) ?? false;
    const groups = groupsOf(this.run.head.robot, this.run.head.scene, has);
    this.shown = groups.map((group) => {
      const strip = new Strip(group, chartColours(this.theme), this.width, STRIP_PX, this.goTo);
      const needle = h('div', { class: 'plot-needle' });
      strip.plot.over.append(needle);
      const columns = group.sources.map((s) => telemetry.columns.get(s.field)![s.index].map((v) => v * s.factor));
      return { group, strip, needle, columns };
    });
    this.list.replaceChildren(...this.shown.map(({ strip }) => strip.element));
    this.fill();
  }

  private fill(): void {
    const first = this.run.rowAt(this.range[0]);
    const last = this.run.rowAt(this.range[1]);
    for (const { strip, columns } of this.shown) {
      strip.set(decimated((row) => this.run.time_s(row), columns, first, last, POINTS) as unknown as uPlot.AlignedData);
    }
    this.placeNeedles();
  }

  private setWindow(window_s: number): void {
    this.window_s = window_s;
    const begin = this.run.time_s(0);
    const end = this.run.time_s(this.run.rows - 1);
    const from = Math.max(begin, Math.min(end - window_s, this.time_s - window_s / 4));
    this.range = window_s === 0 ? [begin, end] : [from, Math.min(end, from + window_s)];
    this.fill();
  }

  // uPlot takes its new scales over in a microtask of its own.
  private placeNeedles(): void {
    queueMicrotask(() => this.placeNeedlesNow());
  }

  private placeNeedlesNow(): void {
    for (const { strip, needle } of this.shown) {
      needle.style.transform = `translateX(${Math.round(strip.plot.valToPos(this.time_s, 'x'))}px)`;
    }
  }

  private resize(): void {
    const width = this.list.clientWidth;
    if (width === 0 || width === this.width) return;
    this.width = width;
    for (const { strip } of this.shown) strip.resize(width, STRIP_PX);
    this.placeNeedles();
  }

  private choice(name: string, strip: Strip): HTMLElement {
    return checkbox(name, (on) => {
      const now = this.shown.find(({ group }) => group.name === name);
      (now?.strip ?? strip).element.hidden = !on;
    }, true);
  }
}
