// The page of a run, opened from the disk: everything is in it.
import assert from 'node:assert/strict';
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { deflateRawSync, inflateRawSync } from 'node:zlib';
import { openBrowser, openPage, picture, seriousFindings } from './browser.mjs';
import { liana, root, start, startConsole } from './system.mjs';

const MAX_BYTES = 2500000; // most of it are the ticks that it replays

let folder, chromium;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'liana-page-'));
  chromium = await openBrowser();
});

after(async () => {
  await chromium?.close();
  rmSync(folder, { recursive: true, force: true });
});

async function run(name, mission, ...args) {
  const record = join(folder, name);
  await start(liana, ['run', mission, '--seed', '5', '--record', record, ...args]).ended;
  return join(record, 'page.html');
}

const text = (page, selector) => page.textContent(selector);

// What the page says of its ticks once all are replayed.
async function replayed(page) {
  await page.waitForFunction(() => / identical|cannot/.test(document.querySelector('.replay')?.textContent), null, { timeout: 120000 });
  return (await text(page, '.replay')).replaceAll(',', '');
}

// The same page with one byte of the script `id` changed, `at` bytes from its start as it was before it was packed.
function planted(file, id, at) {
  const html = readFileSync(file, 'utf8');
  const [whole, packed] = html.match(new RegExp(`id="${id}">([^<]*)<`));
  const bytes = inflateRawSync(Buffer.from(packed, 'base64'));
  bytes[at(bytes)] ^= 1;
  const other = file.replace('.html', '_planted.html');
  writeFileSync(other, html.replace(whole, () => `id="${id}">${deflateRawSync(bytes).toString('base64')}<`));
  return other;
}

test('the page of a run replays its own ticks, and finds a changed one', async () => {
  const file = await run('short', join(root, 'tests/system/missions/short.lua'));
  const address = pathToFileURL(file).href;
  const page = await openPage(chromium.browser, address);
  const [, same, all] = (await replayed(page)).match(/^(\d+) of (\d+) ticks identical$/);
  const { replay } = JSON.parse(await text(page, '#liana-run'));
  assert.ok(replay.ticks > 1000 && replay.ticks === replay.recorded);
  assert.deepEqual([Number(same), Number(all)], [replay.ticks, replay.ticks]);
  assert.deepEqual(page.requests, [address]);
  assert.deepEqual(page.errors, []);
  await page.close();

  // One bit of a checksum in the middle: that tick alone.
  const middle = Math.floor(replay.ticks / 2);
  const checksum = planted(file, 'liana-ticks', () => replay.start_bytes + 2 * replay.ticks + 4 * middle);
  const other = await openPage(chromium.browser, pathToFileURL(checksum).href);
  const said = await replayed(other);
  assert.match(said, new RegExp(`^${all - 1} of ${all} ticks identical; .* ${middle + 1}$`));
  await other.close();

  // One bit of the number of the first tick: none of them follows the start.
  const input = planted(file, 'liana-ticks', () => replay.start_bytes + 6 * replay.ticks);
  const third = await openPage(chromium.browser, pathToFileURL(input).href);
  assert.match(await replayed(third), new RegExp(`^0 of ${all} `));
  await third.close();
});

test('a crossing leaves one file that shows it from the disk, without any request', async () => {
  const file = await run('crossing', 'slit_crossing');
  assert.ok(statSync(file).size <= MAX_BYTES, `${statSync(file).size} bytes`);
  const page = await openPage(chromium.browser, pathToFileURL(file).href);
  await page.waitForSelector('.page.run');
  await page.waitForFunction(() => /step 4 of 6/.test(document.querySelector('.sentence').textContent));
  assert.match(await text(page, '.finding'), /^Success: \d+\.\d s, at least [\d.]+ mm clear/);
  assert.match(await replayed(page), /^(\d+) of \1 ticks identical$/);
  assert.deepEqual(page.requests.filter((url) => !url.startsWith('file:') && !url.startsWith('data:')), []);
  assert.equal(await page.isVisible('.push'), false); // nothing of pushes where none can be
  assert.doesNotMatch(await text(page, '.plots .filter'), /wrist|servo/);
  await picture(page, 'run_plots');

  // A click on an event takes the scene there.
  await page.click('#tab-Events');
  await page.click('.events li:has-text("step 2:") button');
  assert.match(await text(page, '.sentence'), /^step 2 of 6/);
  await picture(page, 'run_events');

  // Keys: on by 10 s, to the end, play.
  await page.focus('canvas.scene');
  const at = await text(page, '.clock');
  await page.keyboard.press('Shift+ArrowRight');
  assert.notEqual(await text(page, '.clock'), at);
  await page.keyboard.press('Home');
  await page.keyboard.press(' ');
  await page.waitForFunction(() => Number.parseFloat(document.querySelector('.clock').textContent) > 2);
  await page.keyboard.press(' ');
  await page.keyboard.press('2');
  assert.match(await text(page, '.views .chosen'), /along the slit/);

  await page.click('#tab-Commands');
  assert.ok((await page.$$('.commands tbody tr')).length > 50);
  await picture(page, 'run_commands');
  await page.click('#tab-Plots');
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('button:has-text("CSV")')]);
  assert.match(download.suggestedFilename(), /slit_crossing.*\.csv/);
  for (const tab of ['Plots', 'Events', 'Commands', 'Report']) {
    await page.click(`#tab-${tab}`);
    assert.deepEqual(await seriousFindings(page), [], tab);
  }
  assert.deepEqual(page.errors, []);
  await page.close();
});

test('the console serves the page of a run without an origin: it shows the run, and cannot take motion', async () => {
  process.env.XDG_STATE_HOME = folder;
  for (const name of ['own', 'foreign']) mkdirSync(join(folder, 'liana', 'runs', name), { recursive: true });
  copyFileSync(join(folder, 'crossing', 'page.html'), join(folder, 'liana', 'runs', 'own', 'page.html'));
  writeFileSync(join(folder, 'liana', 'runs', 'foreign', 'page.html'), `<!DOCTYPE html><pre></pre><script>
    const tried = {};
    const attempt = async (name, action) => { try { tried[name] = await action(); } catch (error) { tried[name] = error.name ?? 'refused'; } };
    const socket = () => new Promise((done, refused) => {
      const link = new WebSocket('ws://' + location.host + '/ws', 'liana-console-1');
      link.onmessage = () => done('open');
      link.onerror = () => refused(new Error());
    });
    Promise.all([attempt('socket', socket), attempt('runs', () => fetch('/runs').then(() => 'read')), attempt('storage', () => sessionStorage.length),
      attempt('cookie', () => document.cookie), attempt('opener', () => String(window.opener)), attempt('popup', () => String(window.open('/')))])
      .then(() => { document.querySelector('pre').textContent = JSON.stringify(tried); });
  </script>`);
  const system = await startConsole();
  try {
    const page = await openPage(chromium.browser, `${system.address}run/own`);
    await page.waitForSelector('.page.run');
    await page.waitForFunction(() => /step 4 of 6/.test(document.querySelector('.sentence').textContent));
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('button:has-text("CSV")')]);
    assert.match(download.suggestedFilename(), /slit_crossing.*\.csv/);
    assert.deepEqual(page.errors, []);
    await page.close();
    const foreign = await openPage(chromium.browser, `${system.address}run/foreign`);
    await foreign.waitForFunction(() => document.querySelector('pre').textContent !== '');
    const tried = JSON.parse(await text(foreign, 'pre'));
    assert.deepEqual(tried, { socket: 'Error', runs: 'TypeError', storage: 'SecurityError', cookie: 'SecurityError', opener: 'null', popup: 'null' });
    await foreign.close();
  } finally {
    await system.stop();
  }
});

test('the page of a run that failed says what failed, where, why and what to do, and stands at that moment', async () => {
  const faults = join(folder, 'faults.json');
  writeFileSync(faults, JSON.stringify([{ drive: 8, kind: 'cable_break', at_slot: 3500 }]));
  const page = await openPage(chromium.browser, pathToFileURL(await run('broken', 'slit_crossing', '--faults', faults)).href);
  await page.waitForSelector('.finding.bad');
  const finding = await text(page, '.finding');
  assert.match(finding, /slit_crossing failed in "around the obstacle to the panel edge"/);
  assert.match(finding, /at 14\.0 s, in step 2/);
  assert.match(finding, /drive 8 \(node 8, segment 3\): .*\[5006 cable_break\]/);
  assert.equal(finding.split('its clamp on the drum').length, 2); // said once
  assert.match(await text(page, '.clock'), /^14\.0/);
  await picture(page, 'run_failed');
  await page.close();
});

test('the page of a push shows what the wrist feels, how the push went, and where the payload is', async () => {
  const file = await run('push', 'payload_install', '--scene', 'payload_at_adapter');
  const page = await openPage(chromium.browser, pathToFileURL(file).href);
  await page.waitForSelector('.push dl');
  await page.click('#tab-Events');
  assert.match(await text(page, '.events ol'), /push 1: pressing.*push 1: touches.*push 1 ended: captured.*lock closed/s);
  await page.click('.events li[data-kind="push"]:has-text("touches") button');
  await page.click('#tab-Plots');
  const pressing = await text(page, '.push');
  assert.match(pressing, /on the tip.*1 pressing, set \d+\.\d N, gives.*not captured.*N m \(.*good/s);
  for (const name of ['wrist force', 'wrist torque', 'push', 'insertion']) assert.match(await text(page, '.plots .filter'), new RegExp(name));
  await picture(page, 'run_push');
  await page.focus('canvas.scene');
  await page.keyboard.press('End');
  assert.match(await text(page, '.push'), /locked in the adapter/);
  assert.deepEqual(await seriousFindings(page), []);
  assert.deepEqual(page.errors, []);
  await page.close();
});
