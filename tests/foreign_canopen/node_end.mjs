// Devices of npm's canopen at the end of a pipe: frames in and out line by line, one answer for each wake-up. Time is that
// of the wake-ups, timers of the stack included, so that nothing depends on the wall clock.
import readline from 'node:readline';
import canopen from 'canopen';

export const { AccessType, DataType, Device, Eds, NmtState, ObjectType } = canopen;

let now_ms = 0;
const timers = new Set();

class Timer {
  constructor(call, after_ms, repeats) {
    Object.assign(this, { call, after_ms: Math.max(1, after_ms ?? 1), repeats });
    this.refresh();
  }
  refresh() {
    this.due_ms = now_ms + this.after_ms;
    timers.add(this);
    return this;
  }
  unref() {
    return this;
  }
  run() {
    timers.delete(this);
    if (this.repeats) this.refresh();
    this.call();
  }
}
globalThis.setTimeout = (call, after_ms, ...words) => new Timer(() => call(...words), after_ms, false);
globalThis.setInterval = (call, after_ms, ...words) => new Timer(() => call(...words), after_ms, true);
globalThis.clearTimeout = globalThis.clearInterval = (timer) => timers.delete(timer);

const sent = [];

export function connect(device, bus = 0) {
  device.addListener('message', ({ id, data }) => sent.push({ bus, id, data: [...data] }));
  device.bus = bus;
}

export function send(bus, id, ...data) {
  sent.push({ bus, id, data });
}

export function pass(wakes) {
  return new Promise((resolve) => waiting.push([wakes, resolve]));
}
const waiting = []; // [wake-ups left, resolve]

function settled() {
  return new Promise((resolve) => setImmediate(() => setImmediate(resolve)));
}

// Wakes the devices until `story` has ended, and tells what it found. `each` is called at every wake-up, `before` before
// each frame is received; `tell` gives what is told in every answer.
export async function live(devices, story, each, { before = () => {}, tell = () => undefined } = {}) {
  let found;
  story().then(
    (result) => (found = { found: result }),
    (error) => (found = { error: String(error.stack ?? error) }),
  );
  for await (const line of readline.createInterface({ input: process.stdin })) {
    const wake = JSON.parse(line);
    now_ms = wake.now_us / 1000;
    for (const frame of wake.frames) {
      before(frame);
      const message = { id: frame.id, data: Buffer.from(frame.data), len: frame.data.length };
      for (const device of devices) if (device.bus === frame.bus) device.receive(message);
    }
    for (const timer of [...timers]) if (timer.due_ms <= now_ms) timer.run();
    for (const entry of [...waiting]) {
      if (--entry[0] > 0) continue;
      waiting.splice(waiting.indexOf(entry), 1);
      entry[1]();
    }
    each(wake);
    await settled();
    const answer = JSON.stringify({ frames: sent.splice(0), told: tell(), ...found }) + '\n';
    await new Promise((resolve) => process.stdout.write(answer, resolve));
    if (found !== undefined) break;
  }
  process.exit(0); // its timers would keep it alive
}
