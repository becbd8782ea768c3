// Dark or light: as the system has it, or as the person chose.
import type { Theme } from '../scene/palette';
import { h } from './dom';

const KEY = 'liana-theme';

function kept(): Theme | null {
  try {
    const theme = localStorage.getItem(KEY);
    return theme === 'dark' || theme === 'light' ? theme : null;
  } catch {
    return null; // file:// may have no storage
  }
}

export function themeNow(): Theme {
  return kept() ?? (matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark');
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
      try {
        localStorage.setItem(KEY, theme);
      } catch {
        // for this time only, then
      }
      apply(theme);
      changed(theme);
    },
  }, '\u25d0');
}
