// Where the person stands in the arm's world: beside the base, looking along the arm, at a comfortable scale.
import * as THREE from 'three';
import { deviceFromHeadset } from './handles';

const PLACE_M = new THREE.Vector3(-1.2, -0.75, -1.1); // the floor under the person, in the base frame, at scale 1
const WORLD_SCALES = [0.25, 0.5, 1];
const TURN_RAD = Math.PI / 6;

export class Rig {
  readonly group = new THREE.Group();
  turn_rad = 0.1; // obstacle to the left, arm and slit ahead
  private scale = 1; // index of WORLD_SCALES

  constructor(private readonly reach_m: number) {
    this.group.matrixAutoUpdate = false;
    this.place();
  }

  get worldScale(): number {
    return WORLD_SCALES[this.scale];
  }

  // Turns the person by steps, and makes the world smaller or larger: thumbsticks.
  step(turns: number, scales: number): void {
    this.turn_rad += turns * TURN_RAD;
    this.scale = Math.max(0, Math.min(WORLD_SCALES.length - 1, this.scale + scales));
    this.place();
  }

  private place(): void {
    const [w, x, y, z] = deviceFromHeadset(this.turn_rad);
    const grown = 1 / this.worldScale; // a person twice as large sees the arm half as large
    const place = PLACE_M.clone().multiplyScalar(Math.max(1, this.reach_m / 4) * (0.5 + 0.5 * grown));
    place.z = PLACE_M.z * grown + 0.25;
    this.group.matrix.compose(place, new THREE.Quaternion(x, y, z, w), new THREE.Vector3(grown, grown, grown));
    this.group.matrixWorldNeedsUpdate = true;
  }
}

// How far the arm reaches: rings about its base.
export function reachRings(reach_m: number, colour: string): THREE.Group {
  const group = new THREE.Group();
  const points = Array.from({ length: 64 }, (_, i) => {
    const angle = (i / 64) * 2 * Math.PI;
    return new THREE.Vector3(reach_m * Math.cos(angle), reach_m * Math.sin(angle), 0);
  });
  const geometry = new THREE.BufferGeometry().setFromPoints(points);
  const material = new THREE.LineBasicMaterial({ color: colour, transparent: true, opacity: 0.5 });
  for (const turn of [new THREE.Euler(), new THREE.Euler(Math.PI / 2), new THREE.Euler(0, Math.PI / 2)]) {
    const ring = new THREE.LineLoop(geometry, material);
    ring.rotation.copy(turn);
    group.add(ring);
  }
  return group;
}
