// A simulated arm to practise on: what the page shows of a drag, faults by a click, and the way out of each.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { openBrowser, openPage, picture, until } from './browser.mjs';
import { liana, start, startConsole } from './system.mjs';

const LOST = 4; // drive, from 1
const BROKEN = 5;
let system, chromium, page;

before(async () => {
  system = await startConsole('--start-pose', 'prepare');
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
  await page.mouse.up();
  await isAtRest();
});

test('a drive that is lost by a click is named; repaired and cleared, the arm is enabled again', async () => {
  await letItHappen('silent', LOST);
  await until(page, 'the fault', (now) => (now.facts.faults ?? []).some((fault) => fault.number === 3002 && fault.index === LOST - 1));
  await page.waitForSelector(`.practice :text("a drive is lost: drive ${LOST} (node ${LOST}, segment 2), until it is repaired")`);
  await page.click('[data-action="repair"]');
  await page.waitForFunction(() => document.querySelectorAll('.practice li').length === 0);
  await until(page, 'the drive again', (now) => now.facts.state === 'FAULT' && now.facts.at_rest);
  await page.click('[data-action="clear"]');
  await until(page, 'no fault', (now) => (now.facts.faults ?? []).length === 0);
  await page.click('[data-action="enable"]');
  await isAtRest();
});

test('a cable that breaks by a click is named and marked, while no distance is shown as if it were known', async () => {
  await letItHappen('cable_break', BROKEN);
  await until(page, 'the fault', (now) => (now.facts.faults ?? []).some((fault) => fault.number === 5006));
  await page.waitForFunction((cable) => [...document.querySelectorAll('.label')].some((label) => !label.hidden && label.textContent === `cable ${cable} lost`), BROKEN);
  await page.waitForSelector('.alarm:has-text("5006 cable break")');
  await page.waitForSelector(`.practice :text("a cable breaks: drive ${BROKEN}")`);
  await picture(page, 'practice_cable_break');
});

test('liana recover leads the practice arm out, and what is refused is said', async () => {
  await page.click('[data-action="give back motion"]');
  await until(page, 'motion is free', (now) => now.facts.owner === '');
  const recovery = start(liana, ['recover', '--api', system.api]);
  assert.equal(await recovery.ended, 0, recovery.lines.join('\n'));
  await until(page, 'disabled', (now) => now.facts.state === 'DISABLED');
  const refused = await page.evaluate(() => window.liana.connection.request({ op: 'practice', faults: [{ kind: 'cable_break', drive: 99 }] }));
  assert.equal(refused.code, 'refused');
  assert.deepEqual(page.errors, []);
});

function isAtRest() {
  return until(page, 'enabled and at rest', (now) => now.facts.state === 'ENABLED' && now.facts.at_rest && !now.facts.is_busy);
}

async function letItHappen(kind, drive) {
  await page.selectOption('[aria-label="fault"]', kind);
  await page.selectOption('[aria-label="drive of the fault"]', String(drive));
  await page.click('[data-action="let it happen"]');
}
