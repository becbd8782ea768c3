// What this page is, and what it is not.
import { h } from '../ui/dom';

const IS = [
  'Liana\u2019s own controller, compiled to WebAssembly: every tick of 4 ms has the bits of the installed one.',
  'Both verification ends. Every command runs first on a copy of the controller, and in a simulation of arm and scene. What could touch is refused.',
  'The robot and scene tables that ship with Liana. The page makes no request; nothing leaves it.',
];
const IS_NOT = [
  'No real drives: each goes exactly where it is told, one tick later.',
  'No friction, no sagging, no noise and no delay: the arm stands where it is commanded.',
  'No clock that holds: a slow machine makes the arm slow. Verification runs in the same program as the controller.',
  'No bus, no camera, no force on the rod, no recording.',
  'No emergency stop of a machine: STOP is a command to this page.',
];

export function about(): HTMLElement {
  const list = (lines: string[]) => h('ul', {}, ...lines.map((line) => h('li', {}, line)));
  return h('section', { class: 'card about', 'aria-label': 'What this page is' },
    h('h2', {}, 'What this is'), list(IS), h('h2', {}, 'What it is not'), list(IS_NOT),
    h('p', { class: 'hint' }, 'The installed system simulates drives and the arm\u2019s physics: ./dev mission.'));
}
