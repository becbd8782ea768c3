// Two emulated handles steer the real system: over the clutch, past the obstacle, and a loss of tracking holds the arm.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openBrowser, picture, state, until } from './browser.mjs';
import { root, screens, startConsole } from './system.mjs';

const iwer = createRequire(join(root, 'host', 'apps', 'web', 'package.json')).resolve('iwer/build/iwer.min.js');

let system, chromium, page;

before(async () => {
  system = await startConsole();
  chromium = await openBrowser();
  page = await chromium.browser.newPage({ viewport: { width: 400, height: 260 }, colorScheme: 'dark' });
  page.errors = [];
  page.on('pageerror', (error) => page.errors.push(String(error)));
  await page.addInitScript({ path: iwer });
  await page.addInitScript(() => {
    window.headset = new window.IWER.XRDevice(window.IWER.metaQuest3);
    window.headset.installRuntime({ forceInstall: true });
    // The emulator calls every position estimated; a headset does so only while it does not see a handle.
    window.isSeen = true;
    Object.defineProperty(window.XRPose.prototype, 'emulatedPosition', { get: () => !window.isSeen });
    window.headset.position.set(0, 1.6, 0);
    for (const [side, x] of [['right', 0.2], ['left', -0.2]]) window.headset.controllers[side].position.set(x, 1.2, -0.4);
  });
  await page.addInitScript({ path: join(root, 'tests', 'page', 'e2e', 'person.js') });
  await page.goto(system.address);
});

after(async () => {
  await chromium?.close();
  await system?.stop();
});

const press = (name) => page.evaluate((n) => document.querySelector(`[data-action="${n}"]`).click(), name);
const trigger = (side, value) => page.evaluate(([s, v]) => window.headset.controllers[s].updateButtonValue('trigger', v), [side, value]);
const tap = async (side, id) => {
  await page.evaluate(([s, i]) => window.headset.controllers[s].updateButtonValue(i, 1), [side, id]);
  await page.waitForTimeout(300);
  await page.evaluate(([s, i]) => window.headset.controllers[s].updateButtonValue(i, 0), [side, id]);
};

// Moves a handle by `way` (x right, y up, z back) within about a second.
async function moveHand(side, way) {
  for (let i = 0; i < 20; ++i) {
    await page.evaluate(([s, [x, y, z]]) => {
      const p = window.headset.controllers[s].position;
      p.set(p.x + x / 20, p.y + y / 20, p.z + z / 20);
    }, [side, way]);
    await page.waitForTimeout(50);
  }
}

const isResting = (now) => now.facts.at_rest === true && now.facts.state === 'ENABLED';
const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

// Closes the clutch of a handle: a person who sees that the arm does not follow lets go and grips again.
async function grip(side) {
  for (let tries = 0; tries < 8; ++tries) {
    await trigger(side, 1);
    for (let i = 0; i < 15; ++i) {
      await page.waitForTimeout(100);
      if ((await state(page)).facts.device_engaged) return;
    }
    await trigger(side, 0);
    await page.waitForTimeout(500);
  }
  throw new Error(`the arm does not follow the ${side} handle: ${JSON.stringify((await state(page)).facts.device_reason)}`);
}

test('the button VR appears with a headset and begins a session whose handles are the device of the arm', async () => {
  await until(page, 'a state', (now) => now.time_s > 0 && now.facts.state === 'DISABLED');
  await press('take motion');
  await until(page, 'motion is ours', (now) => now.facts.owner === now.name);
  await press('enable');
  await until(page, 'at rest', isResting);
  await page.click('button:has-text("VR")');
  await until(page, 'handles are the device', (now) => now.facts.device === 'vr');
  await page.waitForFunction(() => window.liana.vr.sent > 20);
  await picture(page, 'vr_begin');
});

test('the tip follows the right handle while its trigger is held, and rests when it is let go', async () => {
  const from = await state(page);
  const risen = async () => (await state(page)).setpoint_cp[2] - from.setpoint_cp[2];
  // On a busy machine the clutch may open on the way, as samples come too late: then a person grips again.
  for (let tries = 0; tries < 8 && (await risen()) < 0.04; ++tries) {
    await grip('right');
    await moveHand('right', [0, 0.06, 0]);
    await page.waitForTimeout(1000);
    if (tries === 0) await picture(page, 'vr_steer');
    await trigger('right', 0);
    await until(page, 'at rest', isResting);
    await moveHand('right', [0, -0.06, 0]);
  }
  assert.ok((await risen()) > 0.04, `${await risen()} m`);
  const rested = await state(page);
  await page.waitForTimeout(500);
  assert.ok(distance((await state(page)).setpoint_cp, rested.setpoint_cp) < 1e-4, 'an open trigger moves nothing');
});

// req:A26 req:A31 req:A43
test('the left handle moves a node while the tip stays', async () => {
  const from = await state(page);
  const node = (now) => now.node_m.slice(6, 9); // node 3
  const moved = async () => distance(node(await state(page)), node(from));
  for (let tries = 0; tries < 8 && (await moved()) < 0.02; ++tries) {
    await grip('right');
    await trigger('left', 1);
    await page.waitForTimeout(500);
    await moveHand('left', [0, 0.1, 0]);
    await page.waitForTimeout(1500);
    await trigger('left', 0);
    await trigger('right', 0);
    await until(page, 'at rest', isResting);
    await moveHand('left', [0, -0.1, 0]);
  }
  assert.ok((await moved()) > 0.02, `${await moved()} m`);
  const to = await state(page);
  assert.ok(distance(to.setpoint_cp, from.setpoint_cp) < 0.01, `${distance(to.setpoint_cp, from.setpoint_cp)} m`);
});

// req:A32
test('a handle that is lost holds the arm, and steers again only after it was let go', async () => {
  await grip('right');
  await page.evaluate(() => (window.isSeen = false));
  const lost = await until(page, 'let go', (now) => now.facts.device_engaged === false && isResting(now));
  assert.notEqual(lost.facts.device_reason, '');
  await page.evaluate(() => (window.isSeen = true));
  await page.waitForTimeout(1000);
  assert.equal((await state(page)).facts.device_engaged, false);
  await trigger('right', 0);
  await page.waitForTimeout(500);
  await grip('right');
  await trigger('right', 0);
  await until(page, 'at rest', isResting);
});

// On a busy machine a frame may last longer than the finger: then a person presses again.
async function tapUntil(side, button, isDone) {
  for (let tries = 0; tries < 8 && !(await isDone()); ++tries) {
    await tap(side, button);
    await page.waitForTimeout(1000);
  }
  assert.ok(await isDone(), `${side} ${button}`);
}

test('buttons of the handles: X changes the node, Y the scale, A holds', async () => {
  const scale = (await state(page)).facts.mapping.scale;
  await tapUntil('left', 'y-button', async () => (await state(page)).facts.mapping.scale !== scale);
  const node = await page.evaluate(() => window.liana.vr.node);
  await tapUntil('left', 'x-button', () => page.evaluate((n) => window.liana.vr.node !== n, node));
  await tap('right', 'a-button');
  await until(page, 'at rest', isResting);
});

// The recording that the mission's VR step is made for: device frame, scale 4, turns 2, left hand on node 3.
function recording() {
  const lines = readFileSync(join(root, 'lua', 'recordings', 'panel_edge_vr.hand'), 'utf8').split('\n').slice(1);
  return lines.filter((line) => line && !line.startsWith('#')).map((line) => line.trim().split(/\s+/).map(Number));
}

// req:A31
test('two handles steer the arm past the obstacle to the edge of the panel', async () => {
  await page.evaluate(() => window.liana.connection.request({ op: 'move_jp', goal_deg: window.liana.live.welcome.robot.named_poses_deg.prepare }));
  await page.waitForTimeout(1000);
  await until(page, 'in the prepare pose', (now) => isResting(now) && Math.abs(now.setpoint_cp[0] - 0.6466) < 0.005);
  await page.evaluate(() => window.person.use({ scale: 4, rotationScale: 2, node: 3 }));
  const end = await page.evaluate(async (rows) => {
    const { live } = window.liana;
    const { person } = window;
    const stopAt = performance.now() + 240000;
    const rowsEnd_s = rows[rows.length - 1][0] / 1e6;
    let played_s = 0;
    let nearest_m = Infinity;
    while (played_s < rowsEnd_s && performance.now() < stopAt) {
      const passed_s = await person.nextFrame();
      const row = rows[Math.min(rows.length - 1, Math.floor(played_s * 90))];
      const grip = person.grip(row[2] >= 0.5, passed_s);
      if (grip.goesOn) played_s += passed_s; // the arm's time is the person's
      person.put('right', row.slice(3, 10), grip.isClosed ? row[2] : 0);
      person.put('left', row.slice(12, 19), grip.isClosed ? row[11] : 0);
      nearest_m = Math.min(nearest_m, live.sample.numbers.get('clearance.distance_m')?.[0] ?? Infinity);
    }
    person.letGo();
    return { played_s, nearest_m, refusals: live.sample.numbers.get('refusals')?.[0] };
  }, recording());
  const atEdge = await until(page, 'at rest', isResting);
  await picture(page, 'vr_panel_edge');
  console.log(end, atEdge.measured_cp.slice(0, 3));
  assert.ok(end.nearest_m > 0.02, `${end.nearest_m} m`);
  assert.ok(distance(atEdge.measured_cp, [0.2446, -0.2711, 0.5819]) < 0.15, `${atEdge.measured_cp}`);
});

// req:A40 req:A41
test('with segment 5 held planar the handles steer the tip through the mouth of the slit', async () => {
  const scene = await page.evaluate(() => window.liana.live.welcome.scene);
  const ask = (request) => page.evaluate((r) => window.liana.connection.request(r), request);
  await ask({ op: 'use_device', device: 'none' });
  await ask({ op: 'shape', nodes: [] });
  await until(page, 'at rest', isResting);
  await ask({ op: 'hold_theta', held: [{ theta: 9, target_deg: 0 }] });
  await until(page, 'the pitch of segment 5 is held', (now) => now.facts.held?.includes(9) && now.facts.held_at_target && isResting(now));
  await page.evaluate(() => window.person.use({ scale: 4, rotationScale: 2, node: 0, anywhere: true }));
  const { normal, offset_m, u_axis } = scene.slit;
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const ontoPlane = (p) => p.map((x, i) => x + (offset_m - dot(normal, p)) * normal[i]);
  const attitude = [0.9654, -0.0574, 0.254, -0.0162]; // the tip's y along the plane's normal, as the mission's operator has it
  const beforeMouth = [...ontoPlane([1.3373, -0.7178, 0.591]), ...attitude];
  const inside = [...ontoPlane([1.87, -0.728, 0.55]), ...attitude];
  const end = await page.evaluate(([way, speeds]) => window.person.lead(way, speeds), [[beforeMouth, inside], [0.05, 0.02]]);
  await picture(page, 'vr_in_slit');
  const now = await until(page, 'at rest', isResting);
  const depth_m = dot(u_axis, now.measured_cp) - scene.slit.mouth_u_m;
  console.log(end, { depth_m });
  assert.ok(depth_m > 0.05, `${depth_m} m`);
  assert.ok(end.nearest_m > 0, `${end.nearest_m} m`);
});

test('button B of the right handle is the emergency stop', async () => {
  await tap('right', 'b-button');
  await until(page, 'the stop', (now) => now.facts.stop !== null && now.facts.state === 'DISABLED');
});

test('the session ends, and the log of intervals says how regular it was', async () => {
  const intervals = await page.evaluate(() => window.liana.vr.log.intervals_ms());
  const sorted = [...intervals].sort((a, b) => a - b);
  const rank = (share) => sorted[Math.floor(share * (sorted.length - 1))];
  const table = { samples: sorted.length, median_ms: rank(0.5), p99_ms: rank(0.99), worst_ms: rank(1) };
  writeFileSync(join(screens, 'vr_intervals.json'), JSON.stringify(table, null, 1));
  console.log(table);
  await page.evaluate(() => window.liana.vr.end());
  await page.waitForFunction(() => !window.liana.vr.isOn);
  assert.deepEqual(page.errors, []);
});
