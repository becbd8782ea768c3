// Bodies that do not move, as few meshes, shaded once in their vertices: every draw call and every lit pixel costs the
// processor where there is no graphics card.
import * as THREE from 'three';

const SUN = new THREE.Vector3(-0.3, -0.6, 0.75).normalize();
const DARKEST = 0.5;

function lightOf(normal: THREE.Vector3): number {
  return DARKEST + (1 - DARKEST) * (0.5 + 0.5 * normal.dot(SUN));
}

// Gives the geometry a brightness for each vertex, by where its normal points in its own frame.
export function shaded(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const normals = geometry.attributes.normal;
  const colours = new Float32Array(3 * normals.count);
  const normal = new THREE.Vector3();
  for (let i = 0; i < normals.count; ++i) colours.fill(lightOf(normal.fromBufferAttribute(normals, i)), 3 * i, 3 * i + 3);
  geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3));
  return geometry;
}

// For shaded geometry; instances may have colours of their own.
export function paint(): THREE.MeshBasicMaterial {
  return new THREE.MeshBasicMaterial({ vertexColors: true });
}

// Many geometries as one, each with its place and colour.
export class Batch {
  private readonly places: number[] = [];
  private readonly colours: number[] = [];

  // With normals it is shaded; without, it has its colour everywhere.
  add(geometry: THREE.BufferGeometry, matrix: THREE.Matrix4, colour: string, isShaded: boolean): void {
    const flat = geometry.index ? geometry.toNonIndexed() : geometry;
    const { position, normal } = flat.attributes;
    const turn = new THREE.Matrix3().getNormalMatrix(matrix);
    const rgb = new THREE.Color(colour);
    const v = new THREE.Vector3();
    for (let i = 0; i < position.count; ++i) {
      this.places.push(...v.fromBufferAttribute(position, i).applyMatrix4(matrix).toArray());
      const light = isShaded ? lightOf(v.fromBufferAttribute(normal, i).applyMatrix3(turn).normalize()) : 1;
      this.colours.push(rgb.r * light, rgb.g * light, rgb.b * light);
    }
  }

  geometry(): THREE.BufferGeometry {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(this.places, 3));
    geometry.setAttribute('color', new THREE.Float32BufferAttribute(this.colours, 3));
    return geometry;
  }
}
