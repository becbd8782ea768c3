// The arm as it is: links, discs in the colours of their segments, cables in the colour of their tension.
import * as THREE from 'three';
import { chainOf, type ArmChain } from '../model/arm_chain';
import { feedCount, numberOfSegment, type CableRobot, type Robot } from '../model/robot';
import { scaleOf, tensionColour, type TensionScale } from '../model/tension_colour';
import { segmentColour } from './palette';
import { paint, shaded } from './shade';

const SIDES = 8;
const DISC_THICKNESS_M = 0.008;
const LINK_RADIUS_M = 0.013; // of the core between the discs, thinner than the module so that cables are seen
const SERIAL_RADIUS_M = 0.08;

// A cylinder along x from 0 to 1, to be scaled and placed.
export function rodGeometry(radius_m: number, sides = SIDES, open = false): THREE.BufferGeometry {
  const geometry = new THREE.CylinderGeometry(radius_m, radius_m, 1, sides, 1, open);
  return geometry.rotateZ(-Math.PI / 2).translate(0.5, 0, 0);
}

export function moduleRadius_m(robot: Robot): number {
  return robot.kind === 'serial' ? SERIAL_RADIUS_M : robot.module.radius_m;
}

// Copies frame `from` of `frames` to matrix `to` of `mesh`, moved along its x by `shift_m`, its x stretched.
function place(mesh: THREE.InstancedMesh, to: number, frames: Float32Array, from: number, shift_m: number, stretch: number): void {
  const out = mesh.instanceMatrix.array as Float32Array;
  const o = 16 * to;
  const i = 16 * from;
  for (let k = 0; k < 3; ++k) {
    out[o + k] = frames[i + k] * stretch;
    out[o + 4 + k] = frames[i + 4 + k];
    out[o + 8 + k] = frames[i + 8 + k];
    out[o + 12 + k] = frames[i + 12 + k] + frames[i + k] * shift_m;
  }
  out[o + 15] = 1;
}

export class ArmBody {
  readonly group = new THREE.Group();
  readonly chain: ArmChain;
  private readonly links: THREE.InstancedMesh;
  readonly details: THREE.Object3D[]; // what the tip's camera need not see of its own arm
  private readonly discs: THREE.InstancedMesh;
  private readonly cables: Cables | null;
  private held = '';

  constructor(robot: Robot, private heldColour: string, lostColour: string) {
    this.chain = chainOf(robot);
    const { pieces } = this.chain;
    const isCable = robot.kind !== 'serial';
    const core = isCable ? LINK_RADIUS_M : 0.7 * SERIAL_RADIUS_M;
    this.links = new THREE.InstancedMesh(shaded(rodGeometry(core, SIDES, true)), paint(), pieces.length);
    this.discs = new THREE.InstancedMesh(shaded(rodGeometry(moduleRadius_m(robot))), paint(), 2 * pieces.length);
    this.cables = isCable ? new Cables(robot, this.chain, lostColour) : null;
    for (const mesh of [this.links, this.discs]) mesh.frustumCulled = false;
    this.group.add(this.links, this.discs);
    if (this.cables) this.group.add(this.cables.lines);
    this.details = [this.discs, ...(this.cables ? [this.cables.lines] : [])];
    this.faces = facesOf(robot, pieces);
    this.paint(new Set());
  }

  private readonly faces: Faces[];

  // Moves the arm; tensions in the order of the API, none for an arm without cables; `lost`: drives (from 0) whose cable
  // is lost.
  set(theta_deg: ArrayLike<number>, tension_N: ArrayLike<number>, lost: readonly number[]): void {
    this.chain.set(theta_deg);
    const { matrices } = this.chain;
    this.faces.forEach(({ first_m, last_m }, k) => {
      place(this.links, k, matrices, k, first_m, last_m - first_m);
      place(this.discs, 2 * k, matrices, k, first_m, DISC_THICKNESS_M);
      place(this.discs, 2 * k + 1, matrices, k, last_m - DISC_THICKNESS_M, DISC_THICKNESS_M);
    });
    this.links.instanceMatrix.needsUpdate = true;
    this.discs.instanceMatrix.needsUpdate = true;
    this.cables?.set(tension_N, lost);
  }

  // Segments (from 0) whose pitch is held: their discs are white (S2 of the paper).
  markHeld(segments: ReadonlySet<number>): void {
    const key = [...segments].join();
    if (key === this.held) return;
    this.held = key;
    this.paint(segments);
  }

  setHeldColour(colour: string): void {
    this.heldColour = colour;
    this.held = '?';
  }

  private paint(held: ReadonlySet<number>): void {
    const colour = new THREE.Color();
    this.chain.pieces.forEach(({ segment }, k) => {
      colour.set(segmentColour(segment));
      this.links.setColorAt(k, colour);
      if (held.has(segment)) colour.set(this.heldColour);
      this.discs.setColorAt(2 * k, colour);
      this.discs.setColorAt(2 * k + 1, colour);
    });
    for (const mesh of [this.links, this.discs]) mesh.instanceColor!.needsUpdate = true;
  }
}

// Where a link's two discs are, from the joint before it: the last one belongs to the joint behind it.
interface Faces {
  first_m: number;
  last_m: number;
}

function facesOf(robot: Robot, pieces: ArmChain['pieces']): Faces[] {
  const offset_m = (k: number) =>
    robot.kind === 'serial' ? 0 : numberOfSegment(robot.cables.face_offset_m, pieces[k].segment);
  const last = pieces.length - 1;
  return pieces.map(({ length_m }, k) => ({
    first_m: offset_m(k),
    last_m: length_m - offset_m(Math.min(k + 1, last)),
  }));
}

// One line set for all cables: cable c of segment m goes from the base through all discs to the end of segment m.
class Cables {
  readonly lines: THREE.LineSegments;
  private readonly runs: { holeY_m: number; holeZ_m: number; pieces: number; at: number }[] = [];
  private readonly places: Float32Array;
  private readonly colours: Float32Array;
  private readonly scale: TensionScale;
  private readonly faces: Faces[];
  private readonly first: number; // of the drives that are cables'
  private readonly lostColour: [number, number, number];

  constructor(robot: CableRobot, private readonly chain: ArmChain, lostColour: string) {
    this.lostColour = new THREE.Color(lostColour).toArray() as [number, number, number];
    this.scale = scaleOf(robot.tension);
    this.first = feedCount(robot);
    this.faces = facesOf(robot, chain.pieces);
    let at = 0;
    let pieces = 0;
    robot.segments.forEach((segment, m) => {
      pieces += segment.modules;
      for (const phase_deg of robot.cables.phase_deg[m]) {
        const phase = (phase_deg * Math.PI) / 180;
        const r = numberOfSegment(robot.cables.hole_radius_m, m);
        this.runs.push({ holeY_m: r * Math.cos(phase), holeZ_m: r * Math.sin(phase), pieces, at });
        at += 2 * (2 * pieces - 1);
      }
    });
    this.places = new Float32Array(3 * at);
    this.colours = new Float32Array(3 * at);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(this.places, 3).setUsage(THREE.DynamicDrawUsage));
    geometry.setAttribute('color', new THREE.BufferAttribute(this.colours, 3).setUsage(THREE.DynamicDrawUsage));
    this.lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ vertexColors: true }));
    this.lines.frustumCulled = false;
  }

  // A lost cable is a broken line in a colour of its own.
  set(tension_N: ArrayLike<number>, lost: readonly number[]): void {
    const { matrices } = this.chain;
    this.runs.forEach((run, cable) => {
      const isLost = lost.includes(this.first + cable);
      const colour = isLost ? this.lostColour : tensionColour(tension_N[this.first + cable] ?? NaN, this.scale);
      const points = 2 * run.pieces;
      let vertex = run.at;
      for (let p = 0; p < points; ++p) {
        const k = p >> 1;
        const x_m = p % 2 === 0 ? this.faces[k].first_m : this.faces[k].last_m;
        for (let twice = p === 0 || p === points - 1 ? 1 : 2; twice > 0; --twice) {
          for (let r = 0; r < 3; ++r) {
            const m = 16 * k + r;
            this.places[3 * vertex + r] =
              matrices[m + 12] + matrices[m] * x_m + matrices[m + 4] * run.holeY_m + matrices[m + 8] * run.holeZ_m;
            this.colours[3 * vertex + r] = colour[r];
          }
          ++vertex;
        }
      }
      if (isLost) this.breakUp(run);
    });
    this.lines.geometry.attributes.position.needsUpdate = true;
    this.lines.geometry.attributes.color.needsUpdate = true;
  }

  // Every second piece of the line shrinks to a point.
  private breakUp(run: { pieces: number; at: number }): void {
    for (let vertex = run.at; vertex < run.at + 2 * (2 * run.pieces - 1); vertex += 4) {
      this.places.copyWithin(3 * vertex + 3, 3 * vertex, 3 * vertex + 3);
    }
  }
}

// The outline of an arm that is not there: commanded or predicted.
export class GhostArm {
  readonly mesh: THREE.InstancedMesh;
  readonly chain: ArmChain;

  constructor(robot: Robot, colour: string, opacity: number) {
    this.chain = chainOf(robot);
    const material = new THREE.MeshBasicMaterial({ color: colour, transparent: true, opacity, depthWrite: false });
    this.mesh = new THREE.InstancedMesh(rodGeometry(moduleRadius_m(robot), SIDES, true), material, this.chain.pieces.length);
    this.mesh.frustumCulled = false;
  }

  set(theta_deg: ArrayLike<number>): void {
    this.chain.set(theta_deg);
    this.chain.pieces.forEach((piece, k) => place(this.mesh, k, this.chain.matrices, k, 0, piece.length_m));
    this.mesh.instanceMatrix.needsUpdate = true;
  }
}
