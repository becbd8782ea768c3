// A session in the headset: the scene around the person, handles as an input device of the arm, words on a board.
import * as THREE from 'three';
import { values } from '../data/sample';
import type { Connection } from '../live/connection';
import type { Live } from '../live/live';
import type { Answer } from '../live/protocol';
import type { Condition } from '../model/alarms';
import { angleCount, reach_m, type CableRobot } from '../model/robot';
import { sentenceOf } from '../model/sentence';
import { lengthText } from '../model/text';
import type { SceneView } from '../scene/scene_view';
import { Board } from './board';
import { nextNode, nextScale, VrButtons } from './buttons';
import { deviceFromHeadset, HandleSamples, type Handle, type Side } from './handles';
import { IntervalLog } from './interval_log';
import { reachRings, Rig } from './rig';

const TIP_PICTURE_EVERY = 4; // pictures
const STICK = 0.8;
const PULSE_MS = 40;

export class Vr {
  readonly log = new IntervalLog();
  sent = 0;
  scale = 1;
  rotationScale = 1;
  node: number; // that the left handle moves; 0: none
  anywhere = false; // inside the slit, too
  private session: XRSession | null = null;
  private readonly rig: Rig;
  private readonly board = new Board();
  private readonly rings: THREE.Group;
  private readonly samples = new HandleSamples();
  private readonly buttons = new VrButtons();
  private readonly grips = new Map<Side, THREE.Object3D>();
  private frames = 0;
  private pictures = 0;
  private wasEngaged = false;
  private wasLevel = '';
  private stickMoved = false;
  private said = '';

  constructor(private readonly robot: CableRobot, private readonly live: Live, private readonly connection: Connection, private readonly view: SceneView, private readonly stop: () => void) {
    this.node = Math.min(3, this.lastNode());
    this.rig = new Rig(reach_m(robot));
    this.rings = reachRings(reach_m(robot), '#6db3f2');
  }

  // The end of the last segment but one.
  private lastNode(): number {
    return angleCount(this.robot) / 2 - 1;
  }

  static async isThere(): Promise<boolean> {
    try {
      return (await navigator.xr?.isSessionSupported('immersive-vr')) ?? false;
    } catch {
      return false;
    }
  }

  get isOn(): boolean {
    return this.session !== null;
  }

  // Begins the session; has to be called from a click. The handles steer once motion is owned and the arm enabled.
  async begin(): Promise<void> {
    const session = await navigator.xr!.requestSession('immersive-vr', { requiredFeatures: ['local-floor'] });
    this.session = session;
    const { renderer, scene, camera } = this.view.stage;
    this.rig.group.add(camera, this.board.mesh, this.board.tipView);
    scene.add(this.rig.group, this.rings);
    for (const side of ['right', 'left'] as const) this.rig.group.add(this.grip(side));
    renderer.xr.enabled = true;
    renderer.xr.setReferenceSpaceType('local-floor');
    await renderer.xr.setSession(session as unknown as Parameters<typeof renderer.xr.setSession>[0]);
    const space = renderer.xr.getReferenceSpace() as XRReferenceSpace | null;
    space?.addEventListener('reset', () => this.samples.reset());
    renderer.setAnimationLoop((now_ms, frame) => this.frame(now_ms, frame as XRFrame | undefined));
    session.addEventListener('end', () => this.ended());
    this.useDevice();
  }

  end(): void {
    void this.session?.end();
  }

  conditions(): Condition[] {
    return this.session ? this.log.conditions(performance.now()) : [];
  }

  private grip(side: Side): THREE.Object3D {
    const colour = side === 'right' ? '#ffe14a' : '#7fd4ff';
    const mesh = new THREE.Mesh(new THREE.ConeGeometry(0.02, 0.12, 8), new THREE.MeshBasicMaterial({ color: colour }));
    mesh.rotation.x = -Math.PI / 2;
    const group = new THREE.Group().add(mesh);
    this.grips.set(side, group);
    return group;
  }

  // Tells lianad how the handles steer.
  useDevice(): void {
    const request = { op: 'use_device', device: 'vr', scale: this.scale, rotation_scale: this.rotationScale, node: this.node, anywhere: this.anywhere };
    void this.connection.request(request).then((answer: Answer) => (this.said = answer.ok ? '' : `handles: ${answer.message ?? answer.code}`));
  }

  private frame(now_ms: number, frame: XRFrame | undefined): void {
    const { renderer, scene, camera } = this.view.stage;
    const space = renderer.xr.getReferenceSpace() as XRReferenceSpace | null;
    if (frame && space && this.session) {
      const handles = this.handles(frame, space, this.session);
      const sample = this.samples.next(now_ms, handles.right, handles.left, deviceFromHeadset(this.rig.turn_rad));
      this.log.sampled(now_ms);
      this.connection.post({ op: 'device', device: 'vr', samples: [sample] });
      ++this.sent;
      this.takeButtons(this.session);
    }
    if (++this.frames % this.log.framesPerPicture(now_ms) !== 0) return; // the last picture stays
    this.view.moveNow();
    if (this.pictures++ % TIP_PICTURE_EVERY === 0) {
      this.write(now_ms);
      this.rig.group.visible = false; // its picture is not a part of itself
      this.view.stage.renderTipTo(this.board.target, this.view.tipFrameNow());
      this.rig.group.visible = true;
    }
    renderer.render(scene, camera);
  }

  private handles(frame: XRFrame, space: XRReferenceSpace, session: XRSession): Record<Side, Handle | null> {
    const found: Record<Side, Handle | null> = { right: null, left: null };
    const isVisible = session.visibilityState === 'visible';
    for (const source of session.inputSources) {
      if (source.handedness === 'none' || !source.gripSpace) continue;
      const pose = frame.getPose(source.gripSpace, space);
      const deadman = Math.max(source.gamepad?.buttons[0]?.value ?? 0, source.gamepad?.buttons[1]?.value ?? 0);
      const p = pose?.transform.position;
      const q = pose?.transform.orientation;
      found[source.handedness] = {
        position_m: p ? [p.x, p.y, p.z] : [0, 0, 0],
        attitude: q ? [q.w, q.x, q.y, q.z] : [1, 0, 0, 0],
        isTracked: !!pose && !pose.emulatedPosition && isVisible,
        deadman,
      };
      const grip = this.grips.get(source.handedness)!;
      grip.visible = !!pose;
      if (p && q) {
        grip.position.set(p.x, p.y, p.z);
        grip.quaternion.set(q.x, q.y, q.z, q.w);
      }
    }
    return found;
  }

  private takeButtons(session: XRSession): void {
    for (const source of session.inputSources) {
      if (source.handedness === 'none') continue;
      for (const action of this.buttons.pressed(source.handedness, source.gamepad ?? null)) this.act(action);
      if (source.handedness === 'right') this.takeStick(source.gamepad ?? null);
    }
    const { device_engaged, clearance } = this.live.facts;
    if (!!device_engaged !== this.wasEngaged) this.pulse(session, device_engaged ? 0.6 : 1);
    const level = clearance?.level ?? '';
    if (level !== this.wasLevel && level !== 'free') this.pulse(session, 1);
    this.wasEngaged = !!device_engaged;
    this.wasLevel = level;
  }

  private act(action: 'hold' | 'stop' | 'mode' | 'scale'): void {
    if (action === 'stop') return this.stop();
    if (action === 'hold') return void this.connection.request({ op: 'hold' });
    if (action === 'mode') this.node = nextNode(this.node, this.lastNode());
    if (action === 'scale') this.scale = nextScale(this.scale);
    this.useDevice();
  }

  // Right thumbstick: sideways turns the person, up and down changes the scale of the world; not while steering.
  private takeStick(gamepad: Gamepad | null): void {
    const [x, y] = [gamepad?.axes[2] ?? 0, gamepad?.axes[3] ?? 0];
    const isMoved = Math.abs(x) > STICK || Math.abs(y) > STICK;
    if (isMoved && !this.stickMoved && !this.live.facts.device_engaged) {
      this.rig.step(Math.abs(x) > STICK ? -Math.sign(x) : 0, Math.abs(y) > STICK ? -Math.sign(y) : 0);
    }
    this.stickMoved = isMoved;
  }

  private pulse(session: XRSession, strength: number): void {
    for (const source of session.inputSources) {
      const actuators = source.gamepad?.hapticActuators as unknown as { pulse?: (value: number, ms: number) => void }[] | undefined;
      actuators?.[0]?.pulse?.(strength, PULSE_MS);
    }
  }

  private write(now_ms: number): void {
    const { live } = this;
    const { sample, facts, welcome } = live;
    if (!sample || !welcome) return this.board.write([live.status || 'waiting for the arm'], true);
    const alarm = live.alarms.list().find((each) => each.isActive);
    const rate_Hz = this.log.rate_Hz(now_ms);
    const clear_m = values(sample, 'clearance.distance_m')[0];
    const steering = this.samples.waits ? 'the headset was re-centred: let go of the triggers' : facts.device_engaged ? 'you steer' : facts.device_reason ? `let go: ${facts.device_reason}` : 'hold a trigger to steer';
    this.board.write([
      sentenceOf(sample, welcome.robot, welcome.scene, null).split(',')[0],
      `clearance ${lengthText(clear_m)} ${facts.clearance ? `from the ${facts.clearance.body}` : ''}`,
      `${steering}, scale ${facts.mapping?.scale ?? this.scale}`,
      `left hand: ${this.node === 0 ? 'nothing' : `node ${this.node}`}, world ${this.rig.worldScale} : 1`,
      `handles ${Number.isFinite(rate_Hz) ? `${rate_Hz}/s` : ''} ${this.said}`,
      ...(alarm ? [alarm.title, alarm.todo.split('. ')[0]] : ['A hold   B STOP   X node   Y scale']),
    ], !!alarm && alarm.priority === 1);
  }

  private ended(): void {
    const { renderer, scene, camera } = this.view.stage;
    renderer.setAnimationLoop(null);
    renderer.xr.enabled = false;
    this.session = null;
    this.rig.group.remove(camera);
    for (const grip of this.grips.values()) this.rig.group.remove(grip);
    scene.remove(this.rig.group, this.rings);
    if (this.live.isMine) void this.connection.request({ op: 'use_device', device: 'none' });
    this.view.afterVr();
  }
}
