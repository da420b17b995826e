// A mission that is chosen on the page loads a map of its own, and a goal is tapped in that map: the real program and the
// page in Chromium. node map_flight_test.mjs SWIFTLET WORK_FOLDER
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { eventually, kPatience, launch, onScreen, start } from './browser.mjs';

const [swiftlet, work] = process.argv.slice(2);
const browser = await launch(work);
const folder = join(work, 'map-flight');
rmSync(folder, { recursive: true, force: true });
mkdirSync(join(folder, 'missions'), { recursive: true });

const mission = (leaves) => `<root BTCPP_format="4" main_tree_to_execute="M"><BehaviorTree ID="M"><Priority><AvoidObstacle/>
  <Hold/><Sequence>${leaves}</Sequence></Priority></BehaviorTree></root>`;
const write = (name, text) => writeFileSync(join(folder, 'missions', name), text);
const options = { cwd: folder };

// The map of one flight, in whose frame the hall stands as it stood then.
write('first.xml', mission('<TakeOff/><FollowPath points="3.8;0.6 | 4.2;-2.5 | 1.5;-3.2"/><Land/>'));
execFileSync(swiftlet, ['fly', 'missions/first.xml', '--headless', '--seed', '11', '--out', 'missions/hall'],
  { ...options, stdio: 'ignore' });

// Missions of the folder that `fly` offers; the one that it begins with loads nothing.
write('explore_and_return.xml', mission('<TakeOff/><Land/>'));
write('in_the_map.xml', mission('<LoadMap file="hall/map.yaml"/><TakeOff/><Localize/><OperatorCommand/>'));
write('no_map.xml', mission('<LoadMap file="nowhere.yaml"/><TakeOff/><Localize/><Land/>'));
writeFileSync(join(folder, 'missions', 'grey.pgm'), Buffer.concat([Buffer.from('P5\n4 4\n255\n'), Buffer.alloc(16, 0xcd)]));
write('grey.yaml', readFileSync(join(folder, 'missions', 'hall', 'map.yaml'), 'utf8').replace('map.pgm', 'grey.pgm'));
write('grey_map.xml', mission('<LoadMap file="grey.yaml"/><TakeOff/><Localize/><Land/>'));

// Another start than the first one's, facing elsewhere.
writeFileSync(join(folder, 'start.yaml'), `mission: missions/explore_and_return.xml
scenario:
  world: worlds/unb_case1.sdf
  start: {from_world: false, x_m: 6.2, y_m: 5.6, yaw_deg: -120}
`);
const flight = await start(swiftlet, ['fly', 'missions/explore_and_return.xml', '--scenario', 'start.yaml', '--wait', '--seed',
  '12', '--speed', '5', '--port', '0', '--time-limit', '600', '--out', 'run'], options);
const headers = { Authorization: `Bearer ${flight.url.searchParams.get('token')}` };
const state = async () => (await fetch(`${flight.url.origin}/api/state`)).json();
const startMission = async (file) => (await fetch(`${flight.url.origin}/api/mission`, { method: 'POST', headers,
  body: JSON.stringify({ file }) })).json();

try {
  const offered = await (await fetch(`${flight.url.origin}/api/missions`, { headers })).json();
  const file = (name) => offered.find((one) => one.name === name).file;
  await eventually('the wait', async () => (await state()).mission?.phase === 'wait for a mission');

  const missing = await startMission(file('no_map'));
  assert.equal(missing.accepted, false);
  assert.match(missing.reason, /nowhere\.yaml/);
  const unusable = await startMission(file('grey_map'));
  assert.equal(unusable.accepted, false);
  assert.match(unusable.reason, /grey\.yaml.*no free cells/);
  assert.equal((await state()).mission.state, 'ready', 'nothing was flown');

  const context = await browser.newContext({ viewport: { width: 1180, height: 900 }, hasTouch: true });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000 * kPatience);
  await page.goto(String(flight.url));
  const started = await startMission(file('in_the_map'));
  assert.equal(started.accepted, true, started.reason);
  await page.locator('#given-legend').waitFor(); // It knows its place, and the page shows the frame of the map.
  await eventually('the hold', async () => (await state()).mission.phase === 'hold');

  await page.locator('#zoom-out').tap();
  const goal = { x_m: 2.0, y_m: -2.5 };
  const answer = page.waitForResponse((response) => response.url().endsWith('/api/goal'));
  await page.locator('#map').tap({ position: await onScreen(page, goal.x_m, goal.y_m) });
  const said = await (await answer).json();
  assert.equal(said.accepted, true, said.reason);
  await eventually('the arrival in the map', async () => {
    const { localization, mission } = await state();
    return mission.phase === 'hold' && localization.state === 'localized' && Math.hypot(localization.x_m - goal.x_m, localization.y_m - goal.y_m) < 0.2;
  });
  await page.screenshot({ path: `${work}/map_flight.png` });
  await fetch(`${flight.url.origin}/api/land`, { method: 'POST', headers });
  await flight.ended;
  const events = readFileSync(join(folder, 'run', 'events.jsonl'), 'utf8');
  assert.match(events, /map hall\/map\.yaml is the given one/);
  assert.match(events, /goal \([\d.]+, -[\d.]+\) in the given map reached/);
  console.log('1 passed, 0 failed');
} finally {
  flight.child.kill('SIGTERM');
  await browser.close();
}
