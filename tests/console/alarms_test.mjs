// What the page tells of who flies, of alarms, and how well its map can be told apart, against a made-up flight:
// node alarms_test.mjs WEB_FIXTURE WORK_FOLDER
import assert from 'node:assert/strict';

import { eventually, kPatience, launch, onScreen, run, serve } from './browser.mjs';

const [fixture, folder] = process.argv.slice(2);
const browser = await launch(folder);
const server = await serve(fixture);

/** `change(state)` modifies every state; page.tell(event) makes an event arrive. Vibrations and sounds are counted. */
async function open(change = () => {}, options = {}) {
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, hasTouch: true, ...options });
  await context.addInitScript(() => {
    window.counted = { vibrations: 0, sounds: 0 };
    navigator.vibrate = (pattern) => { counted.vibrations += pattern !== 0; return true; };
    const start = OscillatorNode.prototype.start;
    OscillatorNode.prototype.start = function (...when) { ++counted.sounds; return start.apply(this, when); };
  });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000 * kPatience);
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(error.message));
  const told = [];
  let socket = null;
  const send = (events) => socket.send(JSON.stringify({ type: 'events', events }));
  page.tell = (event) => {
    told.push({ number: 1000 + told.length, stamp_s: 5, severity: 'warning', source: 'supervisor', reason: '', ...event });
    send(told.slice(-1));
  };
  await context.routeWebSocket(/\/api\/ws/, (link) => {
    socket = link;
    const vehicle = link.connectToServer();
    vehicle.onMessage((message) => {
      const parsed = typeof message === 'string' ? JSON.parse(message) : null;
      if (parsed?.type === 'state') change(parsed);
      link.send(parsed ? JSON.stringify(parsed) : message);
      if (parsed?.type === 'hello') send(told);
    });
  });
  await page.goto(String(server.url));
  await page.locator('#link[data-level=good]').waitFor();
  return page;
}

/** Longer than taps are dropped where a notice has come. */
const kSettle_ms = 1000;

const counts = (page) => page.evaluate(() => window.counted);
const kTurnBack = { text: 'turn back', alarm: 'turn back', reason: 'turned back with 28 % of the battery left' };

// ------------------------------------------------------------------------------------------------ contrast, WCAG 2.1

/** Machado, Oliveira and Fernandes 2009, severity 1, on linear light. */
const kSights = {
  all: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  protanopia: [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  deuteranopia: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
  tritanopia: [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]],
};

/** [r, g, b] from 0 to 1, laid over `back` if it is transparent. */
function colorOf(text, back = [1, 1, 1]) {
  const parts = text.startsWith('#') ? [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16)) : text.match(/[\d.]+/g).map(Number);
  const alpha = (parts[3] ?? 100) / 100;
  return parts.slice(0, 3).map((value, i) => (alpha * value) / 255 + (1 - alpha) * back[i]);
}

const linear = (value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);

function luminance(color, sight) {
  const light = color.map(linear);
  const seen = sight.map((row) => Math.min(1, Math.max(0, row.reduce((sum, part, i) => sum + part * light[i], 0))));
  return 0.2126 * seen[0] + 0.7152 * seen[1] + 0.0722 * seen[2];
}

function contrast(a, b, sight) {
  const [low, high] = [luminance(a, sight), luminance(b, sight)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

const tests = {
  async 'an alarm stands in view until it is read, vibrates and sounds'() {
    const page = await open();
    await page.locator('#map').tap(); // A browser lets a page sound only once it was touched.
    assert.equal(await page.locator('#alarms').isVisible(), false);
    assert.equal(await page.locator('#alarms').getAttribute('role'), 'alert');
    page.tell({ text: 'go to (1, 2): done', severity: 'info' });
    page.tell({ text: 'scans are late', severity: 'warning' });
    await page.locator('#events').getByText('scans are late').waitFor();
    assert.equal(await page.locator('#alarms').isVisible(), false, 'no alarm');
    page.tell(kTurnBack);
    await page.locator('#alarms').getByText('28 % of the battery left').waitFor();
    await eventually('the sound', async () => (await counts(page)).sounds > 0);
    assert.equal((await counts(page)).vibrations, 1);
    await page.locator('.scene').evaluate((scene) => { scene.scrollTop = 1e6; });
    await page.waitForTimeout(3000);
    const box = await page.locator('#alarms').boundingBox();
    assert.ok(box.y >= 0 && box.y + box.height < 844 / 2, JSON.stringify(box));
    await page.screenshot({ path: `${folder}/alarm.png` });
    await page.getByRole('button', { name: 'Read' }).tap();
    assert.equal(await page.locator('#alarms').isVisible(), false);
    page.tell({ ...kTurnBack, text: 'land', alarm: 'landing', reason: '12 % of the battery left' });
    await page.locator('#alarms').getByText('12 % of the battery left').waitFor();
    assert.equal(await page.locator('#alarms').getByText('turned back').count(), 0);
    return page;
  },

  async 'it comes again until it is read, and also to a page that was loaded anew; what was read does not'() {
    const page = await open();
    // As in a browser that lets a page sound only once it was touched; this one may let it at once.
    await page.evaluate(() => Object.defineProperty(AudioContext.prototype, 'state', { get: () => 'suspended' }));
    page.tell(kTurnBack);
    await page.locator('#alarms').getByText('turned back').waitFor();
    await eventually('a second call', async () => (await counts(page)).vibrations >= 2);
    assert.equal((await counts(page)).sounds, 0, 'a page that was never touched queues no tones');
    await page.reload();
    await page.locator('#alarms').getByText('turned back').waitFor();
    await page.waitForTimeout(kSettle_ms);
    await page.getByRole('button', { name: 'Read' }).tap();
    await page.reload();
    await page.locator('#events').getByText('turn back').waitFor();
    assert.equal(await page.locator('#alarms').isVisible(), false);
    return page;
  },

  async 'a tap where a notice has just come or gone does nothing'() {
    const page = await open();
    const given = [];
    await page.route('**/api/*', (route) => {
      if (route.request().method() !== 'POST') return route.continue();
      given.push(route.request().url().match(/\/api\/(\w+)/)[1]);
      return route.fulfill({ json: { accepted: true, reason: '' } });
    });
    page.tell(kTurnBack);
    const read = page.getByRole('button', { name: 'Read' });
    await read.waitFor();
    await page.waitForTimeout(kSettle_ms);
    const { x, y, width, height } = await read.boundingBox();
    const middle = [x + width / 2, y + height / 2];
    const hit = await page.evaluate(async (at) => {
      const frame = () => new Promise((done) => { requestAnimationFrame(done); });
      const where = { clientX: at[0], clientY: at[1], bubbles: true };
      document.elementFromPoint(...at).dispatchEvent(new MouseEvent('click', where));
      await frame();
      await frame();
      const below = document.elementFromPoint(...at);
      let hit = below.id;
      below.addEventListener('pointerdown', () => { hit += ' was tapped'; }, { once: true });
      below.dispatchEvent(new PointerEvent('pointerdown', where));
      return hit;
    }, middle);
    assert.equal(hit, 'map');
    assert.deepEqual(given, []);
    await page.waitForTimeout(kSettle_ms);
    await page.touchscreen.tap(...middle);
    await eventually('a goal', () => given.includes('goal'));
    return page;
  },

  async 'the sound can be muted, and stays so; the vibration and the banner stay'() {
    const page = await open();
    await page.locator('#mute').tap();
    await page.reload();
    await page.locator('#mute[aria-pressed=true]').waitFor();
    await page.locator('#map').tap();
    page.tell(kTurnBack);
    await page.locator('#alarms').getByText('turned back').waitFor();
    assert.deepEqual(await counts(page), { vibrations: 1, sounds: 0 });
    return page;
  },

  async 'what flies the vehicle is the headline, and Hold is pressed only while the operator holds'() {
    let flown = {};
    const page = await open((state) => Object.assign(state.mission, { state: 'held' }, flown));
    const pressed = (name) => page.locator(`[data-command=${name}]`).getAttribute('aria-pressed');
    flown = { flown_by: 'supervisor', phase: 'fly home', reason: 'turned back with 28 % of the battery left' };
    await page.locator('#phase').getByText('fly home').waitFor();
    await page.locator('#intent').getByText('turned back with 28 %').waitFor();
    await page.locator('#flown-by').getByText('supervisor').waitFor();
    assert.equal(await pressed('hold'), 'false');
    flown = { flown_by: 'operator', phase: 'fly home', reason: 'the operator sent it home' };
    await page.locator('#flown-by').getByText('operator').waitFor();
    assert.deepEqual([await pressed('hold'), await pressed('home')], ['false', 'true']);
    flown = { flown_by: 'operator', phase: 'hold', reason: 'the operator holds' };
    await page.locator('[data-command=hold][aria-pressed=true]').waitFor();
    assert.equal(await pressed('home'), 'false');
    flown = { flown_by: 'supervisor', phase: 'hold', reason: 'the laser is silent' };
    await page.locator('[data-command=hold][aria-pressed=false]').waitFor();
    return page;
  },

  async 'free space, unknown space, walls and what is drawn can be told apart by everybody'() {
    const kOnFree = ['wall', 'unknown', 'trail', 'plan', 'goal', 'home', 'vehicle', 'laser', 'level', 'text'];
    for (const colorScheme of ['light', 'dark']) {
      const page = await open(() => {}, { colorScheme });
      const styles = await page.evaluate(() => {
        const names = [...document.styleSheets].flatMap((sheet) => [...sheet.cssRules]).flatMap((rule) => [...(rule.style ?? [])]);
        const style = getComputedStyle(document.documentElement);
        return Object.fromEntries(names.filter((name) => /^--(map|frontier)-/.test(name)).map((name) => [name, style.getPropertyValue(name).trim()]));
      });
      const shades = await page.evaluate(async () => {
        const { shades: own, givenShades } = (await import('./map_colors.js')).readColors();
        return [own, givenShades];
      });
      for (const [unknown, ...known] of shades.map((list) => list.map((color) => color.map((value) => value / 255))))
        for (const [i, color] of known.slice(0, 4).entries())
          for (const [sight, matrix] of Object.entries(kSights)) {
            const ratio = contrast(color, unknown, matrix);
            assert.ok(ratio >= 3, `${colorScheme}, ${sight}: free cells of shade ${i + 1} on unknown are ${ratio.toFixed(2)}:1`);
          }
      const free = colorOf(styles['--map-free']);
      const over = (name, back) => colorOf(styles[name], back);
      const pairs = [...kOnFree.map((name) => [`--map-${name}`, '--map-free']), ['--map-wall', '--map-unknown'],
        ['--map-given-free', '--map-unknown'], ['--map-given-wall', '--map-given-free'], ['--map-trail', '--map-behind-3d'],
        ['--map-trail', '--map-given-free'],
        ...Object.keys(styles).filter((name) => name.startsWith('--frontier')).map((name) => [name, '--map-free'])];
      for (const [name, backName] of pairs) {
        const back = over(backName, free);
        for (const [sight, matrix] of Object.entries(kSights)) {
          const ratio = contrast(over(name, back), back, matrix);
          assert.ok(ratio >= 3, `${colorScheme}, ${sight}: ${name} on ${backName} is ${ratio.toFixed(2)}:1`);
        }
      }
      await page.context().close();
    }
    assert.ok(contrast(colorOf('#e3e7ec'), colorOf('#ffffff'), kSights.all) < 1.3, 'the colours of before would be found');
  },

  async 'no corner of a keep-out zone is dropped in silence'() {
    const page = await open(() => {}, { viewport: { width: 1180, height: 820 } });
    let answer = { accepted: false, reason: 'the vehicle is in it' };
    const sent = [];
    await page.route('**/api/keep_out', (route) => {
      sent.push(route.request().postDataJSON().corners_m.length);
      return route.fulfill({ json: answer });
    });
    const pen = page.locator('#keep-out');
    await page.locator('#zoom-out').tap();
    await pen.tap();
    const corners = [[0.5, 0.5], [1.5, 0.5], [1.5, 1.5], [0.5, 1.5]];
    const tap = async ([x, y]) => page.locator('#map').tap({ position: await onScreen(page, x, y) });
    await tap(corners[0]);
    await tap(corners[1]);
    await pen.tap();
    await page.getByText('Tap 1 more corner').waitFor();
    assert.equal(await pen.getAttribute('aria-pressed'), 'true');
    await tap(corners[2]);
    await pen.tap();
    await page.getByText('the vehicle is in it').waitFor();
    await page.getByText('The corners stay').waitFor();
    answer = { accepted: true, reason: '' };
    await tap(corners[3]);
    await pen.tap();
    await page.getByText('Keep-out zone set').waitFor();
    assert.deepEqual(sent, [3, 4]);
    await pen.tap();
    await tap(corners[0]);
    await pen.tap();
    await pen.tap();
    await page.getByText('Its one corner is forgotten').waitFor();
    assert.equal(await pen.getAttribute('aria-pressed'), 'false');
    return page;
  },

  'the table of fail-safes is there when it is opened': async () => {
    const page = await open();
    await page.locator('#failsafes summary').tap();
    const rows = page.locator('#failsafes li');
    await rows.first().waitFor();
    assert.match(await rows.first().innerText(), /^estimate diverged: motors off/);
    assert.ok(await rows.count() > 15);
    return page;
  },
};

const failed = await run(tests);
await browser.close();
await server.stop();
process.exit(failed ? 1 : 0);
