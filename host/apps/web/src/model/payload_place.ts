// Where the payload of a scene is, by what a state tells.
import type { Facts } from '../data/sample';
import type { Robot, Scene } from './robot';

export type Place = 'mechanism' | 'tip' | 'adapter';

// What the arm was told that it carries is on its tip, also where no end effector says so.
export function payloadPlace({ payload, tool }: Facts, scene: Scene): Place {
  if (tool?.command === 'release' && tool.phase === 'done') return 'adapter';
  if (scene.payload?.start === 'arm' || (payload?.mass_kg ?? 0) > 0) return 'tip';
  return tool?.command === 'grapple' && tool.phase === 'done' ? 'tip' : 'mechanism';
}

// Whether the arm that carries this one has brought it to where the adapter is; one that stands firm is there.
export function isAtSite({ tool }: Facts, scene: Scene, robot: Robot): boolean {
  const isCarried = robot.kind === 'serial' && robot.base && scene.payload?.start === 'mechanism' && scene.payload.fetch_pose;
  if (!isCarried || tool?.command === 'release') return true;
  return tool?.command === 'carry' && tool.phase === 'done';
}
