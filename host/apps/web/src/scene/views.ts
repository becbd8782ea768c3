// Saved views: from where the task is seen.
import type { Robot, Scene, Triple } from '../model/robot';
import { reach_m } from '../model/robot';

export interface View {
  name: string;
  eye_m: Triple;
  target_m: Triple;
  up: Triple;
  followsTip: boolean; // the camera goes where the tip goes
}

const add = (a: Triple, b: Triple, k = 1): Triple => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];

// The views of a scene; the first is the one to begin with.
export function viewsOf(robot: Robot, scene: Scene): View[] {
  const reach = reach_m(robot);
  const goal: Triple = scene.rod?.position_m ?? scene.adapter?.position_m ?? [0.6 * reach, 0, 0];
  const middle: Triple = [0.42 * goal[0], 0.5 * goal[1], 0.5 * goal[2] + 0.02];
  const views: View[] = [
    { name: 'whole task', eye_m: add(middle, [-0.46 * reach, -1.34 * reach, 0.6 * reach]), target_m: middle, up: [0, 0, 1], followsTip: false },
  ];
  const { slit } = scene;
  if (slit) {
    const target = add(slit.frame.position_m, slit.u_axis, 0.1);
    views.push({ name: 'along the slit', eye_m: add(target, slit.w_axis, 1.5 * reach), target_m: target, up: slit.normal, followsTip: false });
  }
  views.push({ name: 'tip', eye_m: [-0.8, -0.75, 0.5], target_m: [0.1, 0, 0], up: [0, 0, 1], followsTip: true });
  views.push({ name: 'base', eye_m: [-1.6, -0.9, 0.9], target_m: [0.8, -0.2, 0.2], up: [0, 0, 1], followsTip: false });
  return views;
}
