// What the page says when the link, the server or the token is not what it should be, against a made-up flight:
// node link_test.mjs WEB_FIXTURE WORK_FOLDER
import assert from 'node:assert/strict';
import { connect, createServer } from 'node:net';

import { eventually, kPatience, launch, run, serve } from './browser.mjs';

const [fixture, folder] = process.argv.slice(2);
const browser = await launch(folder);

async function open(url) {
  const context = await browser.newContext({ viewport: { width: 1180, height: 820 }, hasTouch: true });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000 * kPatience);
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(error.message));
  await page.goto(String(url));
  return page;
}

const live = (page) => page.locator('#link[data-level=good]').waitFor();
const grey = (page, selector) => page.locator(selector).evaluate((node) => getComputedStyle(node).filter.includes('grayscale'));

/** A link to the server that can be cut as a radio link is: nothing is closed, and nothing arrives. */
async function radio(port) {
  let cut = false;
  const ends = new Set();
  const listener = createServer((near) => {
    const far = connect(port, '127.0.0.1');
    for (const [from, to] of [[near, far], [far, near]]) {
      ends.add(from);
      if (cut) from.pause();
      from.on('data', (bytes) => to.write(bytes));
      from.on('close', () => { ends.delete(from); if (!cut) to.destroy(); });
      from.on('error', () => {});
    }
  });
  await new Promise((done) => listener.listen(0, '127.0.0.1', done));
  return {
    port: listener.address().port,
    cut(now) {
      cut = now;
      for (const end of ends) if (now) end.pause(); else end.resume();
    },
    /** What is connected now is dead from now on; new connections work. */
    lose() {
      for (const end of ends) end.pause().removeAllListeners('close');
    },
    close() {
      listener.close();
      for (const end of ends) end.destroy();
    },
  };
}

const tests = {
  async 'a link that is cut for 20 s is shown as lost, and map and camera come back by themselves'() {
    const server = await serve(fixture);
    const link = await radio(Number(server.url.port));
    const url = new URL(server.url);
    url.port = link.port;
    const page = await open(url);
    await live(page);
    await page.locator('#camera-toggle').tap();
    const picture = () => page.locator('#camera img').getAttribute('src');
    await eventually('a picture', picture);

    link.cut(true);
    await page.getByText('Link lost').waitFor();
    for (const selector of ['#map', 'aside', '.commands']) assert.ok(await grey(page, selector), `${selector} is not grey`);
    await page.locator('#camera.stale').waitFor();
    const age_s = async () => {
      const [value, unit] = (await page.locator('#age').innerText()).split(' ');
      return unit === 's' ? Number(value) : Number(value) / 1000;
    };
    const young_s = await age_s();
    await page.waitForTimeout(18_000);
    assert.ok((await age_s()) > young_s + 15, 'the age of the data does not grow');
    await page.locator('.picture-age').getByText(/^1\d s old$|^2\d s old$/).waitFor();
    await page.getByRole('button', { name: 'Hold' }).tap();
    await page.getByText('Hold: no answer').waitFor({ timeout: 4000 * kPatience });
    const frozen = await picture();

    link.cut(false);
    await live(page);
    assert.equal(await grey(page, '#map'), false);
    await eventually('a new picture', async () => (await picture()) !== frozen, 20);
    await page.locator('#camera:not(.stale)').waitFor();
    await page.locator('.picture-age').getByText(/^0\.\d s$/).waitFor();
    link.close();
    await page.context().close();
    await server.stop();
  },

  async 'the 3D map comes by a new connection where the old one has died without a word'() {
    const server = await serve(fixture, 0, 'operator-token', 'map3d');
    const link = await radio(Number(server.url.port));
    const url = new URL(server.url);
    url.port = link.port;
    const page = await open(url);
    await live(page);
    let received = 0;
    page.on('websocket', (socket) => {
      if (socket.url().includes('/api/map3d')) socket.on('framereceived', () => { ++received; });
    });
    await page.locator('#show3d').tap();
    await eventually('points', () => received > 0);
    link.lose();
    await page.getByText('Link lost').waitFor();
    await live(page);
    received = 0;
    await eventually('points again', () => received > 5, 20);
    link.close();
    await page.context().close();
    await server.stop();
  },

  async 'after a restart on the same port the old token is noticed, and the camera comes back'() {
    let server = await serve(fixture);
    const port = Number(server.url.port);
    const page = await open(server.url);
    await live(page);
    await page.locator('#camera-toggle').tap();
    await eventually('a picture', () => page.locator('#camera img').getAttribute('src'));
    await server.stop();
    await page.getByText('Link lost').waitFor();
    await page.locator('#camera.stale').waitFor();
    server = await serve(fixture, port, 'token-of-another-start');
    await live(page);
    await page.getByText('View only: wrong or old token').waitFor();
    for (const name of ['Hold', 'Resume', 'Home', 'Land'])
      assert.equal(await page.getByRole('button', { name }).isDisabled(), true);
    await page.locator('#camera:not(.stale)').waitFor();
    await page.locator('.picture-age').getByText(/^0\.\d s$/).waitFor();
    await page.context().close();
    await server.stop();
  },

  async 'a wrong token is noticed when the page is opened'() {
    const server = await serve(fixture);
    const url = new URL(server.url);
    url.searchParams.set('token', 'a-wrong-token');
    const page = await open(url);
    await live(page);
    await page.getByText('View only: wrong or old token').waitFor();
    assert.equal(await page.getByRole('button', { name: 'Land' }).isDisabled(), true);
    await page.context().close();
    await server.stop();
  },

  async 'a vehicle that does not answer has not refused'() {
    const server = await serve(fixture, 0, 'operator-token', 'silent');
    const page = await open(server.url);
    await live(page);
    const begin = Date.now();
    await page.getByRole('button', { name: 'Hold' }).tap();
    await page.getByText('Hold: no answer').waitFor();
    assert.ok(Date.now() - begin < 3000 * kPatience, 'it took too long to say so');
    assert.equal(await page.getByText('refused').count(), 0);
    await page.context().close();
    await server.stop();
  },

  async '300 viewers lock the operator out of nothing'() {
    const server = await serve(fixture);
    const viewers = [], answers = [];
    for (let i = 0; i < 300; ++i) {
      const viewer = connect(Number(server.url.port), '127.0.0.1');
      viewer.on('error', () => {});
      const path = i % 2 ? '/stream/map.mjpg?width=160&fps=5' : '/stream/camera.mjpg?width=160&fps=5';
      viewer.write(`GET ${path} HTTP/1.1\r\nHost: localhost\r\n\r\n`);
      answers.push(await new Promise((done) => viewer.once('data', (bytes) => done(String(bytes).slice(0, 12)))));
      viewer.on('data', () => {});
      viewers.push(viewer);
    }
    assert.equal(answers.filter((answer) => answer.endsWith('200')).length, 256);
    assert.match(answers.at(-1), /503/);
    const page = await open(server.url);
    await live(page);
    await page.locator('#camera-toggle').tap();
    await eventually('a picture', () => page.locator('#camera img').getAttribute('src'));
    for (const name of ['Hold', 'Land']) {
      const answer = page.waitForResponse((response) => response.url().endsWith(`/api/${name.toLowerCase()}`));
      const begin = Date.now();
      await page.getByRole('button', { name }).tap();
      assert.equal((await answer).status(), 200, name);
      assert.ok(Date.now() - begin < 1500 * kPatience, `${name} took ${Date.now() - begin} ms`);
    }
    for (const viewer of viewers) viewer.destroy();
    await page.context().close();
    await server.stop();
  },
};

const failed = await run(tests);
await browser.close();
process.exit(failed ? 1 : 0);
