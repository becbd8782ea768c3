// Buttons of the handles beside trigger and squeeze (layout "xr-standard"): what a press means.
import type { Side } from './handles';

export type VrAction = 'hold' | 'stop' | 'mode' | 'scale';

export interface Pressed {
  buttons: readonly { pressed: boolean }[];
}

const LOWER = 4; // A or X
const UPPER = 5; // B or Y
const ACTIONS: Record<Side, Record<number, VrAction>> = {
  right: { [LOWER]: 'hold', [UPPER]: 'stop' },
  left: { [LOWER]: 'mode', [UPPER]: 'scale' },
};

export class VrButtons {
  private readonly was = new Set<string>();

  // Those that went down since the last call.
  pressed(side: Side, gamepad: Pressed | null): VrAction[] {
    const actions: VrAction[] = [];
    for (const index of [LOWER, UPPER]) {
      const key = `${side} ${index}`;
      const isDown = gamepad?.buttons[index]?.pressed ?? false;
      if (isDown && !this.was.has(key)) actions.push(ACTIONS[side][index]);
      if (isDown) this.was.add(key);
      else this.was.delete(key);
    }
    return actions;
  }
}

export const SCALES = [0.5, 1, 2, 4];

// The scale after this one, around.
export function nextScale(scale: number): number {
  const at = SCALES.findIndex((s) => s > scale);
  return at < 0 ? SCALES[0] : SCALES[at];
}

// Mode: which node the left handle moves; after the last one none (0), where the tip alone is steered.
export function nextNode(node: number, nodes: number): number {
  return (node + 1) % (nodes + 1);
}
