// Colours of the scene in both themes, and of the arm's segments in scene, plots and legend.

export type Theme = 'dark' | 'light';

export const SEGMENT_COLOURS = ['#4e9bd6', '#57b894', '#d9b44a', '#e08a45', '#c96bb0', '#8f86e0', '#7fb0a8', '#b0a08f'];

export function segmentColour(segment: number): string {
  return SEGMENT_COLOURS[segment % SEGMENT_COLOURS.length];
}

export interface SceneColours {
  background: string;
  grid: string;
  gridAxis: string;
  edge: string;
  glass: string;
  wall: string;
  obstacle: string;
  rod: string;
  payload: string;
  base: string;
  ghost: string;
  predicted: string;
  trail: string;
  way: string;
  slit: string;
  near: string;
  held: string;
}

const DARK: SceneColours = {
  background: '#10161d',
  grid: '#1f2b37',
  gridAxis: '#34506a',
  edge: '#9fb7d9',
  glass: '#4f86e0',
  wall: '#a8b0ba',
  obstacle: '#c25a50',
  rod: '#ffe14a',
  payload: '#c9a86a',
  base: '#7b8592',
  ghost: '#7fd4ff',
  predicted: '#c8a2ff',
  trail: '#ffffff',
  way: '#5a6b7c',
  slit: '#3fd0b0',
  near: '#ffb020',
  held: '#f4f6f8',
};

const LIGHT: SceneColours = {
  background: '#f2f5f8',
  grid: '#d5dde5',
  gridAxis: '#a5b7c8',
  edge: '#40587a',
  glass: '#2f66c8',
  wall: '#68727e',
  obstacle: '#b8473c',
  rod: '#c79200',
  payload: '#b08c48',
  base: '#7b8592',
  ghost: '#0a78b8',
  predicted: '#7a3fd0',
  trail: '#1b2631',
  way: '#93a3b3',
  slit: '#00866c',
  near: '#c05a00',
  held: '#1b2631',
};

export function sceneColours(theme: Theme): SceneColours {
  return theme === 'dark' ? DARK : LIGHT;
}
