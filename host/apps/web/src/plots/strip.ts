// One strip of curves (uPlot) on an opaque canvas in software: stroking on a GPU that is not there costs ten times more.
import uPlot from 'uplot';
import { colourKey, h } from '../ui/dom';

export interface Curve {
  label: string;
  colour: string;
  dashed?: boolean;
}

export interface Colours {
  text: string;
  grid: string;
  back: string;
  mark: string;
}

// All 2D canvases of the page are uPlot's.
export function useSoftwareCanvas(): void {
  const original = HTMLCanvasElement.prototype.getContext as (type: string, options?: object) => RenderingContext | null;
  HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, type: string, options?: object) {
    return original.call(this, type, type === '2d' ? { ...options, willReadFrequently: true, alpha: false } : options);
  } as typeof HTMLCanvasElement.prototype.getContext;
}

const TITLE_PX = 18;

// A little more than the values; nothing beyond `most`.
function yRange(low: number | null, high: number | null, most: number): [number, number] {
  if (low === null || high === null) return [0, 1];
  const top = Math.min(high, most);
  const bottom = Math.min(low, top);
  const room = top > bottom ? 0.06 * (top - bottom) : 1;
  return [bottom - room, top + room];
}

export class Strip {
  readonly element: HTMLElement;
  readonly plot: uPlot;
  private readonly holder = h('div', { class: 'strip-plot' });

  constructor(title: string, curves: Curve[], colours: Colours, width: number, height: number, clicked: (time_s: number) => void, most = Infinity) {
    const axis = { stroke: colours.text, grid: { stroke: colours.grid, width: 1 }, ticks: { stroke: colours.grid, width: 1, size: 4 }, gap: 3, font: '10px sans-serif' };
    this.plot = new uPlot(
      {
        width,
        height: height - TITLE_PX,
        pxAlign: false,
        legend: { show: false },
        cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
        padding: [4, 8, 0, 0],
        scales: { x: { time: false }, y: { range: (_u, low, high) => yRange(low, high, most) } },
        axes: [{ ...axis, size: 22 }, { ...axis, size: 36 }],
        series: [{}, ...curves.map((c) => ({ label: c.label, stroke: c.colour, width: 1, dash: c.dashed ? [4, 3] : undefined, points: { show: false } }))],
        hooks: { drawClear: [(u) => this.clear(u, colours.back)] },
      },
      [[], ...curves.map(() => [])] as unknown as uPlot.AlignedData,
      this.holder,
    );
    this.plot.over.addEventListener('click', () => {
      const { left } = this.plot.cursor;
      if (left !== undefined && left >= 0) clicked(this.plot.posToVal(left, 'x'));
    });
    const keys = curves.length > 8 ? [] : curves.map((c) => colourKey(c.colour, c.label));
    this.element = h('figure', { class: 'strip' }, h('figcaption', {}, title, ' ', ...keys), this.holder);
  }

  resize(width: number, height: number): void {
    this.plot.setSize({ width, height: height - TITLE_PX });
  }

  // NaN is a value that is not there; uPlot calls it null, and knows no scale where it finds one.
  set(data: uPlot.AlignedData): void {
    const known = data.map((column) => (Array.prototype.some.call(column, Number.isNaN) ? Array.from(column, (v) => (Number.isNaN(v) ? null : v)) : column));
    this.plot.setData(known as uPlot.AlignedData);
  }

  private clear(u: uPlot, colour: string): void {
    u.ctx.fillStyle = colour;
    u.ctx.fillRect(0, 0, u.ctx.canvas.width, u.ctx.canvas.height);
  }
}
