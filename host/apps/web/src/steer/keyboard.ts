// What keys mean in the console. `code` is the place on the keyboard, so that all layouts have the same places.

// Velocity of the tip that a key asks for: along x, y, z and about them, -1 to 1.
export type Direction = readonly [number, number, number, number, number, number];

const JOG: Record<string, Direction> = {
  KeyW: [1, 0, 0, 0, 0, 0],
  KeyS: [-1, 0, 0, 0, 0, 0],
  KeyA: [0, 1, 0, 0, 0, 0],
  KeyD: [0, -1, 0, 0, 0, 0],
  KeyE: [0, 0, 1, 0, 0, 0],
  KeyQ: [0, 0, -1, 0, 0, 0],
  KeyJ: [0, 0, 0, 0, 0, 1],
  KeyL: [0, 0, 0, 0, 0, -1],
  KeyI: [0, 0, 0, 0, -1, 0],
  KeyK: [0, 0, 0, 0, 1, 0],
  KeyU: [0, 0, 0, -1, 0, 0],
  KeyO: [0, 0, 0, 1, 0, 0],
};

export type Action = { kind: 'stop' } | { kind: 'hold' } | { kind: 'view'; index: number } | { kind: 'jog'; direction: Direction };

export interface Key {
  code: string;
  key: string;
  ctrlKey: boolean;
  altKey: boolean;
  metaKey: boolean;
}

// Escape stops whatever has the focus; everything else only outside of fields where people write.
export function actionOf(key: Key, inField: boolean): Action | null {
  if (key.key === 'Escape') return { kind: 'stop' };
  if (inField || key.ctrlKey || key.altKey || key.metaKey) return null;
  if (key.code === 'KeyH') return { kind: 'hold' };
  const view = /^Digit([1-9])$/.exec(key.code);
  if (view) return { kind: 'view', index: Number(view[1]) - 1 };
  const direction = JOG[key.code];
  return direction ? { kind: 'jog', direction } : null;
}

// Does this element take letters itself?
export function isField(element: { tagName: string; type?: string } | null): boolean {
  if (!element) return false;
  if (element.tagName === 'TEXTAREA' || element.tagName === 'SELECT') return true;
  return element.tagName === 'INPUT' && !['checkbox', 'radio', 'button'].includes(element.type ?? 'text');
}
