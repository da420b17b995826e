// The page of a flight in a given map, in Chromium against a made-up flight: what it shows lies in the frame of that map,
// and what is tapped is sent in it. node given_map_test.mjs WEB_FIXTURE WORK_FOLDER
import assert from 'node:assert/strict';

import { changeStates, eventually, kPatience, launch, onScreen, run, serve } from './browser.mjs';

const [fixture, folder] = process.argv.slice(2);
const browser = await launch(folder);
const server = await serve(fixture, 0, 'operator-token', 'given');
const state = async () => (await fetch(`${server.url.origin}/api/state`)).json();
/** As the fixture places it. */
const kTMapGiven = { x_m: 1.0, y_m: -0.5, yaw_rad: (40 * Math.PI) / 180 };

function inMap({ x_m, y_m }) {
  const cos = Math.cos(kTMapGiven.yaw_rad), sin = Math.sin(kTMapGiven.yaw_rad);
  return { x_m: kTMapGiven.x_m + cos * x_m - sin * y_m, y_m: kTMapGiven.y_m + sin * x_m + cos * y_m };
}

/** Opens the page and lets `change` modify every state before the page gets it. */
async function open(change = () => {}) {
  const context = await browser.newContext({ viewport: { width: 1180, height: 900 }, hasTouch: true });
  await changeStates(context, change);
  const page = await context.newPage();
  page.setDefaultTimeout(60_000 * kPatience);
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(error.message));
  await page.goto(String(server.url));
  await page.locator('#link[data-level=good]').waitFor();
  return page;
}

function beUnsure(state) {
  Object.assign(state.localization, { state: 'ambiguous', places: 3, x_m: null, y_m: null, yaw_rad: null,
    deviation_m: null, deviation_yaw_rad: null, explained: null, T_map_given: null,
    candidates: [{ x_m: -4, y_m: 2, yaw_rad: 0.5, weight: 0.6 }, { x_m: 4, y_m: -2, yaw_rad: -2.6, weight: 0.3 },
      { x_m: 0, y_m: -3, yaw_rad: 1.6, weight: 0.1 }] });
}

/** Whether enough pixels around a place of a canvas have that colour of the style sheet. */
const shows = (page, id, { x, y }, name, half = 8) => page.locator(`#${id}`).evaluate((canvas, [px, py, style, reach]) => {
  const ratio = canvas.width / canvas.clientWidth;
  const wanted = getComputedStyle(document.documentElement).getPropertyValue(style).trim();
  const [red, green, blue] = [1, 3, 5].map((i) => parseInt(wanted.slice(i, i + 2), 16));
  const near = canvas.getContext('2d').getImageData((px - reach) * ratio, (py - reach) * ratio, 2 * reach * ratio, 2 * reach * ratio).data;
  let count = 0;
  for (let i = 0; i < near.length; i += 4)
    count += Math.abs(near[i] - red) + Math.abs(near[i + 1] - green) + Math.abs(near[i + 2] - blue) < 40;
  return count > 12;
}, [x, y, name, half]);

const tests = {
  async 'the map is shown in the frame of the given one, under that of the flight'() {
    const page = await open();
    await page.locator('#given-legend').waitFor();
    assert.equal(await page.locator('#given-sure').innerText(), '± 5 cm, ± 1.1°, 92 % explained');
    // The corner of the given hall, upright on the page, where the flight has seen nothing.
    await eventually('the wall', async () => shows(page, 'map', await onScreen(page, -6.9, 0.0), '--map-given-wall'));
    await eventually('its floor', async () => shows(page, 'map', await onScreen(page, -5.5, -2.0), '--map-given-free'));
    assert.ok(await page.locator('#event-frame').isVisible(), 'the texts of events are of the other frame, which is said');
    await page.screenshot({ path: `${folder}/given_map.png` });
    return page;
  },

  async 'a corrected alignment of the map, or another map, is drawn in the card'() {
    const page = await open();
    const drawn = await page.evaluate(async () => {
      const { MapStore } = await import('./map_store.js');
      const { GivenMapPanel } = await import('./given_map_panel.js');
      const store = new MapStore();
      const panel = new GivenMapPanel(document.getElementById('given-card').cloneNode(true), store);
      let painted = 0;
      panel.paint = () => { ++painted; };
      const counts = [];
      const take = (message) => {
        store.take(message);
        panel.draw();
        panel.draw(); // Once more: nothing has changed.
        counts.push(painted);
      };
      const tiles = (shade) => ({ type: 'given_tiles', forget: true, resolution_m: 0.05,
        tiles: [{ x: 0, y: 0, shades: new Uint8Array(64 * 64).fill(shade) }] });
      take({ type: 'state', localization: { state: 'localized', x_m: 1, y_m: 2, yaw_rad: 0, places: 1, candidates: [],
        deviation_m: 0.05, deviation_yaw_rad: 0.01, explained: 0.9 } });
      take(tiles(100));
      take({ type: 'given_map', T_given_grid: { x_m: 0, y_m: 0, yaw_rad: 0 } });
      take({ type: 'given_map', T_given_grid: { x_m: 0.4, y_m: 0, yaw_rad: 0.1 } });
      take(tiles(200));
      return counts;
    });
    assert.deepEqual(drawn, [1, 2, 3, 4, 5]);
    return page;
  },

  async 'the 3D view is in the frame that the page shows'() {
    const page = await open();
    const { eye, expected, whole, target } = await page.evaluate(async () => {
      const { Orbit } = await import('./orbit.js');
      const { linesOf } = await import('./map3d_lines.js');
      const { inverse, moved } = await import('./pose2.js');
      const T = { x_m: 1, y_m: -0.5, yaw_rad: 0.7 };
      const orbit = Object.assign(new Orbit(() => {}), { kind: 'orbit', target: [2, 1, 0.5], distance: 3, azimuth: 2.8 });
      const store = { shown: () => ({ frame: 'given', T_shown_map: inverse(T) }), trail: [], state: null };
      const colors = { grid: '#888888' };
      const [floor] = linesOf(store, {}, { low: [-2, -3, 0], high: [4, 1, 2] }, colors);
      const [x, y] = moved(inverse(T), floor.points.slice(0, 2));
      const [ex, ey, ez] = orbit.eye();
      return { eye: orbit.seenIn(T).eye(), expected: [...moved(T, [ex, ey]), ez], whole: [x, y],
        target: orbit.seenIn(T).query() };
    });
    eye.forEach((value, axis) => assert.ok(Math.abs(value - expected[axis]) < 1e-9, `${eye}, not ${expected}`));
    // The lines of the floor are the whole metres of the frame that is shown.
    whole.forEach((value, axis) => assert.ok(Math.abs(value - [-2, -3][axis]) < 1e-6, `${whole}`));
    assert.match(target, /view=orbit&x=1\.89&y=1\.55&z=0\.50/);
    return page;
  },

  async 'a tapped goal is sent and shown in the given map'() {
    const page = await open();
    await page.locator('#given-legend').waitFor();
    await page.locator('#zoom-out').tap(); // The fit would move the map while it grows.
    const goal = { x_m: -0.6, y_m: 0.4 };
    const request = page.waitForRequest((asked) => asked.url().endsWith('/api/goal'));
    await page.locator('#map').tap({ position: await onScreen(page, goal.x_m, goal.y_m) });
    const sent = (await request).postDataJSON();
    assert.equal(sent.frame, 'given');
    assert.ok(Math.hypot(sent.x_m - goal.x_m, sent.y_m - goal.y_m) < 0.05, JSON.stringify(sent));
    await page.getByText('in the given map').first().waitFor();
    const expected = inMap(sent);
    await eventually('the goal', async () => {
      const { goal: flown } = await state();
      return flown && Math.hypot(flown.x_m - expected.x_m, flown.y_m - expected.y_m) < 0.01;
    });
    await eventually('its mark', async () => shows(page, 'map', await onScreen(page, sent.x_m, sent.y_m), '--map-goal', 14));
    return page;
  },

  async 'a keep-out zone lies where it was tapped in the given map'() {
    const page = await open();
    await page.locator('#given-legend').waitFor();
    await page.locator('#zoom-out').tap();
    const corners = [[-5, -3], [-3, -3], [-3, -1]];
    await page.locator('#keep-out').tap();
    for (const [x, y] of corners) await page.locator('#map').tap({ position: await onScreen(page, x, y) });
    await page.locator('#keep-out').tap();
    await page.getByText('Keep-out zone set').waitFor();
    await eventually('the zone', async () => (await state()).keep_out.length === 1);
    (await state()).keep_out[0].forEach(([x, y], i) => {
      const expected = inMap({ x_m: corners[i][0], y_m: corners[i][1] });
      assert.ok(Math.hypot(x - expected.x_m, y - expected.y_m) < 0.06, `${i}: ${x}, ${y}`);
    });
    await eventually('its mark', async () => shows(page, 'map', await onScreen(page, -3, -2), '--frontier-blacklisted', 20));
    return page;
  },

  async 'one place that is not sure yet is not called several, nor certain'() {
    const page = await open((state) => {
      beUnsure(state);
      Object.assign(state.localization, { places: 1, candidates: [{ x_m: -4, y_m: 2, yaw_rad: 0.5, weight: 1 }] });
    });
    await page.locator('#given-sure').getByText(/^one place fits, not yet sure$/).waitFor();
    return page;
  },

  async 'while several places fit, each is shown with its weight, and taps are places of the flight'() {
    let unsure = true;
    const page = await open((state) => { if (unsure) beUnsure(state); });
    await page.locator('#given-sure').getByText('ambiguous: 3 places, the likeliest 60 %').waitFor();
    assert.equal(await page.locator('#given-legend').isVisible(), false);
    // The likeliest one, where the card shows (-4, 2) of a hall of 14 m by 10 m.
    const place = await page.locator('#given').evaluate((canvas) => {
      const scale = Math.min((canvas.clientWidth - 20) / 14, (canvas.clientHeight - 20) / 10);
      return { x: canvas.clientWidth / 2 - 4 * scale, y: canvas.clientHeight / 2 - 2 * scale };
    });
    await page.locator('#given').scrollIntoViewIfNeeded();
    await eventually('the arrow', () => page.locator('#given').evaluate((canvas, { x, y }) => {
      const ratio = canvas.width / canvas.clientWidth;
      const [red, green] = canvas.getContext('2d').getImageData(x * ratio, y * ratio, 1, 1).data;
      return red - green > 80; // The colour of goals over the floor.
    }, place));
    await page.screenshot({ path: `${folder}/given_map_unsure.png` });

    const request = page.waitForRequest((asked) => asked.url().endsWith('/api/goal'));
    await page.locator('#map').tap({ position: await onScreen(page, 0.5, 0.5) });
    assert.equal((await request).postDataJSON().frame, 'map');
    await page.locator('#keep-out').tap();
    await page.locator('#map').tap({ position: await onScreen(page, 0.5, 0.5) });
    unsure = false;
    await page.getByText('draw the zone again').waitFor();
    await page.locator('#given-legend').waitFor();
    return page;
  },
};

const failed = await run(tests);
await browser.close();
await server.stop();
process.exit(failed ? 1 : 0);
