// The operator's page in Chromium against a made-up flight: node console_test.mjs WEB_FIXTURE WORK_FOLDER
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';

import { changeStates, eventually, kPatience, launch, onScreen, run, serve } from './browser.mjs';

const [fixture, folder] = process.argv.slice(2);

const browser = await launch(folder);
let server = await serve(fixture);
const { origin } = server.url;

async function open(url, { context, ...options } = {}) {
  context ??= await browser.newContext({ viewport: { width: 1180, height: 820 }, hasTouch: true, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(120_000 * kPatience);  // A machine with other work shows a page in its own time.
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(error.message));
  page.on('request', (request) => {
    const { protocol, origin: from } = new URL(request.url());
    if (protocol.startsWith('http') && from !== origin) page.problems.push(`asked for ${request.url()}`);
  });
  await page.goto(String(url));
  await page.locator('#link[data-level=good]').waitFor();
  return page;
}

const state = async () => (await fetch(`${origin}/api/state`)).json();

/** Opens the page and lets `change` modify every state before the page gets it. */
async function openWith(change) {
  const context = await browser.newContext({ viewport: { width: 1180, height: 820 }, hasTouch: true });
  await changeStates(context, change);
  return open(server.url, { context });
}

async function tapGoal(page, x_m, y_m) {
  const answer = page.waitForResponse((response) => response.url().endsWith('/api/goal'));
  await page.locator('#map').tap({ position: await onScreen(page, x_m, y_m) });
  return (await answer).json();
}

const tests = {
  async 'the token leaves the address bar'() {
    const page = await open(server.url);
    assert.equal(new URL(page.url()).search, '');
    return page;
  },

  async 'a tapped goal is accepted, marked and reached'() {
    const page = await open(server.url);
    await page.locator('#zoom-out').tap(); // The fit would move the map while it grows.
    const answer = await tapGoal(page, 1.2, 0.6);
    assert.equal(answer.accepted, true);
    await page.getByText('Goal accepted').waitFor();
    await eventually('the goal', async () => {
      const { goal } = await state();
      return goal && Math.hypot(goal.x_m - 1.2, goal.y_m - 0.6) < 0.05;
    });
    // Its ring is on the map, 10 pixels from the point.
    const place = await onScreen(page, 1.2, 0.6);
    await eventually('the marker', () => page.locator('#map').evaluate((canvas, { x, y }) => {
      const ratio = canvas.width / canvas.clientWidth;
      const wanted = getComputedStyle(document.documentElement).getPropertyValue('--map-goal').trim();
      const near = canvas.getContext('2d').getImageData((x - 14) * ratio, (y - 14) * ratio, 28 * ratio, 28 * ratio).data;
      const [red, green, blue] = [1, 3, 5].map((i) => parseInt(wanted.slice(i, i + 2), 16));
      let count = 0;
      for (let i = 0; i < near.length; i += 4)
        count += Math.abs(near[i] - red) + Math.abs(near[i + 1] - green) + Math.abs(near[i + 2] - blue) < 30;
      return count > 20;
    }, place));
    await eventually('the arrival', async () => {
      const { pose } = await state();
      return Math.hypot(pose.x_m - 1.2, pose.y_m - 0.6) < 0.1;
    }, 30);
    return page;
  },

  async 'a refused goal says why'() {
    const page = await open(server.url);
    const answer = await tapGoal(page, -1.95, -3.4);
    assert.equal(answer.accepted, false);
    await page.getByText('is not known to be free').first().waitFor();
    await page.locator('#events').getByText('refused').first().waitFor();
    return page;
  },

  async 'hold and resume show on the page'() {
    const page = await open(server.url);
    await page.getByRole('button', { name: 'Hold' }).tap();
    await page.locator('[data-command=hold][aria-pressed=true]').waitFor();
    await page.locator('#mission-state').getByText('held').waitFor();
    await page.getByRole('button', { name: 'Resume' }).tap();
    await page.locator('#mission-state').getByText('running').waitFor();
    await page.getByRole('button', { name: 'Resume' }).tap();
    await page.getByText('nothing is on hold').waitFor();
    return page;
  },

  async 'dragging moves the map and sends no goal'() {
    const page = await open(server.url);
    let posts = 0;
    page.on('request', (request) => { posts += request.method() === 'POST'; });
    const box = await page.locator('#map').boundingBox();
    await page.mouse.move(box.x + 300, box.y + 300);
    await page.mouse.down();
    await page.mouse.move(box.x + 340, box.y + 320, { steps: 5 });
    await page.locator('#fit[aria-pressed=false]').waitFor(); // Until then the view follows the map as it grows.
    const before = await onScreen(page, 0, 0);
    await page.mouse.move(box.x + 440, box.y + 370, { steps: 5 });
    await page.mouse.up();
    await eventually('the move', async () => Math.abs((await onScreen(page, 0, 0)).x - before.x - 100) < 25);
    assert.equal(posts, 0);
    await page.locator('#fit').tap();
    await page.locator('#fit[aria-pressed=true]').waitFor();
    return page;
  },

  async 'the camera is shown on demand'() {
    const page = await open(server.url);
    assert.equal((await state()).camera_age_s, null);
    await page.locator('#camera-toggle').tap();
    await eventually('a picture', () => page.locator('#camera img').evaluate((image) => image.naturalWidth === 480));
    await page.locator('.picture-age').getByText(/^0\.\d s$/).waitFor();
    await page.locator('#camera-toggle').tap();
    assert.equal(await page.locator('#camera img').count(), 0);
    return page;
  },

  async 'an img shows the stream of the map'() {
    const page = await open(server.url);
    await page.evaluate(() => {
      const image = new Image();
      image.id = 'stream';
      image.src = '/stream/map.mjpg?width=320&fps=5';
      document.body.append(image);
    });
    await eventually('a picture', () => page.locator('#stream').evaluate((image) => image.naturalWidth === 320));
    return page;
  },

  async 'without the token one may only look'() {
    const page = await open(origin);
    await page.getByText('View only').waitFor();
    for (const name of ['Hold', 'Resume', 'Home', 'Land'])
      assert.equal(await page.getByRole('button', { name }).isDisabled(), true);
    return page;
  },

  async 'everything to touch is at least 44 pixels large and has a name'() {
    for (const viewport of [{ width: 1180, height: 820 }, { width: 390, height: 844 }]) {
      const page = await open(server.url, { viewport });
      for (const button of await page.locator('button:visible, summary:visible, input:visible').all()) {
        const box = await button.boundingBox();
        const name = await button.evaluate((node) => node.getAttribute('aria-label') || node.innerText || node.labels?.[0]?.innerText);
        assert.ok(box.height >= 44 && box.width >= 44, `${name}: ${box.width} x ${box.height}`);
        assert.ok(name.trim());
      }
      const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(overflow <= 0, `the page is ${overflow} pixels too wide at ${viewport.width}`);
      if (viewport.width === 390) return page;
      await page.context().close();
    }
  },

  async 'light and dark follow the reader'() {
    const light = await open(server.url, { colorScheme: 'light' });
    const dark = await open(server.url, { colorScheme: 'dark' });
    const brightness = (page) => page.evaluate(() => {
      const canvas = document.getElementById('map');
      const [red, green, blue] = canvas.getContext('2d').getImageData(3, 3, 1, 1).data;
      return red + green + blue;
    });
    assert.ok((await brightness(light)) > 350);
    assert.ok((await brightness(dark)) < 120);
    await light.context().close();
    return dark;
  },

  async 'a flight that has ended is no lost link'() {
    let ending = null;
    const page = await openWith((state) => {
      state.ending = ending;
      if (ending !== null) Object.assign(state.avoidance, { braking: true, reason: 'at most 0.10 m/s' });
    });
    ending = { outcome: 'done', reason: '' };
    await page.getByText('The flight has ended: done.').waitFor();
    assert.equal(await page.locator('#link').innerText(), 'Ended');
    assert.equal(await page.locator('#avoidance').isVisible(), false);
    for (const name of ['Hold', 'Resume', 'Home', 'Land'])
      assert.equal(await page.getByRole('button', { name }).isDisabled(), true);
    ending = { outcome: 'stopped', reason: 'landed: the operator asked for it' };
    await page.getByText('The flight has ended: stopped (landed: the operator asked for it).').waitFor();
    ending = null;
    await page.locator('#link[data-level=good]').waitFor();
    assert.equal(await page.getByRole('button', { name: 'Land' }).isDisabled(), false);
    assert.equal(await page.locator('#banner').isVisible(), false);
    return page;
  },

  async 'what is avoided hides neither the mission’s reason nor the intent’s'() {
    let mission = '', braking = false;
    const page = await openWith((state) => {
      state.mission.phase = 'explore';
      state.mission.reason = mission;
      state.intent.reason = 'waiting: no path';
      state.avoidance = { ...state.avoidance, braking, retreating: false, reason: 'at most 0.10 m/s' };
    });
    await page.locator('#intent').getByText(/^waiting: no path$/).waitFor();
    braking = true;
    await page.locator('#intent').getByText(/^waiting: no path · at most 0.10 m\/s$/).waitFor();
    mission = 'the operator holds';
    await page.locator('#intent').getByText(/^the operator holds · at most 0.10 m\/s$/).waitFor();
    return page;
  },

  async 'what is left to fly with, and how uncertain the position is, are shown'() {
    let known = true;
    const page = await openWith((state) => {
      assert.ok(state.battery.left_s > 0 && state.thrust_margin > 1 && state.drift_m !== undefined);
      state.battery.left_s = known ? 399 : null;
      state.thrust_margin = known ? 1.345 : null;
      state.drift_m = 0.42;
    });
    const shows = (id, text) => page.locator(`#${id}`).getByText(text, { exact: true }).waitFor();
    await shows('left', '6.7 min');
    await shows('margin', '1.34 ×');
    await shows('drift', '0.42 m');
    known = false;
    await shows('left', '–');
    await shows('margin', '–');
    return page;
  },

  async 'a mission that flies its own goals is sent none'() {
    const page = await openWith((state) => { state.mission.accepts_goals = false; });
    let posts = 0;
    page.on('request', (request) => { posts += request.method() === 'POST'; });
    await page.locator('#goal-x:disabled').waitFor({ state: 'attached' });
    for (const name of ['Hold', 'Home']) assert.equal(await page.getByRole('button', { name }).isDisabled(), false);
    await page.locator('#map').tap({ position: await onScreen(page, 1.2, 0.6) });
    await page.getByText('This mission flies its own goals.').waitFor();
    assert.equal(posts, 0);
    return page;
  },

  async 'in portrait the commands and the link stay where they are while all else is scrolled'() {
    const page = await open(server.url, { viewport: { width: 800, height: 1280 } });
    const places = async () => [await page.locator('.commands').boundingBox(), await page.locator('#link').boundingBox()];
    const before = await places();
    assert.ok(Math.abs(before[0].y + before[0].height - 1280) < 2, 'the commands are at the bottom');
    await page.locator('.events').evaluate((list) => { list.style.paddingBottom = '1500px'; });
    await page.locator('.scene').evaluate((scene) => { scene.scrollTop = 900; });
    await eventually('the map out of view', async () => (await page.locator('#map').boundingBox()).y < -300);
    assert.deepEqual(await places(), before);
    return page;
  },

  async 'docs/state.md names every key of the state'() {
    const page = await open(server.url);
    const words = readFileSync(new URL('../../docs/state.md', import.meta.url), 'utf8');
    for (const key of Object.keys(await state())) assert.ok(words.includes(`\`${key}\``), `${key} is missing`);
    return page;
  },

  async 'a lost link is shown and heals by itself'() {
    const page = await open(server.url);
    const port = Number(server.url.port);
    await server.stop();
    await page.getByText('Link lost').waitFor();
    server = await serve(fixture, port);
    await page.locator('#link[data-level=good]').waitFor();
    await page.getByText('Link lost').waitFor({ state: 'hidden' });
    return page;
  },
};

const failed = await run(tests);
await browser.close();
await server.stop();
process.exit(failed ? 1 : 0);
