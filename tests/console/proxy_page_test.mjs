// The page behind proxies, in Chromium: node proxy_page_test.mjs WEB_FIXTURE WORK_FOLDER
import assert from 'node:assert/strict';

import { eventually, kPatience, launch, run, serve } from './browser.mjs';
import { certificate, startProxy } from './proxies.mjs';

const [fixture, folder] = process.argv.slice(2);
const browser = await launch(folder, '--host-resolver-rules=MAP *.example 127.0.0.1');
const tls = certificate(folder);

async function open(url, context) {
  context ??= await browser.newContext({ viewport: { width: 1180, height: 820 }, hasTouch: true, ignoreHTTPSErrors: true });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000 * kPatience);
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(error.message));
  await page.goto(String(url));
  return page;
}

const live = (page) => page.locator('#link[data-level=good]').waitFor();

/** A proxy with TLS, and behind each path a vehicle of its own whose token is `token-of-` and the number of the path. */
async function start(paths, { strips, login }) {
  const routes = Object.fromEntries(paths.map((path) => [path, 0]));
  const proxy = await startProxy({ tls, routes, strips, login });
  const outside = `https://field.example:${proxy.port}`, servers = [];
  for (const [i, path] of paths.entries()) {
    servers.push(await serve(fixture, 0, `token-of-${i}`, 'map3d', `${outside}${path}`));
    routes[path] = Number(servers.at(-1).url.port);
  }
  const stop = async () => {
    assert.deepEqual(proxy.missed, [], 'the page asked for addresses that are not below its own');
    proxy.close();
    for (const server of servers) await server.stop();
  };
  return { outside, servers, stop };
}

async function press(page, name) {
  const answer = page.waitForResponse((response) => response.url().endsWith(`/api/${name.toLowerCase()}`));
  await page.getByRole('button', { name, exact: true }).tap();
  return (await answer).status();
}

const tests = {};
for (const strips of [true, false])
  tests[`live state, camera, 3D map and commands below a path that is ${strips ? 'taken off' : 'left on'}`] = async () => {
    const { outside, servers, stop } = await start(['/a/swiftlet/'], { strips });
    // Without the last slash only the server can help, if it is told the path.
    const page = await open(`${outside}/a/swiftlet${strips ? '/' : ''}?token=token-of-0`);
    await live(page);
    assert.equal(page.url(), `${outside}/a/swiftlet/`, 'the token leaves the address, the path stays');
    await page.locator('#camera-toggle').tap();
    await eventually('a picture', () => page.locator('#camera img').getAttribute('src'));
    let points = 0;
    page.on('websocket', (socket) => socket.on('framereceived', () => { ++points; }));
    await page.locator('#show3d').tap();
    await eventually('points', () => points > 0);
    const direct = await open(servers[0].url);
    await live(direct);
    for (const tablet of [page, direct, page]) {
      assert.equal(await press(tablet, 'Hold'), 200);
      assert.equal(await press(tablet, 'Resume'), 200);
    }
    assert.deepEqual([...page.problems, ...direct.problems], []);
    await page.context().close();
    await direct.context().close();
    await stop();
  };

tests['a proxy that asks for a password of its own lets commands through'] = async () => {
  const { outside, stop } = await start(['/'], { strips: true, login: 'pilot:secret' });
  const context = await browser.newContext({ ignoreHTTPSErrors: true, httpCredentials: { username: 'pilot', password: 'secret' } });
  const page = await open(`${outside}/?token=token-of-0`, context);
  await live(page);
  const answer = page.waitForResponse((response) => response.url().endsWith('/api/hold'));
  await page.getByRole('button', { name: 'Hold', exact: true }).click();
  assert.equal((await answer).status(), 200);
  await context.close();
  await stop();
};

tests['vehicles below one host keep their tokens apart'] = async () => {
  const { outside, stop } = await start(['/robot1/', '/robot2/'], { strips: true });
  const page = await open(`${outside}/robot1/?token=token-of-0`);
  await live(page);
  await page.goto(`${outside}/robot2/?token=token-of-1`);
  await live(page);
  assert.equal(await press(page, 'Hold'), 200);
  await page.goto(`${outside}/robot1/`);
  await live(page);
  assert.equal(await press(page, 'Hold'), 200);
  await page.context().close();
  await stop();
};

tests['a page by another name of the proxy is live for nobody and commands nothing'] = async () => {
  const { outside, stop } = await start(['/'], { strips: true });
  const page = await open(`${outside.replace('field.example', 'evil.example')}/?token=token-of-0`);
  const status = await page.evaluate(async () => {
    const headers = { Authorization: 'Bearer token-of-0' };
    return (await fetch('api/land', { method: 'POST', headers })).status;
  });
  assert.equal(status, 403);
  const socket = await page.evaluate(() => new Promise((done) => {
    const tried = new WebSocket(new URL('api/ws', location.href.replace('https', 'wss')));
    tried.onopen = () => done('open');
    tried.onclose = () => done('closed');
  }));
  assert.equal(socket, 'closed');
  await page.context().close();
  await stop();
};

const failed = await run(tests);
await browser.close();
process.exit(failed ? 1 : 0);
