// The mission on the page, in Chromium: its live tree of 500 nodes, and missions that are started, changed and stopped.
// node missions_test.mjs WEB_FIXTURE WORK_FOLDER
import assert from 'node:assert/strict';

import { eventually, kPatience, launch, run, serve } from './browser.mjs';

const [fixture, folder] = process.argv.slice(2);
const browser = await launch(folder);
const large = await serve(fixture, 0, 'operator-token', 'tree');
const small = await serve(fixture);

/** `prepare(context)` before the page is loaded. */
async function open(url, prepare = async () => {}) {
  const context = await browser.newContext({ viewport: { width: 1180, height: 900 }, hasTouch: true });
  await prepare(context);
  const page = await context.newPage();
  page.setDefaultTimeout(120_000 * kPatience);
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(error.message));
  await page.goto(String(url));
  await page.locator('#link[data-level=good]').waitFor();
  return page;
}

const state = async (url) => (await fetch(`${url.origin}/api/state`)).json();
const node = (page, id) => page.locator(`#tree li[data-id="${id}"]`);

/** Draws the knob from its place by `share` of the way. */
async function slide(page, share) {
  const box = await page.locator('#mission-slide').boundingBox();
  const y = box.y + box.height / 2;
  await page.mouse.move(box.x + 26, y);
  await page.mouse.down();
  for (let i = 1; i <= 20; ++i) await page.mouse.move(box.x + 26 + (box.width - 52) * share * (i / 20), y);
  await page.mouse.up();
}

const tests = {
  async 'the tree shows states, reasons and ports, and opens and closes'() {
    const page = await open(large.url);
    await eventually('the nodes', async () => (await page.locator('#tree li').count()) === 500);
    await page.locator('#tree li[data-id="2"] > .node[data-status=FAILURE]').waitFor();
    const told = await page.locator('#tree li[data-id="2"] > p').innerText();
    assert.equal(told, 'no path to (3.00, -1.50) · goal: {door} = 3;-1.5 · mode: fast');
    const color = (status) => page.locator(`#tree .node[data-status=${status}]`).first()
      .evaluate((row) => getComputedStyle(row, '::before').backgroundColor);
    assert.notEqual(await color('FAILURE'), await color('RUNNING'));
    const root = node(page, 0);
    assert.equal(await root.getAttribute('aria-expanded'), 'true');
    await page.screenshot({ path: `${folder}/tree.png` });
    await root.locator('> .node').tap();
    assert.equal(await root.getAttribute('aria-expanded'), 'false');
    assert.equal(await node(page, 2).isVisible(), false);
    await root.locator('> .node').press('ArrowRight');
    await node(page, 2).waitFor();
    await root.locator('> .node').press('ArrowDown');
    assert.equal(await page.evaluate(() => document.activeElement.closest('li').dataset.id), '1');
    // A large tree begins with its subtrees closed.
    assert.equal(await node(page, 1).getAttribute('aria-expanded'), 'false');
    return page;
  },

  async 'only nodes that changed are sent and drawn'() {
    const page = await open(large.url);
    const sizes = [];
    page.on('websocket', (socket) => socket.on('framereceived', ({ payload }) => {
      if (typeof payload === 'string' && payload.includes('"type":"tree"')) sizes.push(payload.length);
    }));
    await page.reload();
    await eventually('a hundred changes', () => sizes.length > 100);
    const later = sizes.slice(1).sort((a, b) => a - b);
    assert.ok(later[later.length >> 1] < sizes[0] / 20, `${sizes[0]} bytes whole, then ${later[later.length >> 1]}`);
    // What is under way shows its duration ten times a second; all else is left alone.
    const touched = await page.evaluate(() => new Promise((done) => {
      const items = new Set();
      const watch = new MutationObserver((changes) => {
        for (const { target } of changes) items.add((target.closest ? target : target.parentElement).closest('li')?.dataset.id);
      });
      watch.observe(document.getElementById('tree'), { subtree: true, childList: true, characterData: true, attributes: true });
      setTimeout(() => { watch.disconnect(); done([...items]); }, 500);
    }));
    assert.ok(touched.length > 5 && !touched.includes('2'), `${touched.length} nodes were drawn`);
    return page;
  },

  async 'a change costs a fraction of the whole tree'() {
    const page = await open(large.url);
    await eventually('the nodes', async () => (await page.locator('#tree li').count()) === 500);
    const work = await page.evaluate(async () => {
      const { MissionTree } = await import('./tree.js');
      const list = document.createElement('ul');
      list.className = 'tree';
      document.body.append(list);
      const tree = new MissionTree(list);
      const nodes = Array.from({ length: 500 }, (_, id) => ({ id, parent: id === 0 ? -1 : Math.floor((id - 1) / 3), name: `n${id}`,
        type: 'Sequence', status: 'IDLE', ports: {}, reason: '', began_s: null, duration_s: null }));
      const frame = () => new Promise(requestAnimationFrame);
      /** What a message costs until it is laid out. */
      const costOf = async (message, now_s) => {
        await frame();
        const begin = performance.now();
        tree.take(message);
        tree.tell(now_s);
        for (const id of tree.changed) tree.show(tree.nodes.get(id));
        list.offsetHeight;
        return performance.now() - begin;
      };
      const whole = [], change = [];
      for (let i = 0; i < 9; ++i) whole.push(await costOf({ whole: true, nodes }, 0));
      for (let i = 0; i < 40; ++i) {
        const five = (from, status) => [0, 1, 2, 3, 4].map((k) => ({ ...nodes[(from + k) % 500], status, began_s: 1 }));
        change.push(await costOf({ whole: false, nodes: [...five(5 * i, 'SUCCESS'), ...five(5 * i + 5, 'RUNNING')] }, i / 10));
      }
      list.remove();
      const middle = (values) => values.sort((a, b) => a - b)[values.length >> 1];
      return { change: middle(change), whole: middle(whole) };
    });
    console.log(`        of 500 nodes: a change of ten ${work.change.toFixed(2)} ms, the whole tree ${work.whole.toFixed(2)} ms`);
    // A busy machine slows both.
    assert.ok(work.change < work.whole / 2, JSON.stringify(work));
    return page;
  },

  async 'a mission is chosen, changed, and started by a slide'() {
    const page = await open(small.url);
    await page.locator('#missions summary').tap();
    await page.locator('#mission-choice').selectOption('missions/hop.xml');
    await page.getByText('Up and down.').waitFor();
    await page.locator('[name="Hop/Sequence/TakeOff.height_m"]').fill('1.4');
    await page.locator('[name="Hop/Sequence/MoveToGoal.mode"]').selectOption('careful');
    await page.screenshot({ path: `${folder}/missions.png` });
    let posts = 0;
    page.on('request', (request) => { posts += request.method() === 'POST'; });
    await slide(page, 0.6);
    const box = await page.locator('#mission-slide').boundingBox();
    await page.mouse.click(box.x + box.width - 8, box.y + box.height / 2);
    assert.equal(posts, 0, 'neither half a slide nor a click starts a mission');
    await slide(page, 1);
    await page.getByText('Mission started').waitFor();
    assert.equal(posts, 1);
    assert.equal((await state(small.url)).mission.name,
      'missions/hop.xml Hop/Sequence/MoveToGoal.mode=careful Hop/Sequence/TakeOff.height_m=1.4');
    await page.locator('#mission-stop').tap();
    await page.getByText('Mission stopped').waitFor();
    await eventually('the stop', async () => (await state(small.url)).mission.state === 'ready');
    await page.locator('#mission-stop:disabled').waitFor();
    return page;
  },

  async 'a mission that cannot be flown says why'() {
    const page = await open(small.url);
    await page.locator('#missions summary').tap();
    await page.locator('[name="Hop/Sequence/TakeOff.height_m"]').fill('999');
    await slide(page, 1);
    await page.getByText('Mission refused').waitFor();
    await page.getByText('`999` is out of range').waitFor();
    return page;
  },

  async 'the knob can be moved by keys'() {
    const page = await open(small.url);
    await page.locator('#missions summary').tap();
    await page.locator('#mission-choice').selectOption('missions/wait.xml');
    await page.locator('#mission-slide').focus();
    for (let i = 0; i < 10; ++i) await page.keyboard.press('PageUp');
    await page.getByText('Mission started').waitFor();
    return page;
  },

  async 'what was typed stays when the link comes back, and what is no longer a parameter is told'() {
    const links = [];
    let gone = false;
    const page = await open(small.url, async (context) => {
      await context.routeWebSocket(/\/api\/ws/, (link) => { link.connectToServer(); links.push(link); });
      await context.route('**/api/missions', async (route) => {
        const response = await route.fetch(), missions = await response.json();
        if (gone) missions[0].parameters.pop();
        await route.fulfill({ response, json: missions });
      });
    });
    await page.locator('#missions summary').tap();
    const height = page.locator('[name="Hop/Sequence/TakeOff.height_m"]'), mode = page.locator('[name="Hop/Sequence/MoveToGoal.mode"]');
    await height.fill('1.4');
    await mode.selectOption('careful');
    const reconnect = async () => {
      const asked = page.waitForResponse('**/api/missions');
      await links.at(-1).close();
      await asked;
      await page.waitForTimeout(300);
    };
    await reconnect();
    assert.deepEqual([await height.inputValue(), await mode.inputValue()], ['1.4', 'careful']);
    gone = true;
    await reconnect();
    await page.getByText('Hop/Sequence/MoveToGoal.mode').first().waitFor();
    assert.equal(await mode.count(), 0);
    await slide(page, 1);
    await page.getByText('Mission started').waitFor();
    await eventually('the start', async () =>
      (await state(small.url)).mission.name === 'missions/hop.xml Hop/Sequence/TakeOff.height_m=1.4');
    return page;
  },

  async 'the missions come on a slow link, and are asked for again after a failure'() {
    let asked = 0;
    const page = await open(small.url, (context) => context.route('**/api/missions', async (route) => {
      if (++asked === 1) return route.fulfill({ status: 503, json: {} });
      await new Promise((done) => setTimeout(done, 3000));
      await route.continue();
    }));
    await page.locator('#missions').waitFor({ timeout: 20_000 * kPatience });
    assert.equal(asked, 2);
    return page;
  },

  async 'a viewer sees no missions'() {
    const page = await open(small.url.origin);
    await page.getByText('View only').waitFor();
    assert.equal(await page.locator('#missions').isVisible(), false);
    assert.equal((await fetch(`${small.url.origin}/api/missions`)).status, 401);
    return page;
  },
};

const failed = await run(tests);
await browser.close();
await large.stop();
await small.stop();
process.exit(failed ? 1 : 0);
