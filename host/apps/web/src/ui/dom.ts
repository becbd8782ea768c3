// Elements in one expression.

type Child = Node | string | null | undefined;

interface Attributes {
  [name: string]: string | number | boolean | ((event: never) => void) | undefined;
}

// An element with attributes (functions become listeners of the event behind `on`; false and undefined are left out).
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name.slice(2), value as unknown as EventListener);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== undefined) element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child): child is Node | string => child !== null && child !== undefined));
  return element;
}

// A box with its words.
export function checkbox(text: string, switched: (on: boolean) => void, checked = false): HTMLElement {
  const box = h('input', { type: 'checkbox', checked, onchange: () => switched(box.checked) });
  return h('label', {}, box, text);
}

// What a colour means.
export function colourKey(colour: string, text: string): HTMLElement {
  return h('span', { class: 'key' }, h('i', { style: `background:${colour}` }), text);
}

// Writes a text only where it changed: what did not change is not laid out again, nor read aloud again.
export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

export function setClass(element: Element, name: string, on: boolean): void {
  if (element.classList.contains(name) !== on) element.classList.toggle(name, on);
}
