// The console over TLS: what a browser of today negotiates is served, and the page outlives its gateway there, too.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openBrowser, openPage, until } from './browser.mjs';
import { processCalled, startConsole } from './system.mjs';

const folder = mkdtempSync(join(tmpdir(), 'liana-tls-'));
const [cert, key] = ['cert.pem', 'key.pem'].map((name) => join(folder, name));
let system, chromium, page;

before(async () => {
  execFileSync('openssl', ['req', '-x509', '-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:prime256v1', '-nodes', '-days', '2',
    '-subj', '/CN=localhost', '-addext', 'subjectAltName=IP:127.0.0.1', '-out', cert, '-keyout', key], { stdio: 'ignore' });
  system = await startConsole('--cert', cert, '--key', key);
  chromium = await openBrowser();
  page = await openPage(chromium.browser, system.address, { ignoreHTTPSErrors: true });
});

after(async () => {
  await chromium?.close();
  await system?.stop();
  rmSync(folder, { recursive: true });
});

test('a browser that offers HTTP/2 is served the page by HTTP/1.1, and shows the arm', async () => {
  assert.match(page.url(), /^https:/);
  const spoken = await page.evaluate(() => performance.getEntriesByType('navigation')[0].nextHopProtocol);
  assert.equal(spoken, 'http/1.1');
  await until(page, 'a state', (now) => now.time_s > 0);
});

test('when the gateway dies the page says that the arm holds, and goes on with the one that is started', async () => {
  process.kill(processCalled(system.child.pid, 'liana-gateway'), 'SIGKILL');
  await page.waitForFunction(() => /an arm that was steered from here holds/.test(document.body.textContent));
  await page.waitForFunction(() => document.querySelector('.status .badge:last-child').textContent === 'live', null, { timeout: 60000 });
});
