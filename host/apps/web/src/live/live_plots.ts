// Strips of the last minute; one of them is drawn again at a time, a few a second.
import type uPlot from 'uplot';
import { chartColours } from '../plots/chart_colours';
import { groupsOf, type Group } from '../plots/groups';
import { Strip } from '../plots/strip';
import type { Theme } from '../scene/palette';
import { h } from '../ui/dom';
import type { Live } from './live';
import type { Welcome } from './protocol';

const EVERY = 3; // rows: a thousand points a minute
const PERIOD_MS = 250;
const STRIP_PX = 132;

export class LivePlots {
  readonly element = h('div', { class: 'strips' });
  private readonly strips: { group: Group; strip: Strip; data: Float64Array[] }[];
  private next = 0;
  private last_ms = 0;

  constructor(private readonly live: Live, welcome: Welcome, theme: Theme, goTo: (time_s: number) => void) {
    const counts = new Map(welcome.layout.fields.map((f) => [f.name, f.count]));
    const groups = groupsOf(welcome.robot, welcome.scene, (field, index) => index < (counts.get(field) ?? 0));
    this.strips = groups.map((group) => ({ group, strip: new Strip(group, chartColours(theme), 396, STRIP_PX, goTo), data: [] }));
    this.element.append(...this.strips.map(({ strip }) => strip.element));
    new ResizeObserver(() => {
      const width = this.element.clientWidth;
      if (width > 0) for (const { strip } of this.strips) if (strip.plot.width !== width) strip.resize(width, STRIP_PX);
    }).observe(this.element);
  }

  // Draws one strip again when its turn has come and it is seen.
  update(now_ms: number): void {
    const { history } = this.live;
    if (!history || now_ms - this.last_ms < PERIOD_MS || this.element.offsetParent === null) return;
    this.last_ms = now_ms;
    // Strips of what never had a number are not shown: which of it an arm has, only its states tell.
    for (const { group, strip } of this.strips) strip.element.hidden = !group.sources.some((s) => history.known.has(s.field));
    const box = this.element.parentElement!.getBoundingClientRect();
    for (let tried = 0; tried < this.strips.length; ++tried) {
      const { group, strip } = this.strips[this.next];
      this.next = (this.next + 1) % this.strips.length;
      const at = strip.element.getBoundingClientRect();
      if (at.bottom < box.top || at.top > box.bottom) continue; // scrolled away
      const rows = Math.floor(history.rows / EVERY);
      const data = [Float64Array.from({ length: rows }, (_, i) => history.time_s(i * EVERY))];
      for (const s of group.sources) data.push(Float64Array.from({ length: rows }, (_, i) => history.value(i * EVERY, s.field, s.index) * s.factor));
      strip.set(data as unknown as uPlot.AlignedData);
      return;
    }
  }
}
