// The payload of a scene with its pins: in the transfer mechanism, on the tip, or in the adapter; and the adapter.
import * as THREE from 'three';
import type { Place } from '../model/payload_place';
import type { Scene, ScenePose } from '../model/robot';
import type { SceneColours } from './palette';
import { Batch, paint } from './shade';

export const BODY_RADIUS_M = 0.3; // of scenes that were recorded before a payload had a radius
const PINS = { circle_m: 0.25, radius_m: 0.02, length_m: 0.06 }; // as the bench has them, but thicker: to be seen
const ADAPTER_M = 0.08; // how thick the adapter is drawn
const IN_M = 0.02; // pins of a payload that the adapter has

export function matrixOf(pose: ScenePose): THREE.Matrix4 {
  const [w, x, y, z] = pose.quaternion_wxyz;
  const turn = new THREE.Quaternion(x, y, z, w);
  return new THREE.Matrix4().compose(new THREE.Vector3(...pose.position_m), turn, new THREE.Vector3(1, 1, 1));
}

type Placed = [THREE.BufferGeometry, THREE.Matrix4];

// Along z from `from_m` on.
function upright(radius_m: number, from_m: number, length_m: number, x_m = 0, y_m = 0): Placed {
  const place = new THREE.Matrix4().makeRotationX(Math.PI / 2).setPosition(x_m, y_m, from_m + length_m / 2);
  return [new THREE.CylinderGeometry(radius_m, radius_m, length_m, 24), place];
}

function shapeOf(length_m: number, radius_m: number, colour: string): THREE.BufferGeometry {
  const batch = new Batch();
  batch.add(...upright(radius_m, 0, length_m - PINS.length_m), colour, true);
  for (let pin = 0; pin < 3; ++pin) {
    const angle = (2 * Math.PI * pin) / 3;
    const at = [PINS.circle_m * Math.cos(angle), PINS.circle_m * Math.sin(angle)] as const;
    batch.add(...upright(PINS.radius_m, length_m - PINS.length_m, PINS.length_m, ...at), colour, true);
  }
  return batch.geometry();
}

// A disc behind the face that the payload comes to.
function adapterShape(colour: string): THREE.BufferGeometry {
  const batch = new Batch();
  batch.add(...upright(BODY_RADIUS_M, 0, ADAPTER_M), colour, true);
  return batch.geometry();
}

export class PayloadBody {
  readonly mesh: THREE.Mesh;
  readonly adapter: THREE.Mesh; // seen where the arm is at the site
  readonly centre_m = new Float32Array(3); // for its label
  private readonly atStart: THREE.Matrix4;
  private readonly inAdapter: THREE.Matrix4;
  private readonly length_m: number;

  constructor(payload: NonNullable<Scene['payload']>, adapter: ScenePose, colours: SceneColours) {
    this.length_m = payload.length_m;
    const radius_m = payload.radius_m ?? BODY_RADIUS_M;
    this.mesh = new THREE.Mesh(shapeOf(payload.length_m, radius_m, colours.payload), paint());
    this.mesh.matrixAutoUpdate = false;
    this.adapter = new THREE.Mesh(adapterShape(colours.base), paint());
    this.adapter.matrixAutoUpdate = false;
    this.adapter.matrix.copy(matrixOf(adapter));
    this.atStart = matrixOf(payload);
    this.inAdapter = matrixOf(adapter).multiply(new THREE.Matrix4().makeTranslation(0, 0, IN_M - payload.length_m));
    this.set('mechanism', new Float32Array(16));
  }

  // `tip`: the tip's frame, column by column.
  set(place: Place, tip: Float32Array): void {
    const { matrix } = this.mesh;
    if (place === 'tip') matrix.fromArray(tip);
    else matrix.copy(place === 'adapter' ? this.inAdapter : this.atStart);
    this.mesh.matrixWorldNeedsUpdate = true;
    const e = matrix.elements;
    for (let r = 0; r < 3; ++r) this.centre_m[r] = e[12 + r] + (this.length_m / 2) * e[8 + r];
  }
}
