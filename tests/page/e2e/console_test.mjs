// The console against the real system: open, watch, take motion, steer by keys and mouse, hold, retract, stop, reconnect.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openBrowser, openPage, picture, seriousFindings, until } from './browser.mjs';
import { processCalled, screens, startConsole } from './system.mjs';

let system, chromium, page, displayName;

before(async () => {
  system = await startConsole();
  chromium = await openBrowser();
  page = await openPage(chromium.browser, system.address);
});

after(async () => {
  await chromium?.close();
  await system?.stop();
});

const text = (selector) => page.textContent(selector);
const press = (name) => page.click(`[data-action="${name}"]`);
const height = (now) => now.setpoint_cp[2];

async function isAtRest(what) {
  return until(page, `${what}: at rest`, (now) => now.facts.at_rest === true && now.facts.state === 'ENABLED');
}

test('the page shows the running arm, says what it does in one sentence, and loads nothing else', async () => {
  await until(page, 'a state', (now) => now.time_s > 0 && now.facts.state === 'DISABLED');
  await page.waitForFunction(() => /brakes on/.test(document.querySelector('.sentence').textContent));
  assert.match(await text('.sentence'), /brakes on.*m to the rod/);
  assert.equal(await text('.status .badge:last-child'), 'live');
  const others = page.requests.filter((url) => !url.startsWith(system.address) && !url.startsWith('data:'));
  assert.deepEqual(others, []);
  await picture(page, 'console_disabled');
});

test('two clicks bring the arm to where the mouse can move it: take motion, enable', async () => {
  await press('take motion');
  ({ name: displayName } = await until(page, 'motion is ours', (now) => now.facts.owner === now.name));
  await press('enable');
  await page.waitForFunction(() => document.querySelector('.answer').textContent === 'enable: taken');
  await until(page, 'enabled', (now) => now.facts.state === 'ENABLED');
  await isAtRest('enabling');
  await page.waitForFunction(() => document.querySelector('.answer').textContent === 'enable: done');
});

test('a held key moves the tip up through verification, and letting go brings it to rest', async () => {
  const from = await isAtRest('before');
  await page.focus('canvas.scene');
  await page.keyboard.down('KeyE');
  await until(page, '15 mm higher', (now) => height(now) > height(from) + 0.015);
  await picture(page, 'console_jog');
  await page.keyboard.up('KeyE');
  const to = await isAtRest('after');
  assert.ok(height(to) < height(from) + 0.3);
});

test('goals go out more than 50 times a second while a key is held, and the time from key to setpoint is measured', async () => {
  await isAtRest('before');
  const from = await page.evaluate(() => {
    const { live, jogger } = window.liana;
    const z = () => live.sample.numbers.get('setpoint_cp')[2];
    const fromZ = z();
    const take = live.takeRecord.bind(live);
    window.moved_ms = null;
    live.takeRecord = (bytes, now_s) => {
      const sequence = take(bytes, now_s);
      if (window.moved_ms === null && Math.abs(z() - fromZ) > 2e-5) window.moved_ms = performance.now();
      return sequence;
    };
    window.addEventListener('keydown', (event) => (window.pressed_ms ??= event.timeStamp), { capture: true });
    return { sent: jogger.sent, time_s: live.sample.time_s };
  });
  await page.focus('canvas.scene');
  await page.keyboard.down('KeyQ');
  await page.waitForTimeout(3000);
  const measured = await page.evaluate(() => ({ sent: window.liana.jogger.sent, time_s: window.liana.live.sample.time_s, latency_ms: window.moved_ms - window.pressed_ms, passed_ms: performance.now() - window.pressed_ms }));
  await page.keyboard.up('KeyQ');
  await isAtRest('after');
  const table = { goals_per_s: (1000 * (measured.sent - from.sent)) / measured.passed_ms, key_to_setpoint_ms: measured.latency_ms, arm_time_per_time: (1000 * (measured.time_s - from.time_s)) / measured.passed_ms };
  writeFileSync(join(screens, 'input.json'), JSON.stringify(table, null, 1));
  console.log(table);
  assert.ok(measured.sent - from.sent > 20 && measured.latency_ms > 0);
});

// req:A15 req:A26
test('the mouse drags the ball at the tip, and dropping it brings the arm to rest', async () => {
  const from = await isAtRest('before');
  await page.waitForFunction(() => window.liana.handle.ball.visible);
  const [x, y] = await page.evaluate(() => {
    const { stage } = window.liana.scene;
    const box = stage.canvas.getBoundingClientRect();
    const at = stage.pixelOf(window.liana.handle.ball.position.toArray());
    return [at[0] + box.left, at[1] + box.top];
  });
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 15, y - 30, { steps: 4 });
  await until(page, '15 mm higher', (now) => height(now) > height(from) + 0.015);
  await page.mouse.up();
  await isAtRest('after');
});

test('a short press of a button is a step of 20 mm along a line', async () => {
  const from = await isAtRest('before');
  await page.click('[data-jog="z+"]');
  await until(page, '20 mm higher', (now) => Math.abs(height(now) - height(from) - 0.02) < 0.0005);
  await isAtRest('after');
});

test('what lianad refuses is shown with its own words', async () => {
  await page.fill('[aria-label="x of the node in metres"]', '99');
  await page.click('section[aria-label="Shape"] button:has-text("go")');
  await page.waitForFunction(() => document.querySelector('.answer').classList.contains('bad'));
  assert.match(await text('.answer'), /^shape: out of range: .*position_m.*allowed/);
});

test('somebody else sees the same arm, and cannot take motion from its owner', async () => {
  const other = await openPage(chromium.browser, system.address);
  await until(other, 'the same owner', (now) => now.facts.owner === displayName);
  await other.click('[data-action="take motion"]');
  await other.waitForFunction(() => document.querySelector('.answer').classList.contains('bad'));
  assert.match(await other.textContent('.answer'), new RegExp(`take motion: not owner: '${displayName}' owns motion`));
  await other.click('[data-jog="z+"]');
  await other.waitForFunction(() => /step z\+: not owner/.test(document.querySelector('.answer').textContent));
  await other.close();
});

test('every browser has a name of its own, and a person gives it another once, also after loading the page again', async () => {
  assert.match(displayName, /^browser-[0-9a-f]{4}$/);
  const other = await openPage(chromium.browser, system.address);
  const first = await until(other, 'a name', (now) => now.name !== undefined);
  assert.notEqual(first.name, displayName);
  await other.fill('[aria-label="your name"]', 'anna');
  await other.click('button:has-text("call me so")');
  await until(other, 'the new name', (now) => now.name === 'anna');
  await other.reload();
  await until(other, 'the name again', (now) => /^anna/.test(now.name));
  await other.close();
  await page.fill('[aria-label="your name"]', 'ben');
  await page.click('button:has-text("call me so")');
  await page.waitForSelector('form:has-text("Give back motion first")');
});

test('retract goes back along the verified path, hold ends it', async () => {
  await press('retract');
  await until(page, 'on the way back', (now) => ['joining', 'back', 'done'].includes(now.facts.retract?.phase));
  await press('hold');
  await isAtRest('hold');
});

test('a goal whose way is refused: one click plans a way around, and a planned way ends when the arm moves', async () => {
  await isAtRest('before');
  await page.selectOption('[aria-label="named pose"]', 'segment5_in_slit'); // straight into the wall
  await page.click('[data-action="go"]');
  await page.click('[data-action="plan a way"]');
  await page.waitForSelector('.offer :text("Way found")', { timeout: 60000 });
  assert.match(await text('.offer p'), /^Way found: [\d.]+ m of the tip, at least \d+ s, at least [\d.]+ mm to /);
  await picture(page, 'console_planned');
  await page.click('[data-jog="z+"]');
  await page.waitForSelector('.offer :text("The arm has moved since")');
  assert.equal(await page.isVisible('[data-action="carry out"]'), false);
  await isAtRest('the step');
});

test('a second click carries the planned way out, verified', async () => {
  await page.click('[data-action="plan a way"]');
  await page.click('[data-action="carry out"]', { timeout: 60000 });
  await page.waitForFunction(() => /^planned way: (?!taken)/.test(document.querySelector('.answer').textContent), null, { timeout: 300000 });
  assert.equal(await text('.answer'), 'planned way: done');
  const [now, goal] = await page.evaluate(() => [[...window.liana.live.sample.numbers.get('setpoint_js_deg')], window.liana.live.welcome.robot.named_poses_deg.segment5_in_slit]);
  assert.ok(now.every((angle_deg, i) => Math.abs(angle_deg - goal[i]) < 0.06), `${now}, ${goal}`);
});

test('a file that is no plan is refused in words', async () => {
  await page.setInputFiles('[aria-label="plan to carry out"]', { name: 'no.json', mimeType: 'application/json', buffer: Buffer.from('{}') });
  await page.waitForSelector('section[aria-label="Angles"] :text("no.json: waypoints_deg")');
  await isAtRest('after');
});

test('recorded runs are listed, each with its page', async () => {
  await page.click('#tab-Runs');
  await page.waitForFunction(() => /No run is recorded yet|shows no recorded|liana-/.test(document.querySelector('#panel-Runs').textContent));
  assert.doesNotMatch(await text('#panel-Runs'), /No list of runs/);
});

// req:A22
test('a click on an event takes the scene to its moment, and "now" back', async () => {
  await page.click('#tab-Events');
  await page.click('.events li:first-child button');
  await page.waitForFunction(() => /NOT NOW/.test(document.querySelector('.clock').textContent));
  await picture(page, 'console_events');
  await page.click('.time-line button');
  await page.waitForFunction(() => !/NOT NOW/.test(document.querySelector('.clock').textContent));
});

test('nothing serious is found by axe in any tab, dark and light', async () => {
  for (const tab of ['Steer', 'Plots', 'Events', 'Runs']) {
    await page.click(`#tab-${tab}`);
    assert.deepEqual(await seriousFindings(page), [], tab);
  }
  await page.click('#tab-Plots');
  await picture(page, 'console_plots');
  await page.click('.top [aria-label^="switch"]');
  await page.click('#tab-Steer');
  assert.deepEqual(await seriousFindings(page), [], 'light');
  await picture(page, 'console_light');
  await page.click('.top [aria-label^="switch"]');
});

test('Escape stops the arm wherever the focus is, and the controller acknowledges it', async () => {
  await page.click('#tab-Steer');
  await page.focus('input.metres');
  await page.keyboard.press('Escape');
  await until(page, 'the stop in the state', (now) => now.facts.stop?.by === displayName && now.facts.state === 'DISABLED');
  await page.waitForFunction(() => /stop answered after \d+ ms, in force since tick \d+/.test(document.querySelector('.stop-report').textContent));
  await page.waitForSelector(`.alarm:has-text("emergency stop by ${displayName}")`);
  await picture(page, 'console_stopped');
});

test('the stop button works in every tab and in a narrow window', async () => {
  await press('take motion'); // clears the stop
  await until(page, 'no stop', (now) => now.facts.stop === null);
  for (const tab of ['Plots', 'Events', 'Runs', 'Steer']) {
    await page.click(`#tab-${tab}`);
    assert.ok(await page.isVisible('button.stop'), tab);
  }
  await page.setViewportSize({ width: 820, height: 1180 });
  assert.ok(await page.isVisible('button.stop'));
  await page.click('button.stop');
  await until(page, 'the stop', (now) => now.facts.stop !== null);
  await picture(page, 'console_tablet');
  await page.setViewportSize({ width: 1280, height: 720 });
});

test('everything is reachable in small windows, beside the stop, and nothing is wider than the window', async () => {
  for (const [width, height] of [[800, 600], [375, 667]]) {
    await page.setViewportSize({ width, height });
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
    const last = page.locator('section[aria-label="Shape"] button').last();
    await last.scrollIntoViewIfNeeded();
    await last.click({ trial: true }); // nothing lies over it
    assert.ok(await page.evaluate(() => {
      const box = document.querySelector('button.stop').getBoundingClientRect();
      return document.elementFromPoint(box.left + 9, box.top + 9)?.closest('button.stop') !== null;
    }), `the stop at ${width}`);
  }
  await page.setViewportSize({ width: 1280, height: 720 });
});

test('no label of the scene is over a control, and the legend is moved by mouse and keys', async () => {
  await page.click('.legend summary');
  await page.waitForTimeout(500);
  const overlaps = () => page.evaluate(() => {
    const seen = (selector) => [...document.querySelectorAll(selector)].filter((e) => !e.hidden).map((e) => e.getBoundingClientRect());
    const controls = seen('.views, .legend, .corner, .error-number, .tip-frame');
    return seen('.label, .axis').filter((a) => controls.some((b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom)).length;
  });
  assert.equal(await overlaps(), 0);
  const from = await page.locator('.legend').boundingBox();
  await page.mouse.move(from.x + 20, from.y + 10);
  await page.mouse.down();
  await page.mouse.move(from.x + 220, from.y - 90, { steps: 4 });
  await page.mouse.up();
  const to = await page.locator('.legend').boundingBox();
  assert.deepEqual([to.x - from.x, to.y - from.y].map(Math.round), [200, -100]);
  await page.focus('.legend summary');
  await page.keyboard.press('ArrowLeft');
  assert.equal(Math.round((await page.locator('.legend').boundingBox()).x - to.x), -24);
  await page.waitForTimeout(500);
  assert.equal(await overlaps(), 0);
});

test('the theme of the system is followed until the person chooses another', async () => {
  const theme = () => page.evaluate(() => document.documentElement.dataset.theme);
  await page.emulateMedia({ colorScheme: 'light' });
  await page.waitForFunction(() => document.documentElement.dataset.theme === 'light');
  await page.emulateMedia({ colorScheme: 'dark' });
  await page.waitForFunction(() => document.documentElement.dataset.theme === 'dark');
  await page.click('.top [aria-label^="switch"]');
  assert.equal(await theme(), 'light');
  await page.emulateMedia({ colorScheme: 'light' });
  await page.emulateMedia({ colorScheme: 'dark' });
  assert.equal(await theme(), 'light', 'chosen');
  await page.click('.top [aria-label^="switch"]');
  assert.equal(await theme(), 'dark');
});

test('an alarm is acknowledged by name and stays as long as its cause', async () => {
  const alarm = `.alarm:has-text("emergency stop by ${displayName}")`;
  await page.waitForSelector('.alarm-count:has-text("1 alarm")');
  await page.click('.alarms button.seen');
  await page.waitForSelector(`${alarm}:has-text("seen by ${displayName}")`);
  assert.equal(await page.isVisible('.alarm-count'), false);
});

test('when the gateway dies the page says so, and goes on by itself when it is back', async () => {
  const gateway = processCalled(system.child.pid, 'liana-gateway');
  assert.ok(gateway, 'the gateway is found');
  process.kill(gateway, 'SIGKILL');
  await page.waitForFunction(() => { // in one look: the gateway comes back soon
    const [state, link] = [':first-child', ':last-child'].map((which) => document.querySelector(`.status .badge${which}`));
    return link.textContent === 'NOT LIVE' && /^was /.test(state.textContent) && state.classList.contains('stale') && !state.classList.contains('good');
  });
  await page.waitForFunction(() => /an arm that was steered from here holds/.test(document.body.textContent));
  await page.waitForFunction(() => document.querySelector('.status .badge:last-child').textContent === 'live', null, { timeout: 60000 });
  const back = await until(page, 'a state again', (now) => now.time_s > 0);
  await until(page, 'a newer state', (now) => now.time_s > back.time_s);
});

test('no error was thrown in the page all the while', () => {
  assert.deepEqual(page.errors, []);
});
