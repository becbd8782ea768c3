// Runs the tests of the page: types, style, plain modules, and end to end in Chromium against the real system.
//   node tests/page/run.mjs [SUITE ...] [--judge-times]; SUITE: unit, or a file of e2e/ without _test.mjs; all without one.
//   Needs `npm ci` in host/apps/web. --judge-times: frames must hold their figures, not only their ratio
// (docs/getting-started/tour-of-the-console.md).
import { spawnSync } from 'node:child_process';
import { existsSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, '..', '..');
const page = join(root, 'host', 'apps', 'web');

function run(what, program, args, cwd = root) {
  console.log(`== ${what}`);
  const { status } = spawnSync(program, args, { cwd, stdio: 'inherit', env: { ...process.env, LIANA_ROOT: root } });
  if (status !== 0) process.exitCode = 1;
  return status === 0;
}

if (!existsSync(join(page, 'node_modules', 'eslint'))) {
  console.error('tests/page: npm ci in host/apps/web first (about 110 MB)');
  process.exit(2);
}
const suites = readdirSync(join(here, 'e2e')).filter((file) => file.endsWith('_test.mjs')).map((file) => file.replace('_test.mjs', ''));
const options = process.argv.slice(2).filter((word) => word === '--judge-times');
const wanted = process.argv.slice(2).filter((word) => !options.includes(word));
const unknown = wanted.filter((name) => name !== 'unit' && !suites.includes(name));
if (unknown.length > 0) {
  console.error(`tests/page: no tests ${unknown.join(', ')}; there are unit, ${suites.join(', ')}`);
  process.exit(2);
}
const isWanted = (name) => wanted.length === 0 || wanted.includes(name);

const isBuilt = run('build', 'bash', ['bundle'], page);
if (isBuilt && isWanted('unit')) {
  run('types', process.execPath, [join('node_modules', 'typescript', 'bin', 'tsc'), '--noEmit', '-p', '.'], page);
  run('style', 'npm', ['run', '--silent', 'lint'], page);
  const built = join(root, 'build', 'page', 'tests');
  if (run('unit tests', process.execPath, ['build.mjs', '--tests'], page))
    run('unit tests', process.execPath, ['--test', ...readdirSync(built).filter((file) => file.endsWith('.mjs')).map((file) => join(built, file))]);
}
if (isBuilt) for (const suite of suites.filter(isWanted)) run(suite, process.execPath, [join(here, 'e2e', `${suite}_test.mjs`), ...options]);
