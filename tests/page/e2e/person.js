// A person with two emulated handles, in the page: knows where the handles are in the arm's base frame, sees whether the
// arm follows, and grips again when it does not.
window.person = (() => {
  const multiply = (a, b) => [
    a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
    a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
    a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
    a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
  ];
  const back = (q) => [q[0], -q[1], -q[2], -q[3]];
  const turned = (q, v) => multiply(multiply(q, [0, ...v]), back(q)).slice(1);
  const power = (q, share) => {
    const sign = q[0] < 0 ? -1 : 1;
    const s = Math.hypot(q[1], q[2], q[3]);
    if (s < 1e-9) return [1, 0, 0, 0];
    const half = Math.atan2(s, sign * q[0]) * share;
    return [Math.cos(half), ...[1, 2, 3].map((i) => (sign * Math.sin(half) * q[i]) / s)];
  };
  const offset = {}; // of the grip from the pose that the emulator is told
  let mapping = { scale: 1, rotationScale: 1 };
  let last_s = NaN;
  let openUntil_s = -1;
  let notFollowed_s = 0;
  let samples = 0;

  const live = () => window.liana.live;
  const now_s = () => live().sample.time_s;
  const commanded = () => [...live().sample.numbers.get('setpoint_cp')];
  const headsetToBase = () => {
    const half = window.liana.vr.rig.turn_rad / 2;
    return multiply([Math.cos(half), 0, 0, Math.sin(half)], [0.5, 0.5, -0.5, -0.5]);
  };

  async function findGrips() {
    for (const side of ['right', 'left']) {
      window.headset.controllers[side].position.set(0, 0, 0);
      window.headset.controllers[side].quaternion.set(0, 0, 0, 1);
    }
    const sent = window.liana.vr.sent;
    while (window.liana.vr.sent < sent + 3) await new Promise((next) => setTimeout(next, 20));
    const device = headsetToBase();
    for (const side of ['right', 'left']) {
      const pose = window.liana.vr.samples.last[side];
      offset[side] = { place: turned(back(device), pose.slice(0, 3)), turn: multiply(back(device), pose.slice(3)) };
    }
  }

  // Tells the arm how the handles steer.
  async function use(wanted) {
    mapping = wanted;
    await findGrips();
    Object.assign(window.liana.vr, wanted);
    window.liana.vr.useDevice();
    last_s = now_s();
    openUntil_s = -1;
  }

  // No hand stands still to the last digit: one that does is taken for a tracker whose values are stuck.
  const tremor_m = () => 2e-5 * Math.sin(2.4 * samples++);

  // Puts a handle where it has this pose in the base frame, its trigger held by so much.
  function put(side, pose, held) {
    const device = headsetToBase();
    const q = multiply(multiply(back(device), pose.slice(3)), back(offset[side].turn));
    const place = turned(back(device), pose.slice(0, 3));
    const shift = turned(q, offset[side].place);
    const hand = window.headset.controllers[side];
    hand.position.set(...place.map((x, i) => x - shift[i] + tremor_m()));
    hand.quaternion.set(q[1], q[2], q[3], q[0]);
    hand.updateButtonValue('trigger', held);
  }

  function letGo() {
    for (const side of ['right', 'left']) window.headset.controllers[side].updateButtonValue('trigger', 0);
  }

  // The next frame; what of the arm's time has passed [s].
  async function nextFrame() {
    await new Promise((next) => requestAnimationFrame(next));
    const passed_s = Math.min(0.1, now_s() - last_s);
    last_s = now_s();
    return passed_s;
  }

  // Holds the trigger where it is wanted; opens it for half a second when the arm has not followed for 0.8 s.
  function grip(isWanted, passed_s) {
    const follows = live().facts.device_engaged;
    const isClosed = isWanted && now_s() >= openUntil_s;
    notFollowed_s = isClosed && !follows ? notFollowed_s + passed_s : 0;
    if (notFollowed_s > 0.8) openUntil_s = now_s() + 0.5;
    return { isClosed, follows, goesOn: now_s() >= openUntil_s && (!isWanted || follows) };
  }

  // Leads the tip through these poses with the right hand, each at its speed; waits for an arm that falls behind.
  async function lead(way, speeds) {
    let from = commanded();
    let nearest_m = Infinity;
    const stopAt = performance.now() + 240000;
    for (const [leg, to] of way.entries()) {
      const long_m = Math.hypot(...[0, 1, 2].map((i) => to[i] - from[i]));
      const turn = multiply(to.slice(3), back(from.slice(3)));
      const poseAt = (share) => [...[0, 1, 2].map((i) => from[i] + share * (to[i] - from[i])), ...multiply(power(turn, share), from.slice(3))];
      let share = 0;
      let anchor = null; // where hand and tip were when the clutch closed, and the share then
      while (performance.now() < stopAt) {
        const passed_s = await nextFrame();
        const { isClosed, follows } = grip(true, passed_s);
        nearest_m = Math.min(nearest_m, live().sample.numbers.get('clearance.distance_m')?.[0] ?? Infinity);
        const tip = commanded();
        if (!follows) anchor = null;
        else if (!anchor) {
          anchor = { hand: [0, 0, 1.2, 1, 0, 0, 0], tip };
          let best = Infinity;
          for (let s = 0; s <= 1; s += 0.002) {
            const m = Math.hypot(...[0, 1, 2].map((i) => poseAt(s)[i] - tip[i]));
            if (m < best) [best, share] = [m, s];
          }
        }
        let hand = [0, 0, 1.2, 1, 0, 0, 0];
        if (anchor) {
          const goal = poseAt(share);
          const behind_m = Math.hypot(...[0, 1, 2].map((i) => goal[i] - tip[i]));
          if (behind_m < 0.05) share = Math.min(1, share + (speeds[leg] * passed_s) / long_m);
          const handTurn = power(multiply(goal.slice(3), back(anchor.tip.slice(3))), 1 / mapping.rotationScale);
          hand = [...[0, 1, 2].map((i) => anchor.hand[i] + (goal[i] - anchor.tip[i]) / mapping.scale), ...handTurn];
          if (share >= 1 && behind_m < 0.004) break;
        }
        put('right', hand, isClosed ? 1 : 0);
      }
      from = to;
    }
    letGo();
    return { nearest_m, tip: commanded() };
  }

  return { use, put, letGo, nextFrame, grip, lead };
})();
