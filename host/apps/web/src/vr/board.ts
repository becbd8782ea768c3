// A board with words and the tip's picture before the person in the headset.
import * as THREE from 'three';

const kWidth_px = 1024;
const kHeight_px = 512;
const kLine_px = 62;

export class Board {
  readonly mesh: THREE.Mesh;
  readonly tip_picture: THREE.Mesh;
  readonly target = new THREE.WebGLRenderTarget(320, 208);
  private readonly canvas = document.createElement('canvas');
  private readonly texture: THREE.CanvasTexture;
  private written = '';

  // In the rig, so in metres of the person: at arm's length, a little below the eyes.
  constructor() {
    this.canvas.width = kWidth_px;
    this.canvas.height = kHeight_px;
    this.texture = new THREE.CanvasTexture(this.canvas);
    this.mesh = new THREE.Mesh(new THREE.PlaneGeometry(0.9, 0.45), new THREE.MeshBasicMaterial({ map: this.texture }));
    this.mesh.position.set(-0.95, 1.2, -1.1);
    this.mesh.rotation.set(-0.2, 0.7, 0, 'YXZ');
    this.tip_picture = new THREE.Mesh(new THREE.PlaneGeometry(0.56, 0.364), new THREE.MeshBasicMaterial({ map: this.target.texture }));
    this.tip_picture.position.set(0.85, 1.2, -1.1);
    this.tip_picture.rotation.set(-0.2, -0.65, 0, 'YXZ');
    const frame = new THREE.Mesh(new THREE.PlaneGeometry(0.6, 0.404), new THREE.MeshBasicMaterial({ color: '#7c8a99' }));
    frame.position.z = -0.005;
    this.tip_picture.add(frame);
  }

  // The first line is the largest; writes nothing when nothing changed.
  write(lines: readonly string[], is_bad: boolean): void {
    const text = `${is_bad} ${lines.join('\n')}`;
    if (text === this.written) return;
    this.written = text;
    const pen = this.canvas.getContext('2d')!;
    pen.fillStyle = is_bad ? '#5a1410' : '#10161d';
    pen.fillRect(0, 0, kWidth_px, kHeight_px);
    pen.fillStyle = '#ffffff';
    lines.forEach((line, i) => {
      pen.font = `${i === 0 ? 'bold 46' : '40'}px sans-serif`;
      pen.fillText(line, 24, 62 + i * kLine_px, kWidth_px - 48);
    });
    this.texture.needsUpdate = true;
  }

  dispose(): void {
    this.texture.dispose();
    this.target.dispose();
  }
}
