// A mission is started on the page, another one takes its place in flight, and it is stopped: the real program, by HTTP.
// node mission_flight_test.mjs SWIFTLET WORK_FOLDER
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';

import { eventually, start } from './browser.mjs';

const [swiftlet, folder] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });

const flight = await start(swiftlet, ['fly', 'missions/patrol.xml', '--wait', '--seed', '11', '--speed', '5', '--port', '0',
  '--time-limit', '600', '--out', `${folder}/mission-run`]);
const token = flight.url.searchParams.get('token');
const state = async () => (await fetch(`${flight.url.origin}/api/state`)).json();
const headers = { Authorization: `Bearer ${token}` };
const post = async (name, body) =>
  (await fetch(`${flight.url.origin}/api/${name}`, { method: 'POST', headers, body: body && JSON.stringify(body) })).json();
const mission = async () => (await state()).mission ?? {}; // There is none before the first state.

try {
  const offered = await (await fetch(`${flight.url.origin}/api/missions`, { headers })).json();
  const file = (name) => offered.find((one) => one.name === name).file;
  assert.equal(offered[0].name, 'patrol');
  const takeOff = offered.find(({ name }) => name === 'operator_goals').parameters.find(({ port }) => port === 'height_m');
  assert.equal(takeOff.value, '1.0');

  await eventually('the wait', async () => (await mission()).phase === 'wait for a mission');
  await new Promise((done) => setTimeout(done, 2000)); // Ten seconds of flight time.
  assert.equal((await mission()).state, 'ready');
  assert.ok((await state()).pose.z_m < 0.2, 'it stands');

  const wrong = await post('mission', { file: file('operator_goals'), parameters: { [takeOff.key]: '0.1' } });
  assert.equal(wrong.accepted, false);
  assert.match(wrong.reason, /`0.1` is out of range/);
  assert.equal((await post('mission', { file: '/etc/passwd' })).accepted, false);
  assert.equal((await mission()).state, 'ready');

  const started = await post('mission', { file: file('operator_goals'), parameters: { [takeOff.key]: '1.3' } });
  assert.deepEqual([started.accepted, started.reason], [true, '']);
  await eventually('the take-off', async () => (await state()).flight_state === 'flying');
  await eventually('the height', async () => Math.abs((await state()).pose.z_m - 1.3) < 0.15);
  assert.equal((await mission()).name, 'OperatorGoals');

  const other = await post('mission', { file: file('explore_and_return') });
  assert.deepEqual([other.accepted, other.reason], [true, 'when the vehicle has stopped']);
  await eventually('the other mission', async () => (await mission()).phase === 'explore');
  assert.equal((await mission()).name, 'ExploreAndReturn');
  const tree = (await mission()).tree;
  assert.equal(tree.find(({ type }) => type === 'Explore').status, 'RUNNING');

  assert.equal((await post('stop')).accepted, true);
  await eventually('the stop', async () => (await mission()).state === 'ready' && (await state()).speed_m_s < 0.1);
  assert.equal((await state()).flight_state, 'flying');
  assert.equal((await post('stop')).accepted, false);

  assert.equal((await post('land')).accepted, true);
  const { code } = await flight.ended;
  assert.equal(code, 1, 'a flight that the operator lands is stopped');
  console.log('1 passed, 0 failed');
} finally {
  flight.child.kill('SIGTERM');
}
