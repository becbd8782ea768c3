// Dark or light: as the system has it, or as the person chose.
import type { Theme } from '../scene/palette';
import { h } from './dom';
import { keep, kept } from './storage';

const KEY = 'liana-theme';

const systemIsLight = () => matchMedia('(prefers-color-scheme: light)');

function systemTheme(): Theme {
  return systemIsLight().matches ? 'light' : 'dark';
}

export function themeNow(): Theme {
  const theme = kept(KEY);
  return theme === 'dark' || theme === 'light' ? theme : systemTheme();
}

export function apply(theme: Theme): void {
  document.documentElement.dataset.theme = theme;
}

// Goes along with the system's theme while the person has chosen none.
function followSystem(changed: (theme: Theme) => void): void {
  systemIsLight().addEventListener('change', () => {
    if (kept(KEY)) return;
    apply(themeNow());
    changed(themeNow());
  });
}

// Switches to the other theme; `changed` draws again what has colours of its own. Whoever comes back to the system's
// theme follows it again.
export function themeButton(changed: (theme: Theme) => void): HTMLElement {
  followSystem(changed);
  return h('button', {
    type: 'button', class: 'quiet', title: 'dark or light; the system\u2019s theme is followed until you choose the other one', 'aria-label': 'switch between dark and light',
    onclick: () => {
      const theme = themeNow() === 'dark' ? 'light' : 'dark';
      keep(KEY, theme === systemTheme() ? '' : theme);
      apply(theme);
      changed(theme);
    },
  }, '\u25d0');
}
