// What keys mean in the console. `code` is the place on the keyboard, so that all layouts have the same places.

// Velocity of the tip that a key asks for: along x, y, z and about them, -1 to 1.
export type Direction = readonly [number, number, number, number, number, number];

// Button, direction and key of each.
export const JOGS: readonly [string, Direction, string][] = [
  ['x+', [1, 0, 0, 0, 0, 0], 'W'],
  ['x\u2212', [-1, 0, 0, 0, 0, 0], 'S'],
  ['y+', [0, 1, 0, 0, 0, 0], 'A'],
  ['y\u2212', [0, -1, 0, 0, 0, 0], 'D'],
  ['z+', [0, 0, 1, 0, 0, 0], 'E'],
  ['z\u2212', [0, 0, -1, 0, 0, 0], 'Q'],
  ['turn left', [0, 0, 0, 0, 0, 1], 'J'],
  ['turn right', [0, 0, 0, 0, 0, -1], 'L'],
  ['turn up', [0, 0, 0, 0, -1, 0], 'I'],
  ['turn down', [0, 0, 0, 0, 1, 0], 'K'],
  ['roll left', [0, 0, 0, -1, 0, 0], 'U'],
  ['roll right', [0, 0, 0, 1, 0, 0], 'O'],
];
const DIRECTIONS = new Map(JOGS.map(([, direction, key]) => [`Key${key}`, direction]));

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
  const direction = DIRECTIONS.get(key.code);
  return direction ? { kind: 'jog', direction } : null;
}

// Does this element take letters itself?
export function isField(element: { tagName: string; type?: string } | null): boolean {
  if (!element) return false;
  if (element.tagName === 'TEXTAREA' || element.tagName === 'SELECT') return true;
  return element.tagName === 'INPUT' && !['checkbox', 'radio', 'button'].includes(element.type ?? 'text');
}
