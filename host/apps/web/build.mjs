// Builds the page: build/page/console.html (one file, live) and build/page/view.html (template of a run's page). With
// --try: build/page/try.html, the page to try Liana, of try.wasm beside it and of the tables that ship.
// Beside them, with --tests, the unit tests of tests/page as one program for node.
import { build } from 'esbuild';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { deflateRawSync } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, '..', '..', '..');
const out = join(root, 'build', 'page');
const MAX_BUNDLE_KB = 720;
const MAX_TRY_KB = 1500;
const TRY_TABLES = [['buses', 'embedded'], ['robot', 'zhu2022'], ['scene', 'panel_slit']];

// The rows of a table in docs/ that begin with a number, as arrays of cells.
function tableRows(file) {
  const lines = readFileSync(join(root, 'docs', file), 'utf8').split('\n');
  const rows = lines.filter((line) => /^\| \d+ \|/.test(line)).map((line) => line.split('|').slice(1, -1).map((c) => c.trim()));
  const width = Math.max(...rows.map((row) => row.length));
  return rows.filter((row) => row.length === width); // the page's first table is its widest
}

// What faults and refusals mean and what to do: written by the code's own tables into docs/.
function faultTables() {
  const faults = tableRows('reference/faults.md').map(([number, name, , , , retract, text, remedy]) => ({
    number: Number(number), name, retract: retract === 'yes', text, remedy,
  }));
  const refusals = tableRows('reference/refusals.md').map(([number, name, text, , action, remedy]) => ({
    number: Number(number), name, text, action, remedy,
  }));
  if (faults.length < 20 || refusals.length < 20) {
    throw new Error('docs/reference/faults.md or docs/reference/refusals.md has another form now');
  }
  return { faults, refusals };
}

const tables = {
  name: 'tables',
  setup(hook) {
    hook.onResolve({ filter: /^liana:tables$/ }, () => ({ path: 'tables', namespace: 'liana' }));
    hook.onLoad({ filter: /.*/, namespace: 'liana' }, () => ({ contents: JSON.stringify(faultTables()), loader: 'json' }));
  },
};

const common = { bundle: true, plugins: [tables], legalComments: 'none', absWorkingDir: here, logLevel: 'warning' };

async function bundle(entry, options) {
  const result = await build({ ...common, entryPoints: [entry], write: false, ...options });
  return result.outputFiles[0].text;
}

// Inside an HTML file no script may contain its own end.
const inlined = (script) => script.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');

const INFLATE = `(async()=>{try{const p=Uint8Array.from(atob(document.getElementById('liana-page').textContent),c=>c.charCodeAt(0));
const s=document.createElement('script');s.textContent=await new Response(new Blob([p]).stream().pipeThrough(new DecompressionStream('deflate-raw'))).text();
document.head.append(s)}catch(e){document.body.textContent='This page needs a browser of 2023 or newer (Chromium 103, Firefox 113, Safari 16.4): '+e}})()`;

const SCRIPT = { minify: true, format: 'iife', target: 'es2021' };

const packedText = (bytes) => deflateRawSync(Buffer.from(bytes), { level: 9 }).toString('base64');

async function emptyPage() {
  const style = await bundle('src/page.css', { minify: true });
  return readFileSync(join(here, 'src', 'page.html'), 'utf8').replace('/* style */', () => style);
}

async function pages() {
  const script = await bundle('src/main.ts', SCRIPT);
  const shell = await emptyPage();
  const packed = packedText(script);
  const fill = (text) => shell.replace('<!-- script -->', () => text);
  mkdirSync(out, { recursive: true });
  writeFileSync(join(out, 'console.html'), fill(`<script>${inlined(script)}</script>`).replace('<!-- liana-run -->\n', ''));
  writeFileSync(join(out, 'view.html'), fill(`<script type="text/plain" id="liana-page">${packed}</script>\n<script>${INFLATE}</script>`));
  const size_kB = Math.ceil(script.length / 1000);
  console.log(`build/page: script ${size_kB} kB, packed ${Math.ceil(packed.length / 1000)} kB`);
  if (size_kB > MAX_BUNDLE_KB) throw new Error(`the script has ${size_kB} kB, at most ${MAX_BUNDLE_KB} are allowed`);
}

// Tables as the system evaluates them: canonical JSON, a line each.
function tryTables() {
  const folders = [process.env.LIANA_BIN, join(root, 'build', 'bin')].filter(Boolean);
  const program = folders.map((folder) => join(folder, 'liana-mission')).find((file) => existsSync(file));
  if (!program) throw new Error(`no liana-mission in ${folders.join(', ')}, which reads the tables of try.html: build it first (./dev build)`);
  const lua = ['--lua-dir', join(root, 'lua')];
  return TRY_TABLES.map(([kind, name]) => execFileSync(program, ['eval', kind, name, ...lua], { encoding: 'utf8' })).join('');
}

async function tryPage() {
  const script = await bundle('src/try/main.ts', SCRIPT);
  const held = { 'liana-tables': inlined(tryTables()), 'liana-try': packedText(readFileSync(join(out, 'try.wasm'))), 'liana-page': packedText(script) };
  const texts = Object.entries(held).map(([id, text]) => `<script type="text/plain" id="${id}">${text}</script>`).join('\n');
  const html = (await emptyPage())
    .replace('<title>Liana</title>', '<title>Try Liana</title>')
    .replace('<!-- liana-run -->\n', '')
    .replace('<!-- script -->', () => `${texts}\n<script>${INFLATE}</script>`);
  writeFileSync(join(out, 'try.html'), html);
  const size_kB = Math.ceil(html.length / 1000);
  console.log(`build/page: try.html ${size_kB} kB`);
  if (size_kB > MAX_TRY_KB) throw new Error(`try.html has ${size_kB} kB, at most ${MAX_TRY_KB} are allowed`);
}

async function tests() {
  const folder = join(root, 'tests', 'page');
  const entries = readdirSync(folder).filter((file) => file.endsWith('_test.ts')).map((file) => join(folder, file));
  await build({ ...common, entryPoints: entries, outdir: join(out, 'tests'), platform: 'node', format: 'esm', outExtension: { '.js': '.mjs' } });
}

if (process.argv.includes('--tests')) await tests();
else if (process.argv.includes('--try')) await tryPage();
else await pages();
