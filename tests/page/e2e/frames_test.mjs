// What a picture costs while a paced mission runs and everything is shown: CPU time of all browser processes, intervals,
// age of what is seen. CPU time is judged; intervals and age only where the rest of the machine left room.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { open_browser, open_page, picture } from './browser.mjs';
import { cpu_ms, liana, machine_ms, screens, start } from './system.mjs';

const kMeasured_s = 30;
const kMostCpu_ms = 33; // a presented frame
const kMostCpuBeside_ms = 50; // beside work that takes caches and memory, and lets fewer frames share what every second costs
const kQuietCores = 0.3; // of others, below which intervals are judged

const sorted = (values) => [...values].sort((a, b) => a - b);
const rank = (values, share) => sorted(values)[Math.min(values.length - 1, Math.ceil(share * values.length) - 1)] ?? NaN;

test('a presented frame costs at most 33 ms of CPU while a paced mission runs and everything is shown', async () => {
  const run = start(liana, ['run', 'slit_crossing', '--seed', '3', '--time', 'paced', '--console']);
  const chromium = await open_browser();
  try {
    const [address] = /http:\/\/[\d.:]+\//.exec(await run.line(/http:\/\//));
    const page = await open_page(chromium.browser, address);
    await page.waitForFunction(() => window.liana?.live.sample?.facts.step, null, { timeout: 120000 });
    await page.click('#tab-Plots');
    await page.waitForTimeout(8000);
    await page.evaluate(() => window.liana.begin_measurement());
    const before = { browser: cpu_ms(chromium.pid), system: cpu_ms(run.child.pid), machine: machine_ms(), at: Date.now() };
    await page.waitForTimeout(1000 * kMeasured_s);
    const seen = await page.evaluate(() => window.liana.end_measurement());
    const passed_ms = Date.now() - before.at;
    const browser_ms = cpu_ms(chromium.pid) - before.browser;
    const system_ms = cpu_ms(run.child.pid) - before.system;
    const others = (machine_ms() - before.machine - browser_ms - system_ms) / passed_ms;
    await picture(page, 'console_mission');
    const frames = seen.intervals_ms.length;
    const table = {
      frames_per_s: (1000 * frames) / passed_ms,
      cpu_ms_per_frame: browser_ms / frames,
      interval_ms: { median: rank(seen.intervals_ms, 0.5), p90: rank(seen.intervals_ms, 0.9), p99: rank(seen.intervals_ms, 0.99), worst: Math.max(...seen.intervals_ms) },
      age_ms: { median: rank(seen.ages_ms, 0.5), p99: rank(seen.ages_ms, 0.99) },
      others_cores: others,
      system_cores: system_ms / passed_ms,
      pixel_ratio: seen.pixel_ratio,
    };
    writeFileSync(join(screens, 'frames.json'), JSON.stringify(table, null, 1));
    console.log(table);
    const most_ms = others < kQuietCores ? kMostCpu_ms : kMostCpuBeside_ms;
    assert.ok(table.cpu_ms_per_frame <= most_ms, `${table.cpu_ms_per_frame.toFixed(1)} ms, allowed ${most_ms} beside ${others.toFixed(2)} cores`);
    if (others < kQuietCores) assert.ok(table.interval_ms.p99 <= 40 && table.age_ms.median <= 40 && table.age_ms.p99 <= 100, JSON.stringify(table));
    else console.log(`others took ${others.toFixed(2)} cores: intervals and age are reported, not judged`);
  } finally {
    await chromium.close();
    await run.stop();
  }
});
