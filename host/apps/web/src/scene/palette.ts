// Colours of the scene in both themes, and of the arm's segments in scene, plots and legend.

export type Theme = 'dark' | 'light';

export const SEGMENT_COLOURS = ['#4e9bd6', '#57b894', '#d9b44a', '#e08a45', '#c96bb0', '#8f86e0', '#7fb0a8', '#b0a08f'];

export function segmentColour(segment: number): string {
  return SEGMENT_COLOURS[segment % SEGMENT_COLOURS.length];
}

// Dark, light.
const SCENE_COLOURS = {
  background: ['#10161d', '#f2f5f8'],
  grid: ['#1f2b37', '#d5dde5'],
  gridAxis: ['#34506a', '#a5b7c8'],
  edge: ['#9fb7d9', '#40587a'],
  glass: ['#4f86e0', '#2f66c8'],
  wall: ['#a8b0ba', '#68727e'],
  obstacle: ['#c25a50', '#b8473c'],
  rod: ['#ffe14a', '#c79200'],
  payload: ['#c9a86a', '#b08c48'],
  base: ['#7b8592', '#7b8592'],
  ghost: ['#7fd4ff', '#0a78b8'],
  predicted: ['#c8a2ff', '#7a3fd0'],
  trail: ['#ffffff', '#1b2631'],
  way: ['#5a6b7c', '#93a3b3'],
  slit: ['#3fd0b0', '#00866c'],
  near: ['#ffb020', '#c05a00'],
  lost: ['#ff4fd8', '#c4008f'],
  held: ['#f4f6f8', '#1b2631'],
};

export type SceneColours = Record<keyof typeof SCENE_COLOURS, string>;

export function sceneColours(theme: Theme): SceneColours {
  const pairs = Object.entries(SCENE_COLOURS).map(([name, [dark, light]]) => [name, theme === 'dark' ? dark : light]);
  return Object.fromEntries(pairs) as SceneColours;
}
