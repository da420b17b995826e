// Takes page.jpg, map3d.jpg, first_flight.png and report.jpg anew, from two flights in the simulator:
//   node docs/images/take_pictures.mjs build/release/swiftlet build/release/console
import { writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';

import { eventually, launch, start } from '../../tests/console/browser.mjs';

const [swiftlet, folder] = process.argv.slice(2);
const run = join(folder, 'pictures-run');
const kPatience_s = 1200;
const browser = await launch(folder);
const fly = (...more) => start(swiftlet, ['fly', ...more, '--speed', '1', '--port', '0', '--out', run]);
const stateOf = async (url) => (await fetch(`${url.origin}/api/state`)).json();
const flownFor = (url, time_s) => eventually('the flight', async () => (await stateOf(url)).stamp_s > time_s, kPatience_s);
const { url, ended } = await fly('missions/map_room_3d.xml', '--world', 'worlds/unb_map3d.sdf', '--system', 'swiftlet_3d', '--seed', '3');

const take = (page, name, more = {}) => page.screenshot({ path: join('docs/images', name), type: 'jpeg', quality: 85, ...more });
async function open(address) {
  const page = await (await browser.newContext({ viewport: { width: 1180, height: 760 }, hasTouch: true, colorScheme: 'light' })).newPage();
  await page.goto(String(address));
  return page;
}

const page = await open(url);
await page.locator('#link[data-level=good]').waitFor();
await flownFor(url, 25);
await page.locator('#camera-toggle').tap();
await page.waitForTimeout(3000);
await take(page, 'page.jpg');

await flownFor(url, 55);
await page.locator('#show3d').tap();
await eventually('the points', () => page.locator('#map3d canvas').evaluate((canvas) => Number(canvas.dataset.points ?? 0) > 20_000), kPatience_s);
await page.waitForTimeout(3000);
await take(page, 'map3d.jpg', { clip: await page.locator('#map3d').boundingBox() });

await ended;
const first = await fly('missions/explore_and_return.xml', '--seed', '7');
await flownFor(first.url, 22);
const picture = await fetch(`${first.url.origin}/api/map.png?width=960&height=720`);
writeFileSync('docs/images/first_flight.png', Buffer.from(await picture.arrayBuffer()));
await first.ended;
await take(await open(`file://${resolve(run, 'report.html')}`), 'report.jpg');
await browser.close();
