// What the browser tests share: Chromium and playwright-core (exit code 77, skipped, if they are not installed), the
// programs that serve a page, and waiting.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { cpSync, existsSync, mkdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

const kHere = dirname(fileURLToPath(import.meta.url));

/** How many times slower than a release build this one may be; ctest sets it. */
export const kPatience = Number(process.env.SWIFTLET_TEST_PATIENCE ?? 1);

export function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}

/** playwright-core is installed below the build folder, once. */
function playwright(folder) {
  if (!existsSync(join(folder, 'node_modules', 'playwright-core'))) {
    mkdirSync(folder, { recursive: true });
    cpSync(join(kHere, 'package.json'), join(folder, 'package.json'));
    try {
      execFileSync('npm', ['install', '--no-audit', '--no-fund', '--loglevel=error'], { cwd: folder, stdio: 'inherit', timeout: 120_000 });
    } catch {
      skip('npm could not install playwright-core');
    }
  }
  return createRequire(resolve(folder, 'index.js'))('playwright-core');
}

export async function launch(folder, ...args) {
  const executablePath = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
  if (!executablePath) skip('there is no chromium; apt-get install chromium');
  return playwright(folder).chromium.launch({ executablePath, args: ['--no-sandbox', ...args] });
}

/** Starts a program that prints the link of its page. Its lines are kept in `lines`. */
export async function start(program, args, options = {}) {
  const child = spawn(program, args, { stdio: ['pipe', 'pipe', 'inherit'], ...options });
  const lines = [];
  const ended = new Promise((done) => child.once('exit', (code, signal) => done({ code, signal })));
  const url = await new Promise((found, failed) => {
    createInterface({ input: child.stdout }).on('line', (line) => {
      lines.push(line);
      const link = line.match(/http:\S+/);
      if (link) found(new URL(link[0]));
    });
    ended.then(({ code }) => failed(new Error(`${program} ended with ${code}`)));
  });
  return { child, url, lines, ended };
}

/** Starts the fixture: serve(fixture, port, token, 'silent'); `stop` ends it. */
export async function serve(fixture, port = 0, ...more) {
  const { child, url, ended } = await start(fixture, [String(port), ...more]);
  return {
    url,
    stop: async () => {
      child.stdin.end();
      assert.equal((await ended).code, 0, 'the fixture failed');
    },
  };
}

export async function eventually(what, holds, timeout_s = 60) {
  const end = Date.now() + 1000 * kPatience * timeout_s;
  while (Date.now() < end) {
    if (await holds()) return;
    await new Promise((done) => setTimeout(done, 100));
  }
  assert.fail(`${what} did not happen within ${kPatience * timeout_s} s`);
}

/** Lets `change` modify every state before a page of that context gets it. */
export async function changeStates(context, change) {
  await context.routeWebSocket(/\/api\/ws/, (page) => {
    const vehicle = page.connectToServer();
    vehicle.onMessage((message) => {
      const state = typeof message === 'string' && message.includes('"type":"state"') ? JSON.parse(message) : null;
      if (state) change(state);
      page.send(state ? JSON.stringify(state) : message);
    });
  });
}

/** Where a point of the map is on the canvas, in CSS pixels from its corner. */
export async function onScreen(page, x_m, y_m) {
  await page.waitForFunction(() => document.getElementById('map').dataset.view);
  return page.locator('#map').evaluate((canvas, [x, y]) => {
    const [centerX, centerY, scale] = canvas.dataset.view.split(' ').map(Number);
    return { x: canvas.clientWidth / 2 + (x - centerX) * scale, y: canvas.clientHeight / 2 - (y - centerY) * scale };
  }, [x_m, y_m]);
}

/** Runs {name: async () => page}, or {name: async () => {}}, one after the other; the number of failures. */
export async function run(tests) {
  let failed = 0;
  for (const [name, test] of Object.entries(tests)) {
    try {
      const page = await test();
      assert.deepEqual(page?.problems ?? [], []);
      await page?.context().close();
      console.log(`ok      ${name}`);
    } catch (error) {
      ++failed;
      console.log(`FAILED  ${name}\n${error.stack}`);
    }
  }
  return failed;
}
