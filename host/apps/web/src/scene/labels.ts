// Words on the things of the scene: at most five, pushed apart, inside the picture and beside its controls; and the
// letters of axes.
import { h, setText } from '../ui/dom';
import { isIn, spreadLabels, type Area } from './spread_labels';
import type { Stage } from './stage';

const MOST = 5;
export const AXES = ['x', 'y', 'z'] as const;

export interface Label {
  text: string;
  place_m: ArrayLike<number>;
}

export class Labels {
  readonly layer = h('div', { class: 'labels', 'aria-hidden': 'true' });
  private readonly tags = Array.from({ length: MOST }, () => h('span', { class: 'label', hidden: true }));
  private readonly letters = Array.from({ length: 6 }, (_, i) => h('span', { class: `axis ${AXES[i % 3]}`, hidden: true }, AXES[i % 3]));

  constructor(private readonly stage: Stage) {
    this.layer.append(...this.tags, ...this.letters);
  }

  // The most important first; those behind the camera, outside the picture or under its controls are left out.
  show(labels: readonly Label[], taken: readonly Area[]): void {
    const { width, height } = this.stage;
    const seen: { label: Label; at: [number, number] }[] = [];
    for (const label of labels) {
      const at = this.pixelOf(label.place_m, taken);
      if (at) seen.push({ label, at });
      if (seen.length === MOST) break;
    }
    const areas = seen.map(({ label, at }) => ({ x: at[0] + 10, y: at[1] - 28, width: 7.2 * label.text.length + 10, height: 18 }));
    const isFree = spreadLabels(areas, width, height, taken);
    this.tags.forEach((tag, i) => {
      tag.hidden = !isFree[i];
      if (tag.hidden) return;
      setText(tag, seen[i].label.text);
      move(tag, areas[i].x, areas[i].y);
    });
  }

  // Letters at the ends of up to two crosses of axes, x, y, z of each; where they are.
  showLetters(places_m: readonly ArrayLike<number>[], taken: readonly Area[]): Area[] {
    return this.letters.flatMap((letter, i) => {
      const at = places_m[i] ? this.pixelOf(places_m[i], taken) : null;
      letter.hidden = !at;
      if (!at) return [];
      const area = { x: at[0] - 4, y: at[1] - 8, width: 8, height: 16 };
      move(letter, area.x, area.y);
      return [area];
    });
  }

  private pixelOf(place_m: ArrayLike<number>, taken: readonly Area[]): [number, number] | null {
    const { width, height } = this.stage;
    const at = Number.isFinite(place_m[0]) ? this.stage.pixelOf(place_m) : null;
    return at && at[0] > 0 && at[0] < width && at[1] > 0 && at[1] < height && !isIn(at, taken) ? at : null;
  }
}

function move(element: HTMLElement, x: number, y: number): void {
  element.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px)`;
}
