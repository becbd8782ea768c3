// Dark or light: as the system has it, or as the person chose.
import type { Theme } from '../scene/palette';
import { h } from './dom';
import { keep, kept } from './storage';

const KEY = 'liana-theme';

export function themeNow(): Theme {
  const theme = kept(KEY);
  return theme === 'dark' || theme === 'light' ? theme : matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark';
}

export function apply(theme: Theme): void {
  document.documentElement.dataset.theme = theme;
}

// Switches to the other theme; `changed` draws again what has colours of its own.
export function themeButton(changed: (theme: Theme) => void): HTMLElement {
  return h('button', {
    type: 'button', class: 'quiet', title: 'dark or light', 'aria-label': 'switch between dark and light',
    onclick: () => {
      const theme = document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark';
      keep(KEY, theme);
      apply(theme);
      changed(theme);
    },
  }, '\u25d0');
}
