// The tip's handle in the scene: a ball that the mouse takes and drags, in the plane of the picture.
import * as THREE from 'three';
import type { Stage } from '../scene/stage';

const NEAR_PX = 28;

export class TipHandle {
  readonly ball: THREE.Mesh;
  onDrag: (place_m: [number, number, number]) => void = () => {};
  onDrop: () => void = () => {};
  isEnabled = false;
  private pointer: number | null = null;
  private readonly plane = new THREE.Plane();
  private readonly ray = new THREE.Raycaster();
  private readonly offset = new THREE.Vector3();

  constructor(private readonly stage: Stage, colour: string) {
    const material = new THREE.MeshBasicMaterial({ color: colour, transparent: true, opacity: 0.5, depthTest: false });
    this.ball = new THREE.Mesh(new THREE.SphereGeometry(0.055, 14, 10), material);
    this.ball.renderOrder = 5;
    this.ball.visible = false;
    const { canvas } = stage;
    canvas.addEventListener('pointerdown', (event) => this.take(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => this.drag(event), { capture: true });
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) canvas.addEventListener(end, () => this.drop(), { capture: true });
  }

  // Where the tip is commanded to be.
  place(tip_m: ArrayLike<number>): void {
    this.ball.visible = this.isEnabled && Number.isFinite(tip_m[0]);
    this.ball.position.set(tip_m[0], tip_m[1], tip_m[2]);
  }

  private pixel(event: PointerEvent): [number, number] {
    const box = this.stage.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  private take(event: PointerEvent): void {
    if (!this.ball.visible || event.button !== 0) return;
    const at = this.stage.pixelOf(this.ball.position.toArray());
    const [x, y] = this.pixel(event);
    if (!at || Math.hypot(at[0] - x, at[1] - y) > NEAR_PX) return;
    event.stopImmediatePropagation(); // the view does not turn with it
    this.pointer = event.pointerId;
    this.stage.canvas.setPointerCapture(event.pointerId);
    this.plane.setFromNormalAndCoplanarPoint(this.stage.camera.getWorldDirection(new THREE.Vector3()), this.ball.position);
    const place = this.placeUnder(event);
    this.offset.copy(this.ball.position).sub(place ?? this.ball.position);
  }

  private drag(event: PointerEvent): void {
    if (event.pointerId !== this.pointer) return;
    event.stopImmediatePropagation();
    const place = this.placeUnder(event)?.add(this.offset);
    if (place) this.onDrag([place.x, place.y, place.z]);
  }

  private drop(): void {
    if (this.pointer === null) return;
    this.pointer = null;
    this.onDrop();
  }

  private placeUnder(event: PointerEvent): THREE.Vector3 | null {
    const [x, y] = this.pixel(event);
    const screen = new THREE.Vector2((2 * x) / this.stage.width - 1, 1 - (2 * y) / this.stage.height);
    this.ray.setFromCamera(screen, this.stage.camera);
    return this.ray.ray.intersectPlane(this.plane, new THREE.Vector3());
  }
}
