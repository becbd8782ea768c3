// What is drawn on top of the arm: the way of the tip, closest point, goal, target of a shape.
import * as THREE from 'three';
import type { SceneColours } from './palette';

const TRAIL_POINTS = 3000;
export const GOAL_AXES_M = 0.15;
const TRAIL_STEP_M = 0.003;

// A line through the places where the tip has been.
export class Trail {
  readonly line: THREE.Line;
  private readonly points = new Float32Array(3 * TRAIL_POINTS);
  private count = 0;

  constructor(colour: string, opacity = 1) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(this.points, 3).setUsage(THREE.DynamicDrawUsage));
    geometry.setDrawRange(0, 0);
    this.line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ color: colour, transparent: opacity < 1, opacity }));
    this.line.frustumCulled = false;
  }

  // Goes on to this place when it is far enough from the last one; the oldest half goes when there is no room.
  add(place_m: ArrayLike<number>): void {
    const last = 3 * (this.count - 1);
    const { points } = this;
    if (this.count > 0) {
      const way = Math.hypot(place_m[0] - points[last], place_m[1] - points[last + 1], place_m[2] - points[last + 2]);
      if (way < TRAIL_STEP_M) return;
    }
    if (this.count === TRAIL_POINTS) {
      points.copyWithin(0, 3 * (TRAIL_POINTS / 2));
      this.count = TRAIL_POINTS / 2;
    }
    for (let r = 0; r < 3; ++r) points[3 * this.count + r] = place_m[r];
    ++this.count;
    this.line.geometry.attributes.position.needsUpdate = true;
    this.line.geometry.setDrawRange(0, this.count);
  }

  // The whole way at once: x, y, z of each point, at most as many as there is room for.
  set(places_m: Float32Array): void {
    this.count = Math.min(TRAIL_POINTS, places_m.length / 3);
    this.points.set(places_m.subarray(0, 3 * this.count));
    this.line.geometry.attributes.position.needsUpdate = true;
    this.line.geometry.setDrawRange(0, this.count);
  }

  // Shows the first `count` points only.
  show(count: number): void {
    this.line.geometry.setDrawRange(0, Math.min(count, this.count));
  }
}

// The place on a body that is nearest to the arm, and the line from the arm to it.
export class ClosestPoint {
  readonly group = new THREE.Group();
  private readonly ball: THREE.Mesh;
  private readonly line: THREE.Line;

  constructor(colour: string) {
    this.ball = new THREE.Mesh(new THREE.SphereGeometry(0.02, 10, 8), new THREE.MeshBasicMaterial({ color: colour }));
    this.line = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: colour }));
    this.line.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(6), 3));
    this.line.frustumCulled = false;
    this.group.add(this.ball, this.line);
    this.group.visible = false;
  }

  // From the axis of the piece whose frame and length these are; hidden when `where_m` is not known.
  set(where_m: ArrayLike<number>, frame: Float32Array | null, length_m: number): void {
    this.group.visible = Number.isFinite(where_m[0]);
    if (!this.group.visible) return;
    this.ball.position.set(where_m[0], where_m[1], where_m[2]);
    const ends = this.line.geometry.attributes.position as THREE.BufferAttribute;
    this.line.visible = frame !== null;
    if (!frame) return;
    let along = 0;
    for (let r = 0; r < 3; ++r) along += (where_m[r] - frame[12 + r]) * frame[r];
    along = Math.max(0, Math.min(length_m, along));
    ends.setXYZ(0, where_m[0], where_m[1], where_m[2]);
    ends.setXYZ(1, frame[12] + along * frame[0], frame[13] + along * frame[1], frame[14] + along * frame[2]);
    ends.needsUpdate = true;
  }
}

// Where the tip is asked to be: three short axes, red x (forward), green y, blue z.
export class GoalCross {
  readonly group = new THREE.Group();

  constructor() {
    this.group.add(new THREE.AxesHelper(GOAL_AXES_M));
    this.group.visible = false;
    this.group.matrixAutoUpdate = false;
  }

  set(pose: ArrayLike<number>): void {
    this.group.visible = pose.length === 7 && Number.isFinite(pose[0]);
    if (!this.group.visible) return;
    const turn = new THREE.Quaternion(pose[4], pose[5], pose[6], pose[3]);
    this.group.matrix.compose(new THREE.Vector3(pose[0], pose[1], pose[2]), turn, new THREE.Vector3(1, 1, 1));
    this.group.matrixWorldNeedsUpdate = true;
  }
}

// Balls at the ends of segments (nodes).
export class NodeBalls {
  readonly mesh: THREE.InstancedMesh;

  constructor(count: number, colours: SceneColours) {
    const material = new THREE.MeshBasicMaterial({ color: colours.held, transparent: true, opacity: 0.35, depthWrite: false });
    this.mesh = new THREE.InstancedMesh(new THREE.SphereGeometry(0.036, 10, 6), material, count);
    this.mesh.frustumCulled = false;
  }

  set(nodes_m: ArrayLike<number>): void {
    const matrices = this.mesh.instanceMatrix.array as Float32Array;
    for (let i = 0; i < this.mesh.count; ++i) {
      matrices[16 * i] = matrices[16 * i + 5] = matrices[16 * i + 10] = matrices[16 * i + 15] = 1;
      for (let r = 0; r < 3; ++r) matrices[16 * i + 12 + r] = nodes_m[3 * i + r];
    }
    this.mesh.instanceMatrix.needsUpdate = true;
  }
}
