// The real system, started as a user would: programs of this tree, nothing is a stand-in.
import { spawn } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

export const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..', '..');
export const screens = join(root, 'build', 'page', 'screens');
mkdirSync(screens, { recursive: true });

function programs() {
  const folders = [process.env.LIANA_BIN, join(root, 'build', 'bin')].filter(Boolean);
  const found = folders.find((folder) => existsSync(join(folder, 'liana')) && existsSync(join(folder, 'liana-gateway')));
  if (!found) throw new Error(`no liana and liana-gateway in ${folders.join(', ')}: build first (./dev build)`);
  return found;
}

export const liana = join(programs(), 'liana');

// Starts a program; `line(pattern)` waits for a line of its output, `ended` for its end.
export function start(program, args) {
  const child = spawn(program, args, { stdio: ['ignore', 'pipe', 'pipe'] });
  const lines = [];
  const waiting = [];
  for (const stream of [child.stdout, child.stderr]) {
    createInterface({ input: stream }).on('line', (text) => {
      lines.push(text);
      for (const each of waiting.splice(0)) each();
    });
  }
  const ended = new Promise((end) => child.on('exit', (code) => end(code)));
  async function line(pattern) {
    for (;;) {
      const found = lines.find((text) => pattern.test(text));
      if (found) return found;
      const code = await Promise.race([ended.then((c) => ({ c })), new Promise((next) => waiting.push(() => next(null)))]);
      if (code && !lines.some((text) => pattern.test(text))) throw new Error(`${program} ended with ${code.c}: ${lines.join('\n')}`);
    }
  }
  async function stop() {
    if (child.exitCode === null) child.kill('SIGINT');
    return ended;
  }
  return { child, lines, line, ended, stop };
}

// A simulated arm without a mission, and its console.
export async function startConsole(...args) {
  const system = start(liana, ['console', '--simulate', '--listen', `127.0.0.1:${freePort()}`, '--json', ...args]);
  return { ...system, ...JSON.parse(await system.line(/"address"/)) }; // api, address
}

let nextPort = 20000 + (process.pid % 20000);
function freePort() {
  return nextPort++;
}

// Process numbers of a process and everything that it started.
export function family(pid) {
  const parents = new Map();
  for (const name of readdirSync('/proc')) {
    if (!/^\d+$/.test(name)) continue;
    try {
      const stat = readFileSync(`/proc/${name}/stat`, 'utf8');
      parents.set(Number(name), Number(stat.slice(stat.lastIndexOf(')') + 2).split(' ')[1]));
    } catch {
      // it has ended meanwhile
    }
  }
  const found = [pid];
  for (let i = 0; i < found.length; ++i) for (const [child, parent] of parents) if (parent === found[i]) found.push(child);
  return found;
}

// The member of the family whose program is called so; undefined when there is none.
export function processCalled(pid, name) {
  return family(pid).find((each) => {
    try {
      return readFileSync(`/proc/${each}/cmdline`, 'utf8').split('\0')[0].endsWith(`/${name}`);
    } catch {
      return false;
    }
  });
}

const TICK_MS = 10; // USER_HZ

function ticksOf(pid) {
  try {
    const stat = readFileSync(`/proc/${pid}/stat`, 'utf8');
    const fields = stat.slice(stat.lastIndexOf(')') + 2).split(' ');
    return Number(fields[11]) + Number(fields[12]);
  } catch {
    return 0;
  }
}

// CPU time of a family [ms].
export function cpu_ms(pid) {
  return TICK_MS * family(pid).reduce((sum, each) => sum + ticksOf(each), 0);
}

// CPU time of the whole machine that was not idle [ms].
export function machine_ms() {
  const [user, nice, system, , , irq, soft] = readFileSync('/proc/stat', 'utf8').split('\n')[0].split(/\s+/).slice(1).map(Number);
  return TICK_MS * (user + nice + system + irq + soft);
}
