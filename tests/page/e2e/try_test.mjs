// The page to try Liana, from the disk, on the screens of a desktop and of a phone.
import assert from 'node:assert/strict';
import { statSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { openBrowser, openPage, picture, seriousFindings } from './browser.mjs';
import { root } from './system.mjs';

const MAX_BYTES = 1500000;
const file = join(root, 'build', 'page', 'try.html');
const address = pathToFileURL(file).href;
const SCREENS = { desktop: { viewport: { width: 1280, height: 720 } }, phone: { viewport: { width: 375, height: 667 }, hasTouch: true, isMobile: true } };

let chromium;

before(async () => {
  chromium = await openBrowser();
});
after(() => chromium?.close());

const shown = (page) => page.evaluate(() => {
  const { facts, numbers } = window.liana.sample;
  return { ...facts, tip_m: [...numbers.get('setpoint_cp').subarray(0, 3)] };
});
const reaches = (page, state) => page.waitForFunction((wanted) => window.liana.sample.facts.state === wanted, state, { timeout: 60000 });

// Where the tip's ball is on the screen.
async function tipOnScreen(page) {
  const box = await page.locator('canvas.scene').boundingBox();
  const [x, y] = await page.evaluate(() => window.liana.tipPixel());
  return [box.x + x, box.y + y];
}

// A finger is told to Chromium itself: playwright's own touchscreen only taps.
async function drag(page, isTouch, [x, y], by, during) {
  const finger = isTouch ? await page.context().newCDPSession(page) : null;
  const touch = (type, place) => finger.send('Input.dispatchTouchEvent', { type, touchPoints: place ? [{ x: place[0], y: place[1] }] : [] });
  if (finger) await touch('touchStart', [x, y]);
  else {
    await page.mouse.move(x, y);
    await page.mouse.down();
  }
  for (let i = 1; i <= 10; ++i) {
    const place = [x + (by * i) / 10, y];
    await (finger ? touch('touchMove', place) : page.mouse.move(...place));
  }
  await during();
  await (finger ? touch('touchEnd', null) : page.mouse.up());
}

for (const [screen, options] of Object.entries(SCREENS)) {
  test(`on the screen of a ${screen}: it loads without a request, a drag moves the tip, stop stops it`, async () => {
    const page = await openPage(chromium.browser, address, options);
    await page.waitForSelector('.page.try');
    assert.match(await page.textContent('.next'), /enable/);
    await picture(page, `try_${screen}_begin`);
    await page.click('button:has-text("enable")');
    await reaches(page, 'ENABLED');
    assert.match(await page.textContent('[aria-label="Cable tensions"]'), /\d+ to \d+ N/);
    assert.equal(await page.locator('.tension').count(), 15);

    const before_m = (await shown(page)).tip_m;
    await drag(page, Boolean(options.hasTouch), await tipOnScreen(page), 60, async () => {
      await page.waitForFunction((from) => Math.hypot(...window.liana.sample.numbers.get('setpoint_cp').subarray(0, 3).map((x, r) => x - from[r])) > 0.05, before_m, { timeout: 60000 });
    });
    await page.waitForFunction(() => window.liana.sample.facts.at_rest && window.liana.sample.facts.state === 'ENABLED', null, { timeout: 60000 });
    assert.ok((await shown(page)).commands.released > 0);
    await picture(page, `try_${screen}_dragged`);

    await page.locator('[data-jog="z+"]').dispatchEvent('pointerdown');
    await page.waitForFunction(() => window.liana.sample.facts.at_rest === false, null, { timeout: 60000 });
    await page.click('button.stop');
    await reaches(page, 'DISABLED');
    await page.waitForFunction(() => /enable/.test(document.querySelector('.next').textContent));
    assert.match(await page.textContent('.about'), /What it is not/);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), 'nothing is wider than the screen');
    assert.deepEqual(await seriousFindings(page), []);
    assert.deepEqual(page.requests, [address]);
    assert.deepEqual(page.errors, []);
    await page.close();
  });
}

test('it has at most 1.5 MB', () => {
  assert.ok(statSync(file).size <= MAX_BYTES, `${statSync(file).size} bytes`);
});

test('show me leads the arm into the slit without a refusal, and a key takes it over', async () => {
  const page = await openPage(chromium.browser, address, { colorScheme: 'light' });
  await page.waitForSelector('.page.try');
  await page.selectOption('select', '4');
  await page.click('button:has-text("show me")');
  await page.waitForFunction(() => /Inside the slit/.test(document.querySelector('.next').textContent), null, { timeout: 240000 });
  assert.equal((await shown(page)).commands.refused, 0);
  await picture(page, 'try_inside');
  await page.keyboard.press('Escape');
  await reaches(page, 'DISABLED');
  assert.deepEqual(await seriousFindings(page), []);
  assert.deepEqual(page.errors, []);
  await page.close();
});
