// What stands around the arm: glass plates with full edges, bodies, the rod, the slit's plane, the drive box.
import * as THREE from 'three';
import { ConvexGeometry } from 'three/examples/jsm/geometries/ConvexGeometry.js';
import type { Box, Convex, Robot, Scene, Slit, Triple } from '../model/robot';
import { module_radius_m } from './arm_body';
import type { SceneColours } from './palette';

const kGlass = 0.13; // share of a plate's colour: what is behind it must be seen
const kRodShown_m = 0.025; // the rod's ball is 10 mm: too small to find
const kGridSize_m = 8;

const vector = (v: Triple) => new THREE.Vector3(...v);

function solid(colour: string): THREE.MeshLambertMaterial {
  return new THREE.MeshLambertMaterial({ color: colour });
}

function glass(colour: string): THREE.MeshBasicMaterial {
  return new THREE.MeshBasicMaterial({ color: colour, transparent: true, opacity: kGlass, depthWrite: false });
}

function plate(box: Box, colour: string, edge: string): THREE.Group {
  const [hx, hy, hz] = box.half_extent_m;
  const geometry = new THREE.BoxGeometry(2 * hx, 2 * hy, 2 * hz);
  const group = new THREE.Group();
  group.add(new THREE.Mesh(geometry, glass(colour)));
  group.add(new THREE.LineSegments(new THREE.EdgesGeometry(geometry), new THREE.LineBasicMaterial({ color: edge })));
  const [u, n, w] = box.rotation.map(vector);
  group.matrix.makeBasis(u, n, w).setPosition(vector(box.center_m));
  group.matrixAutoUpdate = false;
  return group;
}

function bar(from: Triple, to: Triple, radius_m: number, material: THREE.Material): THREE.Mesh {
  const way = vector(to).sub(vector(from));
  const mesh = new THREE.Mesh(new THREE.CylinderGeometry(radius_m, radius_m, way.length(), 12), material);
  mesh.position.copy(vector(from)).addScaledVector(way, 0.5);
  mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), way.normalize());
  return mesh;
}

function convex(body: Convex, colour: string): THREE.Object3D {
  const group = new THREE.Group();
  if (body.points_m) group.add(new THREE.Mesh(new ConvexGeometry(body.points_m.map(vector)), solid(colour)));
  if (body.cylinder) group.add(bar(body.cylinder.from_m, body.cylinder.to_m, body.cylinder.radius_m, solid(colour)));
  body.chain?.points_m.slice(1).forEach((to, i) => {
    group.add(bar(body.chain!.points_m[i], to, body.chain!.radius_m, solid(colour)));
  });
  return group;
}

function ball(centre: Triple, radius_m: number, colour: string): THREE.Mesh {
  const mesh = new THREE.Mesh(new THREE.SphereGeometry(radius_m, 20, 14), solid(colour));
  mesh.position.copy(vector(centre));
  return mesh;
}

// The slit's plane from mouth to end, as a thin frame between the plates.
function slit_frame(slit: Slit, colour: string): THREE.LineLoop {
  const corner = (u: number, w: number) =>
    vector(slit.frame.position_m).addScaledVector(vector(slit.u_axis), u).addScaledVector(vector(slit.w_axis), w);
  const long = slit.end_u_m - slit.mouth_u_m;
  const points = [corner(0, -2), corner(0, 2), corner(long, 2), corner(long, -2)];
  return new THREE.LineLoop(new THREE.BufferGeometry().setFromPoints(points), new THREE.LineBasicMaterial({ color: colour }));
}

function drive_box(robot: Robot, colour: string): THREE.Mesh {
  const radius_m = 4 * module_radius_m(robot);
  const mesh = new THREE.Mesh(new THREE.CylinderGeometry(radius_m, radius_m, 0.15, 20), solid(colour));
  mesh.rotation.z = Math.PI / 2;
  mesh.position.x = -0.08;
  return mesh;
}

export function surroundings(scene: Scene, robot: Robot, colours: SceneColours): THREE.Group {
  const group = new THREE.Group();
  const grid = new THREE.GridHelper(kGridSize_m, 16, colours.grid_axis, colours.grid);
  grid.rotation.x = Math.PI / 2;
  grid.position.z = -1.2;
  group.add(grid, drive_box(robot, colours.base));
  for (const box of scene.boxes ?? []) group.add(plate(box, box.name === 'wall' ? colours.wall : colours.glass, colours.edge));
  for (const body of scene.spheres ?? []) group.add(ball(body.center_m, body.radius_m, colours.obstacle));
  for (const body of scene.convex ?? []) group.add(convex(body, colours.obstacle));
  if (scene.rod) group.add(ball(scene.rod.position_m, Math.max(kRodShown_m, scene.rod.radius_m), colours.rod));
  if (scene.slit) group.add(slit_frame(scene.slit, colours.slit));
  return group;
}
