// Jogging the tip: a stream of servo_cp at 60 Hz while keys, buttons or the mouse ask for it, and a hold when they let go.
import { isKnown, values } from '../data/sample';
import type { Connection } from '../live/connection';
import type { Live } from '../live/live';
import type { Answer } from '../live/protocol';
import type { Pose } from '../model/vector';
import { nextGoal, sumOf, towards, type JogSpeed } from './jog';
import type { Direction } from './keyboard';

const PERIOD_MS = 16;
const TIME_TO_LIVE_S = 0.3; // the arm holds when this page stops sending

export class Jogger {
  speed: JogSpeed = { tip_m_s: 0.03, turn_rad_s: 0.1, inTip: false };
  onError: (answer: Answer) => void = () => {};
  sent = 0;
  private readonly asked = new Map<string, Direction>();
  private target_m: [number, number, number] | null = null; // where the mouse drags the tip
  private goal: Pose | null = null;
  private timer = 0;
  private last_ms = 0;

  constructor(private readonly live: Live, private readonly connection: Connection) {}

  get isJogging(): boolean {
    return this.timer !== 0;
  }

  // Where the mouse drags the tip; null: nowhere.
  get target(): ArrayLike<number> | null {
    return this.target_m;
  }

  // Begins (or goes on) with what `who` asks for.
  press(who: string, direction: Direction): void {
    this.asked.set(who, direction);
    this.begin();
  }

  release(who: string): void {
    if (!this.asked.delete(who)) return;
    if (this.asked.size === 0 && !this.target_m) this.end();
  }

  dragTo(place_m: [number, number, number]): void {
    this.target_m = place_m;
    this.begin();
  }

  drop(): void {
    this.target_m = null;
    if (this.asked.size === 0) this.end();
  }

  // Ends everything at once: the window lost the focus, the arm was stopped.
  letGo(): void {
    this.asked.clear();
    this.target_m = null;
    this.end();
  }

  private begin(): void {
    if (this.timer !== 0) return;
    this.goal = null;
    this.last_ms = performance.now();
    this.timer = window.setInterval(() => this.send(), PERIOD_MS);
    this.send();
  }

  private end(): void {
    if (this.timer === 0) return;
    window.clearInterval(this.timer);
    this.timer = 0;
    if (this.live.isMine) this.connection.tell({ op: 'hold' }, this.onError);
  }

  private send(): void {
    const { sample, welcome } = this.live;
    const commanded = values(sample, 'setpoint_cp');
    if (!welcome || !isKnown(commanded)) return;
    const now_ms = performance.now();
    const passed_s = (now_ms - this.last_ms) / 1000;
    this.last_ms = now_ms;
    const { limits } = welcome.robot;
    this.goal = this.target_m
      ? towards(this.goal, commanded, this.target_m, this.speed.tip_m_s, passed_s, limits)
      : nextGoal(this.goal, commanded, sumOf(this.asked.values()), this.speed, passed_s, limits);
    ++this.sent;
    this.connection.tell({ op: 'servo_cp', goal: this.goal, ttl_s: TIME_TO_LIVE_S }, (answer) => {
      this.onError(answer);
      this.goal = null; // begins anew at the commanded tip
    });
  }
}
