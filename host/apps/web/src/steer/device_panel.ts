// Which device steers, how its motion is mapped, and what is left of the room: clearance and pitch budget.
import { value, values } from '../data/sample';
import type { Live } from '../live/live';
import type { Ask } from '../live/pending_command';
import { pitchBudget } from '../model/pitch_budget';
import { hardwareText } from '../model/hardware';
import { boundText, distanceLines, slowdownText } from '../model/distances';
import { h, setClass, setText } from '../ui/dom';

const CLEARANCE_SHOWN_M = 0.1; // the bar is full at this clearance

class Bar {
  private readonly fill = h('div', { class: 'bar-fill' });
  private readonly text = h('span');
  readonly element: HTMLElement;

  constructor(name: string) {
    this.element = h('div', { class: 'gauge' }, h('span', { class: 'name' }, name), h('div', { class: 'bar' }, this.fill), this.text);
  }

  set(share: number, isBad: boolean, text: string): void {
    const width = `${Math.round(100 * Math.max(0, Math.min(1, share || 0)))}%`; // NaN is empty;
    if (this.fill.style.width !== width) this.fill.style.width = width;
    setClass(this.fill, 'is-bad', isBad);
    setText(this.text, text);
  }
}

export class DevicePanel {
  readonly element: HTMLElement;
  private readonly clearance = new Bar('clearance');
  private readonly budget = new Bar('pitch budget');
  private readonly limit = new Bar('nearest limit');
  private readonly distances = h('dl');
  private readonly slowdown = h('p', { class: 'warning' });
  private readonly mode = h('p');
  private readonly device = h('p');
  private readonly hardware = h('p', { class: 'hardware' });

  constructor(private readonly live: Live, ask: Ask) {
    const device = h('select', { 'aria-label': 'device that steers' }, ...['none', 'vr', 'hand'].map((d) => h('option', { value: d }, d === 'none' ? 'no device' : d === 'vr' ? 'VR controllers' : 'hand controller')));
    const scale = h('input', { type: 'number', value: 1, min: 0.01, max: 100, step: 0.5, class: 'metres', 'aria-label': 'way of the tip for a way of the hand' });
    const node = h('select', { 'aria-label': 'node of the left hand' }, ...[0, 1, 2, 3, 4].map((n) => h('option', { value: n, selected: n === 3 }, n === 0 ? 'no node' : `left: node ${n}`)));
    const use = () => ({ op: 'use_device', device: device.value, scale: Number(scale.value), node: device.value === 'vr' ? Number(node.value) : 0 });
    this.element = h('section', { class: 'card', 'aria-label': 'Room and device' }, h('h2', {}, 'Room and device'),
      this.clearance.element, h('details', { class: 'distances' }, h('summary', {}, 'all distances'), this.distances), this.budget.element, this.limit.element, this.slowdown, this.mode, this.device, this.hardware,
      h('div', { class: 'filter' }, device, h('label', {}, 'scale ', scale), node,
        h('button', { type: 'button', onclick: () => ask('device', use()) }, 'use')));
  }

  update(now_s: number): void {
    const { sample, facts, welcome } = this.live;
    if (!sample || !welcome) return;
    const clear_m = value(sample, 'clearance.distance_m');
    const level = facts.clearance?.level ?? '';
    this.clearance.set(clear_m / CLEARANCE_SHOWN_M, level === 'slow' || level === 'refuse',
      boundText(sample) || 'none is guaranteed');
    this.sayDistances(distanceLines(sample, welcome.scene));
    const budget = pitchBudget(facts.held ?? [], values(sample, 'measured_js_deg'), values(sample, 'setpoint_js_deg'));
    this.budget.set(budget?.share ?? 0, (budget?.share ?? 0) > 0.8,
      budget ? `${budget.used_deg.toFixed(3)} of ${budget.allowed_deg} deg, segment ${budget.segments.join(', ')}` : 'no pitch is held');
    const share = value(sample, 'verdict.share');
    this.limit.set(share, share > 0.95, Number.isFinite(share) ? `${(100 * share).toFixed(0)} % used by the last command` : '');
    setText(this.slowdown, slowdownText(sample));
    const free = values(sample, 'measured_js_deg').length - (facts.held?.length ?? 0);
    const held = (facts.held ?? []).map((theta) => `theta ${theta}`).join(', ');
    setText(this.mode, `Mode ${free}+${facts.held?.length ?? 0}: ${held ? `${held} held (S2, white discs)` : 'all angles follow the tip'}`);
    this.sayDevice(now_s);
    setText(this.hardware, hardwareText(sample, welcome.robot));
  }

  private sayDistances(lines: [string, string][]): void {
    while (this.distances.children.length > 2 * lines.length) this.distances.lastElementChild!.remove();
    while (this.distances.children.length < 2 * lines.length) this.distances.append(h('dt'), h('dd'));
    lines.flat().forEach((text, i) => setText(this.distances.children[i], text));
  }

  private sayDevice(now_s: number): void {
    const { facts } = this.live;
    const rate = this.live.sampleRate.perSecond(now_s);
    const who = !facts.device || facts.device === 'none' ? 'No device is used' : `${facts.device} ${facts.device_engaged ? 'moves the arm: clutch engaged' : 'waits: clutch open'}`;
    const reason = facts.device_reason ? `, let go: ${facts.device_reason}` : '';
    const scale = facts.mapping ? `, scale ${facts.mapping.scale}, turns ${facts.mapping.rotation_scale}` : '';
    setText(this.device, `${who}${reason}${scale}${rate > 0 ? `, ${rate} samples/s` : ''}`);
  }
}
