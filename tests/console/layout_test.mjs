// Where the page's parts are at many sizes of the screen: nothing lies over a command, and answers are seen where the
// finger is: node layout_test.mjs WEB_FIXTURE WORK_FOLDER
import assert from 'node:assert/strict';

import { eventually, kPatience, launch, run, serve } from './browser.mjs';

const [fixture, folder] = process.argv.slice(2);
const browser = await launch(folder);
const server = await serve(fixture, 0, 'operator-token', 'map3d');

const kUpright = [[320, 568], [360, 640], [375, 667], [390, 844], [412, 915], [430, 932], [600, 960], [768, 1024],
  [820, 1180], [1024, 1366], [1200, 1920], [1440, 2560]];
/** Screens of phones less the bars of the browser. */
const kWithBars = [[844, 340], [852, 330], [844, 365], [568, 232], [390, 664], [320, 450]];
const kSizes = [...kUpright, ...kUpright.map(([width, height]) => [height, width]), ...kWithBars];
const kCommands = ['hold', 'resume', 'home', 'land'];
const kInset_px = 0.75; // A corner itself belongs to no element.

async function open(viewport) {
  const context = await browser.newContext({ viewport, hasTouch: true });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000 * kPatience);
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(error.message));
  await page.goto(String(server.url));
  await page.locator('#link[data-level=good]').waitFor();
  await page.locator('#show3d').waitFor();
  return page;
}

/** Answers every command at once; their names come into the list that is returned. */
async function catchCommands(page, answer = { accepted: true, reason: '' }) {
  const given = [];
  await page.route('**/api/**', (route) => {
    if (route.request().method() !== 'POST') return route.continue();
    given.push(route.request().url().match(/\/api\/(\w+)/)[1]);
    return route.fulfill({ json: answer });
  });
  return given;
}

/** {command: [[x, y], ...]}: the middle, the corners and the middles of the edges. Fails where another element is hit. */
const pointsOf = (page, where) => page.evaluate(([names, inset, place]) => Object.fromEntries(names.map((name) => {
  const button = document.querySelector(`.commands [data-command=${name}]`);
  const { left, top, right, bottom } = button.getBoundingClientRect();
  const xs = [left + inset, (left + right) / 2, right - inset], ys = [top + inset, (top + bottom) / 2, bottom - inset];
  const points = xs.flatMap((x) => ys.map((y) => [x, y]));
  for (const [x, y] of points) {
    const hit = document.elementFromPoint(x, y);
    if (hit?.closest('[data-command]') !== button)
      throw new Error(`${place}: ${name} at (${x}, ${y}) is ${hit ? `${hit.tagName} ${hit.id || hit.className}` : 'out of view'}`);
  }
  if (right - left < 44 || bottom - top < 44) throw new Error(`${place}: ${name} is ${right - left} x ${bottom - top}`);
  return [name, points];
})), [kCommands, kInset_px, where]);

const setPanels = (page, open) => page.evaluate((wanted) => {
  for (const panel of document.querySelectorAll('details')) panel.open = wanted;
  for (const scroller of document.querySelectorAll('.scene, aside')) scroller.scrollTop = wanted ? 1e6 : 0;
}, open);

const inView = (page, selector) => page.locator(selector).evaluate((node) => {
  const { left, top, right, bottom } = node.getBoundingClientRect();
  return left >= 0 && top >= 0 && right <= innerWidth && bottom <= innerHeight && bottom > top;
});

const tests = {
  async 'nothing lies over a command, and a tap on it gives that command, at any size'() {
    const page = await open({ width: 844, height: 340 });
    const given = await catchCommands(page);
    for (const [i, [width, height]] of kSizes.entries()) {
      await page.setViewportSize({ width, height });
      for (const in3d of [false, true]) {
        if ((await page.locator('#show3d').getAttribute('aria-pressed')) !== String(in3d)) await page.locator('#show3d').tap();
        for (const panels of [true, false]) {
          await setPanels(page, panels);
          const where = `${width} x ${height}${in3d ? ', 3D' : ''}${panels ? ', panels open' : ''}`;
          const points = await pointsOf(page, where);
          // What is hit is known at all nine points; the taps, at two corners, take turns among the four.
          if (i % 4 !== 2 * in3d + panels) continue;
          for (const name of kCommands) {
            given.length = 0;
            for (const [x, y] of [points[name].at(0), points[name].at(-1)]) await page.touchscreen.tap(x, y);
            await eventually(`${where}: twice ${name}`, () => given.length >= 2);
            assert.deepEqual(given, Array(2).fill(name), where);
          }
        }
      }
    }
    return page;
  },

  async 'all that the page may tell at once lies over no command either'() {
    const page = await open({ width: 844, height: 340 });
    for (const [width, height] of kWithBars) {
      await page.setViewportSize({ width, height });
      await page.evaluate(() => {
        for (const id of ['alarms', 'banner', 'question']) document.getElementById(id).hidden = false;
        const words = 'the vehicle turned back with 28 % of the battery left, 9 % to fly 12.0 m home';
        document.querySelector('#alarms ol').innerHTML = `<li>${words}</li>`.repeat(3);
        document.getElementById('question-text').textContent = words.repeat(3);
      });
      await pointsOf(page, `${width} x ${height}`);
      assert.ok(await inView(page, '#alarms button'), `${width} x ${height}: the alarms cannot be read`);
    }
    return page;
  },

  async 'a map as it was, too high for its row, would be found'() {
    const page = await open({ width: 844, height: 340 });
    // The page's content policy refuses a style sheet that is added, not what a script sets.
    await page.evaluate(() => Object.assign(document.querySelector('.map').style, { minHeight: '260px', zIndex: 9 }));
    await assert.rejects(pointsOf(page, 'planted'), /hold at .* is CANVAS map/);
    return page;
  },

  async 'the answer to a command is in view near the finger, wherever the page is scrolled'() {
    for (const [width, height] of [[390, 844], [820, 1180], [844, 340], [1180, 820]]) {
      const page = await open({ width, height });
      await catchCommands(page);
      await setPanels(page, true);
      const button = await page.locator('[data-command=hold]').boundingBox();
      await page.touchscreen.tap(button.x + button.width / 2, button.y + button.height / 2);
      await page.locator('.toast').waitFor();
      await page.waitForTimeout(300); // It rises for a moment.
      assert.ok(await inView(page, '.toast'), `${width} x ${height}`);
      const toast = await page.locator('.toast').boundingBox();
      assert.ok(Math.abs(toast.y + toast.height - button.y) < 60, `${width} x ${height}: ${button.y - toast.y} px away`);
      assert.ok(await inView(page, '#link'), 'the state of the link is out of view');
      await page.context().close();
    }
  },

  async 'a refused mission is told beside its slide'() {
    for (const [width, height] of [[390, 844], [820, 1180], [1180, 820]]) {
      const page = await open({ width, height });
      await catchCommands(page, { accepted: false, reason: 'the battery is low' });
      await setPanels(page, true);
      const slide = page.locator('#mission-slide');
      await slide.scrollIntoViewIfNeeded();
      const box = await slide.boundingBox();
      const y = box.y + box.height / 2;
      await page.mouse.move(box.x + 26, y);
      await page.mouse.down();
      for (let i = 1; i <= 20; ++i) await page.mouse.move(box.x + 26 + ((box.width - 52) * i) / 20, y);
      await page.mouse.up();
      await page.getByText('the battery is low').waitFor();
      await page.waitForTimeout(300);
      assert.ok(await inView(page, '.toast'), `${width} x ${height}`);
      const toast = await page.locator('.toast').boundingBox();
      assert.ok(Math.abs(toast.y - y) < 200, `${width} x ${height}: ${y - toast.y} px away`);
      await page.context().close();
    }
  },
};

const failed = await run(tests);
await browser.close();
await server.stop();
process.exit(failed ? 1 : 0);
