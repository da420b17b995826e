// Takes page.jpg, map3d.jpg and report.jpg anew, from two flights in the simulator:
//   node docs/images/take_pictures.mjs build/release/swiftlet build/release/console
import { execFileSync } from 'node:child_process';
import { join, resolve } from 'node:path';

import { eventually, launch, start } from '../../tests/console/browser.mjs';

const [swiftlet, folder] = process.argv.slice(2);
const run = join(folder, 'pictures-run');
const kPatience_s = 1200;
const browser = await launch(folder);
const { url, ended } = await start(swiftlet, ['fly', 'missions/map_room_3d.xml', '--world', 'worlds/unb_map3d.sdf', '--system', 'swiftlet_3d',
  '--seed', '3', '--speed', '1', '--port', '0', '--out', run]);
const state = async () => (await fetch(`${url.origin}/api/state`)).json();

const take = (page, name, more = {}) => page.screenshot({ path: join('docs/images', name), type: 'jpeg', quality: 85, ...more });
async function open(address) {
  const page = await (await browser.newContext({ viewport: { width: 1180, height: 760 }, hasTouch: true, colorScheme: 'light' })).newPage();
  await page.goto(String(address));
  return page;
}

const page = await open(url);
await page.locator('#link[data-level=good]').waitFor();
await eventually('the flight', async () => (await state()).stamp_s > 25, kPatience_s);
await page.locator('#camera-toggle').tap();
await page.waitForTimeout(3000);
await take(page, 'page.jpg');

await eventually('most of the map', async () => (await state()).stamp_s > 55, kPatience_s);
await page.locator('#show3d').tap();
await eventually('the points', () => page.locator('#map3d canvas').evaluate((canvas) => Number(canvas.dataset.points ?? 0) > 20_000), kPatience_s);
await page.waitForTimeout(3000);
await take(page, 'map3d.jpg', { clip: await page.locator('#map3d').boundingBox() });

await ended;
execFileSync(swiftlet, ['fly', 'missions/explore_and_return.xml', '--headless', '--seed', '7', '--out', run]);
await take(await open(`file://${resolve(run, 'report.html')}`), 'report.jpg');
await browser.close();
