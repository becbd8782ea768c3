// A tab list as screen readers know it: arrow keys go through it.
import { h } from './dom';

export interface Tab {
  name: string;
  panel: HTMLElement;
  shown?: () => void;
}

export class Tabs {
  readonly element: HTMLElement;
  private readonly buttons: HTMLButtonElement[];

  constructor(private readonly tabs: Tab[], label: string) {
    this.buttons = tabs.map((tab, i) =>
      h('button', { type: 'button', role: 'tab', id: `tab-${tab.name}`, 'aria-controls': `panel-${tab.name}`, onclick: () => this.choose(i) }, tab.name),
    );
    const list = h('div', { class: 'tabs', role: 'tablist', 'aria-label': label, onkeydown: (event: KeyboardEvent) => this.key(event) }, ...this.buttons);
    tabs.forEach((tab) => {
      tab.panel.id = `panel-${tab.name}`;
      tab.panel.setAttribute('role', 'tabpanel');
      tab.panel.setAttribute('aria-labelledby', `tab-${tab.name}`);
      tab.panel.tabIndex = 0;
    });
    this.element = h('section', { class: 'side', 'aria-label': label }, list, ...tabs.map((tab) => tab.panel));
    this.choose(0);
  }

  choose(which: number): void {
    this.tabs.forEach((tab, i) => {
      tab.panel.hidden = i !== which;
      this.buttons[i].setAttribute('aria-selected', String(i === which));
      this.buttons[i].tabIndex = i === which ? 0 : -1;
    });
    this.tabs[which].shown?.();
  }

  private key(event: KeyboardEvent): void {
    const way = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    if (way === 0) return;
    event.preventDefault();
    event.stopPropagation();
    const now = this.buttons.findIndex((button) => button.tabIndex === 0);
    const next = (now + way + this.tabs.length) % this.tabs.length;
    this.choose(next);
    this.buttons[next].focus();
  }
}
