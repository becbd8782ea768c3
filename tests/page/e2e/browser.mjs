// Chromium without a graphics card, driven by playwright-core.
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { root, screens } from './system.mjs';

const require = createRequire(join(root, 'host', 'apps', 'web', 'package.json'));
const { chromium } = require('playwright-core');
const axeFile = require.resolve('axe-core/axe.min.js');

// What a person without a graphics card gets: WebGL by SwiftShader, the page put together on the processor. Forcing the
// page's layers through SwiftShader, too (--use-angle=swiftshader), is what nobody has, and costs half as much again.
const FLAGS = ['--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader'];

export async function openBrowser() {
  const server = await chromium.launchServer({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: FLAGS });
  const browser = await chromium.connect(server.wsEndpoint());
  return { browser, pid: server.process().pid, close: async () => { await browser.close(); await server.close(); } };
}

// A page whose errors fail the test that looks at `errors`.
export async function openPage(browser, address, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 }, colorScheme: 'dark', ...options });
  page.errors = [];
  page.on('pageerror', (error) => page.errors.push(String(error)));
  page.requests = [];
  page.on('request', (request) => page.requests.push(request.url()));
  await page.goto(address);
  return page;
}

export async function picture(page, name) {
  await page.screenshot({ path: join(screens, `${name}.png`) });
}

// What axe finds that is serious, or worse.
export async function seriousFindings(page) {
  await page.addScriptTag({ path: axeFile });
  const found = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  return found.violations
    .filter((v) => v.impact === 'serious' || v.impact === 'critical')
    .map((v) => `${v.id}: ${v.nodes.map((n) => n.target.join(' ')).slice(0, 4).join('; ')}`);
}

// Of the console: a number of the newest state, and its facts.
export function state(page) {
  return page.evaluate(() => {
    const { sample, facts, welcome } = window.liana.live;
    const get = (name) => (sample ? [...(sample.numbers.get(name) ?? [])] : []);
    return { time_s: sample?.time_s ?? 0, setpoint_cp: get('setpoint_cp'), measured_cp: get('measured_cp'), node_m: get('node_m'), facts, name: welcome?.name };
  });
}

const PATIENCE_MS = 90000; // paced time on a busy machine; nothing is judged by it

// Waits until `holds` is true of the console's state.
export async function until(page, what, holds) {
  const end_ms = Date.now() + PATIENCE_MS;
  for (;;) {
    const now = await state(page);
    if (holds(now)) return now;
    if (Date.now() > end_ms) {
      const { drives, buses, friction, ...facts } = now.facts; // the long ones
      throw new Error(`never came: ${what}; last: ${JSON.stringify({ ...now, facts })}`);
    }
    await page.waitForTimeout(100);
  }
}
