// An operator flies: the real program, the page in Chromium, a tapped goal, the vehicle arrives, holds, comes home and
// lands. node flight_page_test.mjs SWIFTLET WORK_FOLDER
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { createInterface } from 'node:readline';
import { once } from 'node:events';

import { kPatience, launch } from './browser.mjs';

const [swiftlet, folder] = process.argv.slice(2);
const browser = await launch(folder);

const flight = spawn(swiftlet, ['fly', 'missions/operator_goals.xml', '--seed', '5', '--speed', '3', '--port', '0',
  '--time-limit', '400', '--out', `${folder}/operator-run`], { stdio: ['ignore', 'pipe', 'inherit'] });
const ended = once(flight, 'exit');
const url = await new Promise((resolve, reject) => {
  const lines = createInterface({ input: flight.stdout });
  lines.on('line', (line) => { const found = line.match(/http:\S+/); if (found) resolve(new URL(found[0])); });
  flight.once('exit', () => reject(new Error('the program ended before it listened')));
});
const state = async () => (await fetch(`${url.origin}/api/state`)).json();

async function eventually(what, holds, timeout_s) {
  const end = Date.now() + 1000 * kPatience * timeout_s;
  while (Date.now() < end) {
    if (await holds()) return;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  assert.fail(`${what} did not happen within ${kPatience * timeout_s} s: ${JSON.stringify(await state()).slice(0, 600)}`);
}

try {
  const context = await browser.newContext({ viewport: { width: 1180, height: 820 }, hasTouch: true });
  const page = await context.newPage();
  page.setDefaultTimeout(30_000 * kPatience);
  await page.goto(String(url));
  await page.locator('#flight-state, #mission-state').first().waitFor();
  await eventually('the take-off', async () => (await state()).flight_state === 'flying', 60);
  await page.locator('#zoom-out').tap(); // The fit would move the map while it grows.
  await page.waitForTimeout(1500);

  const goal = { x_m: 0.0, y_m: -2.5 };
  const place = await page.locator('#map').evaluate((canvas, { x_m, y_m }) => {
    const [x, y, scale] = canvas.dataset.view.split(' ').map(Number);
    return { x: canvas.clientWidth / 2 + (x_m - x) * scale, y: canvas.clientHeight / 2 - (y_m - y) * scale };
  }, goal);
  const answer = page.waitForResponse((response) => response.url().endsWith('/api/goal'));
  await page.locator('#map').tap({ position: place });
  const said = await (await answer).json();
  assert.equal(said.accepted, true, said.reason);
  await eventually('the arrival', async () => {
    const { pose } = await state();
    return Math.hypot(pose.x_m - goal.x_m, pose.y_m - goal.y_m) < 0.1;
  }, 60);

  await page.getByRole('button', { name: 'Home' }).tap();
  await eventually('coming home', async () => {
    const { pose } = await state();
    return Math.hypot(pose.x_m, pose.y_m) < 0.1;
  }, 60);
  await page.screenshot({ path: `${folder}/operator.png` });
  await page.getByRole('button', { name: 'Land' }).tap();
  await eventually('the landing', async () => flight.exitCode !== null || (await state()).flight_state === 'landed', 60);
  const [code] = await ended;
  assert.ok(code === 0 || code === 1, `the program ended with ${code}`);
  await page.getByText('The flight has ended: stopped').waitFor();
  await page.waitForTimeout(3000); // The program is gone by now.
  assert.equal(await page.locator('#link').innerText(), 'Ended');
  assert.equal(await page.getByText('Link lost').isVisible(), false);
  console.log('1 passed, 0 failed');
} finally {
  flight.kill('SIGTERM');
  await browser.close();
}
