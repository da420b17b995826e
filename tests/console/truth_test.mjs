// The page tells what the real program does with the operator's commands, with a full disk, and at the end of the
// flight: node truth_test.mjs SWIFTLET WORK_FOLDER
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';

import { eventually, kPatience, launch, onScreen, run, start } from './browser.mjs';

const [swiftlet, folder] = process.argv.slice(2);
const browser = await launch(folder);

/** Flies a mission and opens its page. `limit_kB`: no file may grow beyond, as on a full disk. */
async function fly(name, mission, { limit_kB, speed = '3' } = {}) {
  const args = ['fly', `missions/${mission}.xml`, '--seed', '5', '--speed', speed, '--port', '0', '--time-limit', '400',
    '--out', `${folder}/truth-${name}`];
  const flight = limit_kB
    ? await start('/bin/bash', ['-c', `trap '' XFSZ; ulimit -f ${limit_kB}; exec "$0" "$@"`, swiftlet, ...args])
    : await start(swiftlet, args);
  const context = await browser.newContext({ viewport: { width: 1180, height: 820 }, hasTouch: true });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000 * kPatience);
  await page.goto(String(flight.url));
  const state = async () => (await fetch(`${flight.url.origin}/api/state`)).json();
  await eventually('the take-off', async () => (await state()).flight_state === 'flying');
  const tap = (button) => page.getByRole('button', { name: button }).tap();
  const ends = async (text) => {
    await page.getByText(text).waitFor();
    const { code } = await flight.ended;
    await page.waitForTimeout(2500);  // The program is gone, and the page keeps its end.
    assert.equal(await page.locator('#link').innerText(), 'Ended');
    assert.equal(await page.getByText('Link lost').isVisible(), false);
    await context.close();
    return code;
  };
  return { ...flight, page, state, tap, ends };
}

const tests = {
  async 'a goal given while held is shown and named by Resume; Hold during a landing is refused'() {
    const { page, state, tap, ends } = await fly('held', 'operator_goals');
    await page.locator('#zoom-out').tap(); // The fit would move the map while it grows.
    await tap('Hold');
    await page.locator('#mission-state').getByText('held').waitFor();
    await page.waitForTimeout(1500);
    await page.locator('#map').tap({ position: await onScreen(page, 0, -1.5) });
    await page.getByText('flown after the hold: the operator holds').first().waitFor();
    await page.locator('#intent').getByText('next, after Resume: goal').waitFor();
    assert.ok((await state()).goal, 'the goal is not on the map');
    await page.locator('#events').getByText(/^goal .* accepted$/).waitFor();
    await tap('Resume');
    await page.locator('#toasts').getByText('next: goal').waitFor();
    await eventually('the arrival', async () => Math.hypot((await state()).pose.x_m, (await state()).pose.y_m + 1.5) < 0.15);

    await tap('Land');
    await eventually('the landing', async () => (await state()).flight_state === 'landing');
    await tap('Hold');
    await page.locator('#toasts').getByText('Hold refused').waitFor();
    await page.getByText('the vehicle is landing').first().waitFor();
    await page.locator('#events').getByText('hold refused').waitFor();
    assert.equal(await ends('The flight has ended: stopped (landed: the operator asked for it).'), 1);
  },

  async 'Home works in a mission that flies its own goals; SIGTERM lands, and the page learns the end'() {
    const { child, page, state, tap, ends, lines } = await fly('home', 'explore_and_return');
    await eventually('some distance', async () => (await state()).distance_flown_m > 2);
    await tap('Home');
    await page.locator('#phase').getByText('fly home').waitFor();
    await page.locator('#flown-by').getByText('operator').waitFor();
    await page.getByText('the mission holds meanwhile').first().waitFor();
    await page.locator('#events').getByText('home reached').waitFor();
    const { pose } = await state();
    assert.ok(Math.hypot(pose.x_m, pose.y_m) < 0.15, `${pose.x_m} ${pose.y_m}`);
    child.kill('SIGTERM');
    await page.locator('#events').getByText('asked to end: landing').waitFor();
    assert.equal(await ends('The flight has ended: stopped (landed: the operator asked for it).'), 1);
    assert.ok(!lines.join('\n').includes('stopped from outside'));
    const { phases } = JSON.parse(readFileSync(`${folder}/truth-home/mission.json`, 'utf8'));
    assert.ok(phases.some(({ name, flown_by: by }) => name === 'fly home' && by === 'operator'), JSON.stringify(phases));
  },

  async 'a second SIGTERM stops at once, and the page learns that too'() {
    const { child, page, ends } = await fly('stopped', 'operator_goals', { speed: '0.5' });
    child.kill('SIGTERM');
    await page.locator('#events').getByText('asked to end: landing').waitFor();
    child.kill('SIGTERM');
    assert.equal(await ends('The flight has ended: stopped (stopped from outside).'), 1);
  },

  async 'a full disk is a warning, and the flight goes on'() {
    const { page, state, tap, ends } = await fly('full', 'operator_goals', { limit_kB: 110 });
    await page.locator('#events [data-severity=warning]').getByText('the run is no longer recorded').waitFor();
    const { stamp_s } = await state();
    await eventually('going on', async () => (await state()).stamp_s > stamp_s + 5);
    assert.equal((await state()).flight_state, 'flying');
    await tap('Land');
    assert.equal(await ends('The flight has ended: stopped (landed: the operator asked for it).'), 2);
  },
};

const failed = await run(tests);
await browser.close();
process.exit(failed ? 1 : 0);
