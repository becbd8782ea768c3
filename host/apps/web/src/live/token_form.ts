// Who the person is, where the gateway asks for it: kept for this tab only.
import { h } from '../ui/dom';
import type { Token } from './protocol';

const KEY = 'liana-token';

export function keptToken(): Token | null {
  const text = sessionStorage.getItem(KEY);
  return text ? (JSON.parse(text) as Token) : null;
}

// Asks for name and token; `done` when both are kept.
export function tokenForm(why: string, done: () => void): HTMLElement {
  const name = h('input', { type: 'text', autocomplete: 'username', required: true });
  const secret = h('input', { type: 'password', autocomplete: 'current-password', required: true });
  return h('form', { class: 'card token', 'aria-label': 'Access', onsubmit: (event: SubmitEvent) => {
    event.preventDefault();
    sessionStorage.setItem(KEY, JSON.stringify({ name: name.value, secret: secret.value.trim() } satisfies Token));
    done();
  } }, h('h2', {}, why), h('label', {}, 'name ', name), h('label', {}, 'token ', secret), h('button', { type: 'submit' }, 'go on'),
    h('p', { class: 'hint' }, 'Names and tokens stand in the gateway\u2019s token file. The token itself is not sent: only the proof that you have it.'));
}
