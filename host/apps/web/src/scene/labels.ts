// Words on the things of the scene: at most five, pushed apart, inside the picture.
import { h, setText } from '../ui/dom';
import { spreadLabels, type Area } from './spread_labels';
import type { Stage } from './stage';

const MOST = 5;

export interface Label {
  text: string;
  place_m: ArrayLike<number>;
}

export class Labels {
  readonly layer = h('div', { class: 'labels', 'aria-hidden': 'true' });
  private readonly tags: HTMLElement[] = [];

  constructor(private readonly stage: Stage) {
    for (let i = 0; i < MOST; ++i) this.tags.push(h('span', { class: 'label', hidden: true }));
    this.layer.append(...this.tags);
  }

  // The most important first; those behind the camera or outside the picture are left out.
  show(labels: readonly Label[], taken: readonly Area[]): void {
    const { width, height } = this.stage;
    const seen: { label: Label; at: [number, number] }[] = [];
    for (const label of labels) {
      const at = Number.isFinite(label.place_m[0]) ? this.stage.pixelOf(label.place_m) : null;
      if (at && at[0] > 0 && at[0] < width && at[1] > 0 && at[1] < height) seen.push({ label, at });
      if (seen.length === MOST) break;
    }
    const areas = seen.map(({ label, at }) => ({ x: at[0] + 10, y: at[1] - 28, width: 7.2 * label.text.length + 10, height: 18 }));
    spreadLabels(areas, width, height, taken);
    this.tags.forEach((tag, i) => {
      tag.hidden = i >= seen.length;
      if (tag.hidden) return;
      setText(tag, seen[i].label.text);
      tag.style.transform = `translate(${Math.round(areas[i].x)}px, ${Math.round(areas[i].y)}px)`;
    });
  }
}
