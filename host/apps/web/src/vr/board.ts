// A board with words and the tip's picture before the person in the headset.
import * as THREE from 'three';

const WIDTH_PX = 1024;
const HEIGHT_PX = 512;
const LINE_PX = 62;

export class Board {
  readonly mesh: THREE.Mesh;
  readonly tipView: THREE.Mesh;
  readonly target = new THREE.WebGLRenderTarget(320, 208);
  private readonly canvas = document.createElement('canvas');
  private readonly texture: THREE.CanvasTexture;
  private written = '';

  // In the rig, so in metres of the person: at arm's length, a little below the eyes.
  constructor() {
    this.canvas.width = WIDTH_PX;
    this.canvas.height = HEIGHT_PX;
    this.texture = new THREE.CanvasTexture(this.canvas);
    this.mesh = new THREE.Mesh(new THREE.PlaneGeometry(0.9, 0.45), new THREE.MeshBasicMaterial({ map: this.texture }));
    this.mesh.position.set(-0.95, 1.2, -1.1);
    this.mesh.rotation.set(-0.2, 0.7, 0, 'YXZ');
    this.tipView = new THREE.Mesh(new THREE.PlaneGeometry(0.56, 0.364), new THREE.MeshBasicMaterial({ map: this.target.texture }));
    this.tipView.position.set(0.85, 1.2, -1.1);
    this.tipView.rotation.set(-0.2, -0.65, 0, 'YXZ');
    const frame = new THREE.Mesh(new THREE.PlaneGeometry(0.6, 0.404), new THREE.MeshBasicMaterial({ color: '#7c8a99' }));
    frame.position.z = -0.005;
    this.tipView.add(frame);
  }

  // The first line is the largest; writes nothing when nothing changed.
  write(lines: readonly string[], isBad: boolean): void {
    const text = `${isBad} ${lines.join('\n')}`;
    if (text === this.written) return;
    this.written = text;
    const pen = this.canvas.getContext('2d')!;
    pen.fillStyle = isBad ? '#5a1410' : '#10161d';
    pen.fillRect(0, 0, WIDTH_PX, HEIGHT_PX);
    pen.fillStyle = '#ffffff';
    lines.forEach((line, i) => {
      pen.font = `${i === 0 ? 'bold 46' : '40'}px sans-serif`;
      pen.fillText(line, 24, 62 + i * LINE_PX, WIDTH_PX - 48);
    });
    this.texture.needsUpdate = true;
  }

  dispose(): void {
    this.texture.dispose();
    this.target.dispose();
  }
}
