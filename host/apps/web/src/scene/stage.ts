// Canvas, cameras and their views: the whole scene, and what the camera at the tip sees as a picture in its corner.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { FramePace } from './frame_pace';
import { writeCameraFrame, type Ahead } from './tip_camera';
import type { View } from './views';

const FIELD_DEG = 38;
const NARROW = 1.25; // width to height; on a narrower picture the field is as wide as on this one
const TIP_FIELD_DEG = 70;

THREE.ColorManagement.enabled = false; // colours as they are written: half a megabyte of shader work less a frame

export interface Inset {
  left: number; // from the canvas' left upper corner, pixels
  top: number;
  width: number;
  height: number;
}

export class Stage {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(FIELD_DEG, 1, 0.05, 60);
  readonly renderer: THREE.WebGLRenderer;
  readonly pace = new FramePace();
  controls: OrbitControls;
  inset: Inset | null = null;
  readonly hiddenFromTip = new Set<THREE.Object3D>(); // what would only be in the way of the tip's camera
  tipLooks: Ahead = 'x';
  onMoved: () => void = () => {}; // the person moved the camera
  width = 1;
  height = 1;
  private readonly tipCamera = new THREE.PerspectiveCamera(TIP_FIELD_DEG, 1, 0.03, 8);
  private followed = new THREE.Vector3();

  // Throws when the browser has no WebGL.
  constructor(readonly canvas: HTMLCanvasElement) {
    // Opaque and without stencil: a picture that is not blended with the page costs the processor a fifth less.
    const context = canvas.getContext('webgl2', { alpha: false, antialias: false, stencil: false, powerPreference: 'low-power' });
    if (!context) throw new Error('this browser has no WebGL 2');
    this.renderer = new THREE.WebGLRenderer({ canvas, context });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.autoClear = true;
    this.tipCamera.matrixAutoUpdate = false;
    this.controls = new OrbitControls(this.camera, canvas);
  }

  resize(width: number, height: number): void {
    this.width = Math.max(1, Math.round(width));
    this.height = Math.max(1, Math.round(height));
    this.renderer.setPixelRatio(this.pace.pixelRatio);
    this.renderer.setSize(this.width, this.height, false);
    this.camera.aspect = this.width / this.height;
    const half = Math.tan((FIELD_DEG * Math.PI) / 360) * Math.max(1, NARROW / this.camera.aspect);
    this.camera.fov = (Math.atan(half) * 360) / Math.PI;
    this.camera.updateProjectionMatrix();
  }

  look(view: View, tip_m: ArrayLike<number>): void {
    this.controls.dispose();
    const shift = view.followsTip ? new THREE.Vector3(tip_m[0], tip_m[1], tip_m[2]) : new THREE.Vector3();
    this.followed.copy(shift);
    this.camera.up.set(...view.up);
    this.camera.position.set(...view.eye_m).add(shift);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.target.set(...view.target_m).add(shift);
    this.controls.addEventListener('change', () => this.onMoved());
    this.controls.update();
  }

  // Moves the camera along with the tip.
  follow(tip_m: ArrayLike<number>): void {
    const way = new THREE.Vector3(tip_m[0], tip_m[1], tip_m[2]).sub(this.followed);
    this.followed.add(way);
    this.camera.position.add(way);
    this.controls.target.add(way);
  }

  // `tip`: the tip's frame, column by column.
  render(tip: Float32Array): void {
    const { renderer, inset } = this;
    renderer.setScissorTest(true);
    renderer.setViewport(0, 0, this.width, this.height);
    renderer.setScissor(0, 0, this.width, this.height);
    this.camera.updateMatrixWorld();
    renderer.render(this.scene, this.camera);
    if (!inset) return;
    this.placeTipCamera(tip, inset);
    const bottom = this.height - inset.top - inset.height;
    renderer.setViewport(inset.left, bottom, inset.width, inset.height);
    renderer.setScissor(inset.left, bottom, inset.width, inset.height);
    this.renderFromTip();
  }

  private renderFromTip(): void {
    const hidden = [...this.hiddenFromTip].filter((object) => object.visible);
    for (const object of hidden) object.visible = false;
    this.renderer.render(this.scene, this.tipCamera);
    for (const object of hidden) object.visible = true;
  }

  // The tip's picture onto a surface of its own, also while a headset shows the scene.
  renderTipTo(target: THREE.WebGLRenderTarget, tip: Float32Array): void {
    const { renderer } = this;
    const before = renderer.getRenderTarget();
    const isXr = renderer.xr.enabled;
    this.placeTipCamera(tip, target);
    renderer.xr.enabled = false;
    renderer.setScissorTest(false);
    renderer.setRenderTarget(target);
    this.renderFromTip();
    renderer.setRenderTarget(before);
    renderer.xr.enabled = isXr;
  }

  private placeTipCamera(tip: Float32Array, inset: { width: number; height: number }): void {
    const camera = this.tipCamera;
    writeCameraFrame(tip, this.tipLooks, camera.matrix.elements);
    const aspect = inset.width / inset.height;
    if (camera.aspect !== aspect) {
      camera.aspect = aspect;
      camera.updateProjectionMatrix();
    }
    camera.matrixWorldNeedsUpdate = true;
    camera.updateMatrixWorld(true);
  }

  // Where a place of the base frame is in the picture [pixels]; null: behind the camera.
  pixelOf(place_m: ArrayLike<number>): [number, number] | null {
    const v = new THREE.Vector3(place_m[0], place_m[1], place_m[2]).project(this.camera);
    if (v.z > 1) return null;
    return [(v.x * 0.5 + 0.5) * this.width, (0.5 - v.y * 0.5) * this.height];
  }
}
