// What stands around the arm, in three meshes: glass plates, solid bodies, and lines (edges, the slit's plane, the floor).
import * as THREE from 'three';
import { ConvexGeometry } from 'three/examples/jsm/geometries/ConvexGeometry.js';
import type { Box, Convex, Robot, Scene, Slit, Triple } from '../model/robot';
import { moduleRadius_m } from './arm_body';
import type { SceneColours } from './palette';
import { Batch, paint } from './shade';

const GLASS = 0.13; // share of a plate's colour: what is behind it must be seen
const ROD_SHOWN_M = 0.025; // the rod's ball is 10 mm: too small to find
const FLOOR = { size_m: 8, cells: 16, height_m: -1.2 };
const SLIT_SHOWN_M = 2; // up and down from its middle

const vector = (v: Triple) => new THREE.Vector3(...v);
const at = (place: THREE.Vector3) => new THREE.Matrix4().setPosition(place);

class Surroundings {
  private readonly glass = new Batch();
  private readonly solid = new Batch();
  private readonly lines = new Batch();

  constructor(private readonly colours: SceneColours) {}

  plate(box: Box): void {
    const [hx, hy, hz] = box.half_extent_m;
    const geometry = new THREE.BoxGeometry(2 * hx, 2 * hy, 2 * hz);
    const [u, n, w] = box.rotation.map(vector);
    const place = new THREE.Matrix4().makeBasis(u, n, w).setPosition(vector(box.center_m));
    if (box.name === 'drive_box') this.solid.add(geometry, place, this.colours.base, true);
    else this.glass.add(geometry, place, box.name === 'wall' ? this.colours.wall : this.colours.glass, false);
    this.lines.add(new THREE.EdgesGeometry(geometry), place, this.colours.edge, false);
  }

  ball(centre: Triple, radius_m: number, colour: string): void {
    const isSmall = radius_m < 0.1;
    this.solid.add(new THREE.SphereGeometry(radius_m, isSmall ? 10 : 20, isSmall ? 6 : 14), at(vector(centre)), colour, true);
  }

  convex(body: Convex): void {
    const { obstacle } = this.colours;
    if (body.points_m) this.solid.add(new ConvexGeometry(body.points_m.map(vector)), new THREE.Matrix4(), obstacle, true);
    if (body.cylinder) this.bar(body.cylinder.from_m, body.cylinder.to_m, body.cylinder.radius_m, obstacle);
    body.chain?.points_m.slice(1).forEach((to, i) => this.bar(body.chain!.points_m[i], to, body.chain!.radius_m, obstacle));
  }

  bar(from: Triple, to: Triple, radius_m: number, colour: string): void {
    const way = vector(to).sub(vector(from));
    const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), way.clone().normalize());
    const place = new THREE.Matrix4().compose(vector(from).addScaledVector(way, 0.5), turn, new THREE.Vector3(1, 1, 1));
    this.solid.add(new THREE.CylinderGeometry(radius_m, radius_m, way.length(), 20), place, colour, true);
  }

  // The slit's plane from mouth to end, as a frame between the plates.
  slit(slit: Slit): void {
    const corner = (u: number, w: number) =>
      vector(slit.frame.position_m).addScaledVector(vector(slit.u_axis), u).addScaledVector(vector(slit.w_axis), w);
    const long = slit.end_u_m - slit.mouth_u_m;
    const corners = [corner(0, -SLIT_SHOWN_M), corner(0, SLIT_SHOWN_M), corner(long, SLIT_SHOWN_M), corner(long, -SLIT_SHOWN_M)];
    const points = corners.flatMap((point, i) => [point, corners[(i + 1) % corners.length]]);
    this.lines.add(new THREE.BufferGeometry().setFromPoints(points), new THREE.Matrix4(), this.colours.slit, false);
  }

  floor(): void {
    const half = FLOOR.size_m / 2;
    for (let i = 0; i <= FLOOR.cells; ++i) {
      const k = -half + (i * FLOOR.size_m) / FLOOR.cells;
      const points = [new THREE.Vector3(k, -half), new THREE.Vector3(k, half), new THREE.Vector3(-half, k), new THREE.Vector3(half, k)];
      const colour = k === 0 ? this.colours.gridAxis : this.colours.grid;
      this.lines.add(new THREE.BufferGeometry().setFromPoints(points), at(new THREE.Vector3(0, 0, FLOOR.height_m)), colour, false);
    }
  }

  group(): THREE.Group {
    const glass = new THREE.MeshBasicMaterial({ vertexColors: true, transparent: true, opacity: GLASS, depthWrite: false });
    const lines = new THREE.LineSegments(this.lines.geometry(), new THREE.LineBasicMaterial({ vertexColors: true }));
    return new THREE.Group().add(new THREE.Mesh(this.solid.geometry(), paint()), lines, new THREE.Mesh(this.glass.geometry(), glass));
  }
}

export function surroundings(scene: Scene, robot: Robot, colours: SceneColours): THREE.Group {
  const all = new Surroundings(colours);
  all.floor();
  all.bar([-0.155, 0, 0], [-0.005, 0, 0], 4 * moduleRadius_m(robot), colours.base); // what the root stands on
  for (const box of scene.boxes ?? []) all.plate(box);
  for (const body of scene.spheres ?? []) all.ball(body.center_m, body.radius_m, colours.obstacle);
  for (const body of scene.convex ?? []) all.convex(body);
  if (scene.rod) all.ball(scene.rod.position_m, Math.max(ROD_SHOWN_M, scene.rod.radius_m), colours.rod);
  if (scene.slit) all.slit(scene.slit);
  return all.group();
}
