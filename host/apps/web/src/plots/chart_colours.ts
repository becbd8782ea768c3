// Colours of the strips in both themes.
import type { Theme } from '../scene/palette';
import type { Colours } from './strip';

export function chartColours(theme: Theme): Colours {
  return theme === 'dark'
    ? { text: '#a9b7c6', grid: '#212c38', back: '#0c1117', limit: '#ff7466' }
    : { text: '#3d4b5a', grid: '#dde4eb', back: '#ffffff', limit: '#b3261e' };
}
