// A simulated arm to practise on, with a fault of its own: what the page shows of a drag, and of a cable that breaks.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openBrowser, openPage, picture, until } from './browser.mjs';
import { startConsole } from './system.mjs';

const BROKEN = 5; // drive, from 1
let system, chromium, page;

before(async () => {
  const faults = join(tmpdir(), `liana-practice-${process.pid}.json`);
  writeFileSync(faults, JSON.stringify([{ drive: BROKEN, kind: 'cable_break', when: { enabled: true, moving: true, for_slots: 250 } }]));
  system = await startConsole('--faults', faults, '--start-pose', 'prepare');
  chromium = await openBrowser();
  page = await openPage(chromium.browser, system.address);
});

after(async () => {
  await chromium?.close();
  await system?.stop();
});

test('a drag shows its target and what is left to it', async () => {
  await until(page, 'a state', (now) => now.facts.state === 'DISABLED');
  await page.click('[data-action="take motion"]');
  await until(page, 'motion is ours', (now) => now.facts.owner === now.name);
  await page.click('[data-action="enable"]');
  await until(page, 'enabled', (now) => now.facts.state === 'ENABLED' && now.facts.at_rest);
  const [x, y] = await page.evaluate(() => {
    const { stage } = window.liana.scene;
    const box = stage.canvas.getBoundingClientRect();
    const at = stage.pixelOf(window.liana.handle.ball.position.toArray());
    return [at[0] + box.left, at[1] + box.top];
  });
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 60, y - 90, { steps: 4 });
  await page.waitForFunction(() => [...document.querySelectorAll('.label')].some((label) => !label.hidden && / to the target/.test(label.textContent)));
  await picture(page, 'practice_drag');
});

test('the cable that breaks is named and marked, while no distance is shown as if it were known', async () => {
  await until(page, 'the fault', (now) => (now.facts.faults ?? []).some((fault) => fault.number === 5006));
  await page.mouse.up();
  await page.waitForFunction((cable) => [...document.querySelectorAll('.label')].some((label) => !label.hidden && label.textContent === `cable ${cable} lost`), BROKEN);
  await page.waitForSelector('.alarm:has-text("5006 cable break")');
  await picture(page, 'practice_cable_break');
  assert.deepEqual(page.errors, []);
});
