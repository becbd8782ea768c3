// What colours and shapes mean, with units; and what can be shown besides.
import type { Robot, Scene } from '../model/robot';
import { css, scaleOf, tensionColour } from '../model/tension_colour';
import { checkbox, colourKey, h } from '../ui/dom';
import { segmentColour, type SceneColours } from './palette';

function segmentsLine(robot: Robot): HTMLElement {
  const count = robot.kind === 'serial' ? robot.joints.length : robot.segments.length;
  const squares = Array.from({ length: count }, (_, i) => colourKey(segmentColour(i), String(i + 1)));
  return h('div', {}, robot.kind === 'serial' ? 'joint ' : 'segment ', ...squares);
}

function tensionLine(robot: Robot): HTMLElement | null {
  if (robot.kind === 'serial') return null;
  const scale = scaleOf(robot.tension);
  const stops = [scale.low_N, scale.middle_N, scale.high_N].map((tension_N) => css(tensionColour(tension_N, scale)));
  const bar = `linear-gradient(90deg, ${stops.join(',')})`;
  return h('div', {}, h('i', { class: 'wide', style: `background:${bar}` }), `cable tension ${scale.low_N}, ${scale.middle_N}, ${scale.high_N} N`);
}

// What the person can switch in the legend.
export interface LegendSwitches {
  exaggerate(on: boolean): void;
  predict(on: boolean): void;
  tipView: ((on: boolean) => void) | null; // null: there is nothing to see from the tip
}

// Closed in a small picture, where it would hide the arm; its title moves it.
export function legendOf(robot: Robot, scene: Scene, colours: SceneColours, switches: LegendSwitches, moved: () => void): HTMLDetailsElement {
  const title = h('summary', { title: 'drag to move; arrow keys, too' }, 'legend');
  const legend = h('details', { class: 'legend', ontoggle: moved },
    title,
    segmentsLine(robot),
    tensionLine(robot),
    robot.kind === 'serial' ? null : h('div', {}, colourKey(colours.lost, 'lost cable (broken line)')),
    h('div', {}, scene.rod ? colourKey(colours.rod, 'rod') : null, colourKey(colours.near, 'closest point'), colourKey(colours.ghost, 'commanded arm')),
    scene.payload ? h('div', {}, colourKey(colours.payload, 'payload'), colourKey(colours.base, 'adapter')) : null,
    scene.slit ? h('div', {}, colourKey(colours.held, 'discs: held in the plane of the slit (S2)')) : null,
    switches.tipView ? checkbox('view from the tip', switches.tipView, true) : null,
    checkbox('deviation 10 times as large', (on) => switches.exaggerate(on)),
    checkbox('where it would stop, by the last verdict', (on) => switches.predict(on)));
  movable(legend, title, moved);
  return legend;
}

const KEY_STEP_PX = 24;
const DRAG_PX = 4; // less is a click

// Lets `handle` drag the element within its parent; `moved` is called after each step.
function movable(element: HTMLElement, handle: HTMLElement, moved: () => void): void {
  let from: { x: number; y: number; left: number; top: number } | null = null;
  let isDrag = false;
  const place = (left: number, top: number) => {
    const { clientWidth, clientHeight } = element.parentElement!;
    const within = (at: number, room: number) => `${Math.round(Math.max(0, Math.min(room, at)))}px`;
    Object.assign(element.style, { left: within(left, clientWidth - element.offsetWidth), top: within(top, clientHeight - element.offsetHeight), bottom: 'auto' });
    moved();
  };
  handle.addEventListener('pointerdown', (event) => {
    from = { x: event.clientX, y: event.clientY, left: element.offsetLeft, top: element.offsetTop };
    isDrag = false;
    handle.setPointerCapture(event.pointerId);
  });
  handle.addEventListener('pointermove', (event) => {
    if (!from) return;
    isDrag ||= Math.hypot(event.clientX - from.x, event.clientY - from.y) > DRAG_PX;
    if (isDrag) place(from.left + event.clientX - from.x, from.top + event.clientY - from.y);
  });
  for (const end of ['pointerup', 'pointercancel'] as const) handle.addEventListener(end, () => (from = null));
  handle.addEventListener('click', (event) => {
    if (isDrag) event.preventDefault(); // a drag neither opens nor closes it
    isDrag = false;
  });
  handle.addEventListener('keydown', (event) => {
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!way) return;
    event.preventDefault();
    place(element.offsetLeft + KEY_STEP_PX * way[0], element.offsetTop + KEY_STEP_PX * way[1]);
  });
}
