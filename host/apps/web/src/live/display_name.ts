// How the person at this browser is called, so that owners of motion can be told apart: given once, kept in this browser.
import { h, setText } from '../ui/dom';
import { keep, kept } from '../ui/storage';
import type { Connection } from './connection';
import type { Live } from './live';

const KEY = 'liana-name';
const MAX_BYTES = 32;

// Why nobody can be called so; empty: it is a name.
export function nameProblem(name: string): string {
  const bytes = new TextEncoder().encode(name).length;
  if (bytes >= 1 && bytes <= MAX_BYTES && !/[\u0000-\u001f\u007f]/.test(name)) return '';
  return `A name has 1 to ${MAX_BYTES} bytes without control characters; this one has ${bytes}.`;
}

function inventedName(): string {
  return `browser-${crypto.getRandomValues(new Uint16Array(1))[0].toString(16).padStart(4, '0')}`;
}

// The name that was given in this browser; until then one like browser-3f2a, which is kept, too.
let name = '';
export function displayName(): string {
  name ||= kept(KEY) ?? '';
  if (nameProblem(name) !== '') keep(KEY, (name = inventedName()));
  return name;
}

export class NameForm {
  readonly element: HTMLElement;
  private readonly field = h('input', { type: 'text', class: 'own-name', 'aria-label': 'your name' });
  private readonly hint = h('span', { class: 'hint' });

  constructor(private readonly live: Live, private readonly connection: Connection) {
    this.field.value = displayName();
    this.element = h('form', { class: 'filter', 'aria-label': 'Your name', onsubmit: (event: SubmitEvent) => this.submit(event) },
      h('label', {}, 'your name ', this.field), h('button', { type: 'submit' }, 'call me so'), this.hint);
    this.element.hidden = live.welcome?.ticket !== undefined; // whoever has proven a token is called by its name
  }

  private submit(event: SubmitEvent): void {
    event.preventDefault();
    const wanted = this.field.value.trim();
    const why = nameProblem(wanted) || (this.live.isMine ? 'Give back motion first: a new name is a new connection.' : '');
    setText(this.hint, why);
    if (why || wanted === displayName()) return;
    keep(KEY, (name = wanted));
    this.connection.again();
  }
}
