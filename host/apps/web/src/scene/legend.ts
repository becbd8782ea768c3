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

// `exaggerate` and `predict` are told what the person chose.
export function legendOf(
  robot: Robot,
  scene: Scene,
  colours: SceneColours,
  exaggerate: (on: boolean) => void,
  predict: (on: boolean) => void,
): HTMLElement {
  return h('details', { class: 'legend', open: true },
    h('summary', {}, 'legend'),
    segmentsLine(robot),
    tensionLine(robot),
    h('div', {}, scene.rod ? colourKey(colours.rod, 'rod') : null, colourKey(colours.near, 'closest point'), colourKey(colours.ghost, 'commanded arm')),
    scene.payload ? h('div', {}, colourKey(colours.payload, 'payload'), colourKey(colours.base, 'adapter')) : null,
    scene.slit ? h('div', {}, colourKey(colours.held, 'discs: held in the plane of the slit (S2)')) : null,
    checkbox('error 10 times as large', exaggerate),
    checkbox('where it would stop, by the last verdict', predict));
}
