// Buttons of the handles beside trigger and squeeze (layout "xr-standard"): what a press means.

export type VrAction = 'hold' | 'stop' | 'mode' | 'scale';

export interface Pressed {
  buttons: readonly { pressed: boolean }[];
}

const kLower = 4; // A or X
const kUpper = 5; // B or Y
const kActions: Record<'right' | 'left', Record<number, VrAction>> = {
  right: { [kLower]: 'hold', [kUpper]: 'stop' },
  left: { [kLower]: 'mode', [kUpper]: 'scale' },
};

export class VrButtons {
  private readonly was = new Set<string>();

  // Those that went down since the last call.
  pressed(side: 'right' | 'left', gamepad: Pressed | null): VrAction[] {
    const actions: VrAction[] = [];
    for (const index of [kLower, kUpper]) {
      const key = `${side} ${index}`;
      const is_down = gamepad?.buttons[index]?.pressed ?? false;
      if (is_down && !this.was.has(key)) actions.push(kActions[side][index]);
      if (is_down) this.was.add(key);
      else this.was.delete(key);
    }
    return actions;
  }
}

export const kScales = [0.5, 1, 2, 4];

// The scale after this one, around.
export function next_scale(scale: number): number {
  const at = kScales.findIndex((s) => s > scale);
  return at < 0 ? kScales[0] : kScales[at];
}

// Mode: which node the left handle moves; after the last one none (0), where the tip alone is steered.
export function next_node(node: number, nodes: number): number {
  return (node + 1) % (nodes + 1);
}
