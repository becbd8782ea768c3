// One strip of curves (uPlot) on an opaque canvas in software: stroking on a GPU that is not there costs ten times more.
import uPlot from 'uplot';
import { colourKey, h, setText } from '../ui/dom';

export interface Curve {
  label: string;
  colour: string;
  dash?: number[];
}

// A value that the curves should not reach.
export interface Limit {
  at: number;
  name: string;
}

export interface Colours {
  text: string;
  grid: string;
  back: string;
  limit: string;
}

// All 2D canvases of the page are uPlot's.
export function useSoftwareCanvas(): void {
  const original = HTMLCanvasElement.prototype.getContext as (type: string, options?: object) => RenderingContext | null;
  HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, type: string, options?: object) {
    return original.call(this, type, type === '2d' ? { ...options, willReadFrequently: true, alpha: false } : options);
  } as typeof HTMLCanvasElement.prototype.getContext;
}

const TITLE_PX = 18;

// A little more than the values, nothing beyond `most`; the limits that are nearest to the values are seen, too, where
// that leaves the values at least a third of the height.
export function yRange(low: number | null, high: number | null, most: number, limits: readonly Limit[]): [number, number] {
  if (low === null || high === null) return [0, 1];
  let top = Math.min(high, most);
  let bottom = Math.min(low, top);
  const span = Math.max(top - bottom, 0.2 * Math.max(Math.abs(top), Math.abs(bottom)));
  const above = Math.min(...limits.map(({ at }) => at).filter((at) => at >= top));
  const below = Math.max(...limits.map(({ at }) => at).filter((at) => at <= bottom));
  if (above - bottom < 3 * span) top = above;
  if (top - below < 3 * span) bottom = below;
  const room = top > bottom ? 0.06 * (top - bottom) : 1;
  return [bottom - room, top + room];
}

const NEAR_PX = 14;

// What a strip shows.
export interface StripContent {
  title: string;
  sources: readonly Curve[];
  most?: number;
  limits?: readonly Limit[];
  note?: string;
}

export class Strip {
  readonly element: HTMLElement;
  readonly plot: uPlot;
  private readonly holder = h('div', { class: 'strip-plot' });
  private readonly reading = h('span', { class: 'reading' });

  constructor(private readonly content: StripContent, private readonly colours: Colours, width: number, height: number, clicked: (time_s: number) => void) {
    const { title, sources: curves, most = Infinity, limits = [], note } = content;
    const axis = { stroke: colours.text, grid: { stroke: colours.grid, width: 1 }, ticks: { stroke: colours.grid, width: 1, size: 4 }, gap: 3, font: '10px sans-serif' };
    this.plot = new uPlot(
      {
        width,
        height: height - TITLE_PX,
        pxAlign: false,
        legend: { show: false },
        cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
        padding: [4, 8, 0, 0],
        scales: { x: { time: false }, y: { range: (_u, low, high) => yRange(low, high, most, limits) } },
        axes: [{ ...axis, size: 22, space: 44 }, { ...axis, size: 40, space: 15 }],
        series: [{}, ...curves.map((c) => ({ label: c.label, stroke: c.colour, width: 1, dash: c.dash, points: { show: false } }))],
        hooks: { drawClear: [(u) => this.clear(u, colours.back)], draw: [(u) => this.drawLimits(u)], setCursor: [(u) => this.read(u)] },
      },
      [[], ...curves.map(() => [])] as unknown as uPlot.AlignedData,
      this.holder,
    );
    this.plot.over.addEventListener('click', () => {
      const { left } = this.plot.cursor;
      if (left !== undefined && left >= 0) clicked(this.plot.posToVal(left, 'x'));
    });
    const keys = note ? [h('span', {}, note)] : curves.map((c) => colourKey(c.colour, c.label));
    this.element = h('figure', { class: 'strip' }, h('figcaption', {}, this.reading, title, ' ', ...keys), this.holder);
  }

  resize(width: number, height: number): void {
    this.plot.setSize({ width, height: height - TITLE_PX });
  }

  // NaN is a value that is not there; uPlot calls it null, and knows no scale where it finds one.
  set(data: uPlot.AlignedData): void {
    const known = data.map((column) => (Array.prototype.some.call(column, Number.isNaN) ? Array.from(column, (v) => (Number.isNaN(v) ? null : v)) : column));
    this.plot.setData(known as uPlot.AlignedData);
  }

  // Name and value of the curve under the mouse.
  private read(u: uPlot): void {
    const { idx, top } = u.cursor;
    const values = u.series.map((_, i) => (i > 0 && typeof idx === 'number' ? u.data[i][idx] : null));
    const away_px = values.map((v) => (typeof v === 'number' ? Math.abs(u.valToPos(v, 'y') - (top ?? -Infinity)) : Infinity));
    const nearest = away_px.indexOf(Math.min(...away_px));
    const curve = this.content.sources[nearest - 1];
    setText(this.reading, curve && away_px[nearest] < NEAR_PX ? `${curve.label}: ${values[nearest]!.toPrecision(4)} ` : '');
  }

  // Dashed lines with their names, where they are within the strip.
  private drawLimits(u: uPlot): void {
    const { ctx, bbox } = u;
    const { min = NaN, max = NaN } = u.scales.y;
    ctx.save();
    Object.assign(ctx, { strokeStyle: this.colours.limit, fillStyle: this.colours.limit, lineWidth: 1, font: '10px sans-serif' });
    ctx.setLineDash([6, 4]);
    for (const [i, { at, name }] of (this.content.limits ?? []).entries()) {
      if (!(at > min && at < max)) continue;
      const y = Math.round(u.valToPos(at, 'y', true)) + 0.5;
      ctx.beginPath();
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.stroke();
      ctx.textAlign = i % 2 === 0 ? 'right' : 'left'; // names of limits that are close do not meet
      ctx.fillText(`${name} ${at}`, i % 2 === 0 ? bbox.left + bbox.width - 2 : bbox.left + 2, y < bbox.top + 14 ? y + 10 : y - 3);
    }
    ctx.restore();
  }

  private clear(u: uPlot, colour: string): void {
    u.ctx.fillStyle = colour;
    u.ctx.fillRect(0, 0, u.ctx.canvas.width, u.ctx.canvas.height);
  }
}
