// The operator's page: wires the link, the map, the panels and the commands.
import { Alarms } from './alarms.js';
import { Commands } from './commands.js';
import { showFailsafesOnDemand } from './failsafes.js';
import { GivenMapPanel } from './given_map_panel.js';
import { KeepOutPen } from './keep_out.js';
import { Link } from './link.js';
import { Map3dPanel } from './map3d_panel.js';
import { MapStore } from './map_store.js';
import { MapView } from './map_view.js';
import { endText, fliesItsOwnGoals, hasEnded, isObeyed } from './mission.js';
import { MissionTree } from './tree.js';
import { MissionsCard } from './missions.js';
import { PictureStream } from './picture_stream.js';
import { forgetEvents, showAge, showEvents, showFrontiers, showState, toast } from './panels.js';
import { guardTaps } from './tap_guard.js';
import { forVehicle, offerVehicles } from './vehicle.js';

const element = (id) => document.getElementById(id);
const commands = new Commands();
const store = new MapStore();
const tree = new MissionTree(element('tree'));
const missions = new MissionsCard(element('missions'), commands, showAnswer);
const buttons = [...document.querySelectorAll('[data-command]')];

const view = new MapView(element('map'), store, {
  onTap: (place) => pen.tap(place) || sendGoal(place),
  onMode: () => showMode(),
  onFrame: (frame) => {
    element('given-legend').hidden = frame !== 'given';
    element('event-frame').hidden = frame !== 'given';
    pen.forget();
  },
});

const pen = new KeepOutPen(element('keep-out'), { onChange: () => view.draw(), send: sendZone,
  say: (title, text) => toast(title, text, false) });
view.pen = pen;

showFailsafesOnDemand(element('failsafes'));

const given = new GivenMapPanel(element('given-card'), store);

const map3d = new Map3dPanel(element('map3d'), store, (path) => commands.withToken(path));

const alarms = new Alarms(element('alarms'), element('mute'), ({ alarm, text, reason, vehicle }) => (
  { title: [vehicle, alarm].filter(Boolean).join(': '), detail: [text !== alarm && text, reason].filter(Boolean).join(': ') }));

let greeted = false; // At the first connection.

const link = new Link((message) => {
  store.take(message);
  if (message.type === 'hello') {
    element('title').textContent = message.title;
    document.title = message.title ? `${message.title} – Swiftlet` : 'Swiftlet';
    offerVehicles(element('vehicle'), message.vehicles ?? [], message.vehicle);
    forgetEvents();
    if (greeted) map3d.reconnect();
    greeted = true;
    commands.check().then(showAccess).then(() => missions.load()).then(showAccess);
  }
  if (message.type === 'state') {
    showState(message);
    tree.tell(message.stamp_s);
    if (element('mission-name').textContent !== message.mission.name) element('mission-name').textContent = message.mission.name;
    element('clear-keep-out').hidden = message.keep_out.length === 0;
    showQuestion(message.mission.question);
    offer3d(message.map3d !== null);
    for (const button of document.querySelectorAll('.commands [aria-pressed]'))
      button.setAttribute('aria-pressed', String(isObeyed(button.dataset.command, message)));
  }
  if (message.type === 'hello' || message.type === 'state') showAccess();
  if (message.type === 'frontiers') showFrontiers(message.frontiers, store.shown().T_shown_map);
  if (message.type === 'tree') tree.take(message);
  if (message.type === 'events') {
    showEvents(message.events);
    alarms.take(message.events);
  }
  view.draw();
  given.draw();
  map3d.draw();
}, (path) => commands.withToken(path));

// --- commands -----------------------------------------------------------------------------------------------------

const ended = () => store.state !== null && hasEnded(store.state);
const takesGoals = () => store.state === null || !fliesItsOwnGoals(store.state);

function disable(control, disabled, why) {
  if (control.disabled !== disabled) control.disabled = disabled;
  if (control.title !== why) control.title = why;
}

function showAccess() {
  element('access').hidden = commands.allowed;
  element('access').textContent = commands.refused ? 'View only: wrong or old token' : 'View only';
  const nothing = !commands.allowed || ended();
  const noGoals = nothing || !takesGoals();
  const why = takesGoals() ? '' : kOwnGoals;
  for (const button of buttons) disable(button, nothing, '');
  for (const control of element('goal-form').elements) disable(control, noGoals, why);
  view.canvas.classList.toggle('no-goals', noGoals);
  missions.allow(!nothing, store.state !== null && ['running', 'held'].includes(store.state.mission.state));
  disable(element('keep-out'), nothing, nothing ? '' : kDraw);
}

const kDraw = 'Tap the corners of a keep-out zone, then press again.';
const kOwnGoals = 'This mission flies its own goals.';
const kNoToken = 'Open the operator’s link, printed when the flight starts, to send goals.';
const kOldToken = 'The token of this page is wrong, or of an earlier start: open the newest operator’s link.';
const kTitles = { hold: 'Holding', resume: 'Resumed', home: 'Flying home', land: 'Landing', go_on: 'Going on',
  clear_keep_out: 'Zones cleared' };

/** A command that is not accepted is shown long enough to be read; "refused" appears only after an answer. */
function showAnswer(name, title, { outcome, reason }) {
  if (outcome === 'accepted') toast(title, reason, true);
  else toast(outcome === 'refused' ? `${name} refused` : `${name}: no answer`, commands.refused ? kOldToken : reason, false);
  showAccess();
}

async function sendGoal(goal) {
  const where = `(${goal.x_m.toFixed(2)}, ${goal.y_m.toFixed(2)})${view.frameShown === 'given' ? ' in the given map' : ''}`;
  if (!commands.allowed) {
    toast('View only', commands.refused ? kOldToken : kNoToken, false);
    return;
  }
  if (ended()) return;
  if (!takesGoals()) {
    toast('No goal sent', kOwnGoals, false);
    return;
  }
  view.showMarker({ ...goal, state: 'asked' });
  const answer = await commands.give('goal', { ...goal, frame: view.frameShown });
  view.showMarker(answer.outcome === 'refused' ? { ...goal, state: 'refused' } : null);
  if (answer.outcome === 'accepted') answer.reason = [where, answer.reason].filter(Boolean).join(', ');
  showAnswer('Goal', 'Goal accepted', answer);
}

async function sendZone(corners_m) {
  const answer = await commands.give('keep_out', { corners_m, frame: view.frameShown });
  showAnswer('Keep-out zone', 'Keep-out zone set', answer);
  return answer.outcome === 'accepted';
}

/** What the mission waits for the operator to confirm. */
function showQuestion(question) {
  element('question').hidden = !question;
  if (element('question-text').textContent !== question) element('question-text').textContent = question;
}

for (const button of buttons) {
  const { command } = button.dataset;
  button.addEventListener('click', async () => {
    button.setAttribute('aria-busy', 'true');
    const answer = await commands.give(command);
    button.removeAttribute('aria-busy');
    showAnswer(button.textContent.trim() || button.ariaLabel, kTitles[command], answer);
  });
}

element('goal-form').addEventListener('submit', (event) => {
  event.preventDefault();
  sendGoal({ x_m: element('goal-x').valueAsNumber, y_m: element('goal-y').valueAsNumber });
});

// --- the map's tools and the camera -------------------------------------------------------------------------------

/** The tools work on the map that is shown. */
const zoom = (factor) => (map3d.open ? map3d.orbit.zoom(factor) : view.zoom(factor));
element('zoom-in').addEventListener('click', () => zoom(1.4));
element('zoom-out').addEventListener('click', () => zoom(1 / 1.4));
element('fit').addEventListener('click', () => (map3d.open ? map3d.orbit.setKind('whole') : view.setMode('fit')));
element('follow').addEventListener('click', () => {
  if (map3d.open) map3d.orbit.setKind(map3d.orbit.kind === 'follow' ? 'orbit' : 'follow');
  else view.setMode(view.mode === 'follow' ? 'free' : 'follow');
});

function showMode() {
  const mode = map3d.open ? { whole: 'fit', follow: 'follow' }[map3d.orbit.kind] : view.mode;
  element('fit').setAttribute('aria-pressed', String(mode === 'fit'));
  element('follow').setAttribute('aria-pressed', String(mode === 'follow'));
}
map3d.onMode = showMode;

element('show3d').addEventListener('click', () => {
  if (map3d.open) map3d.hide();
  else map3d.show();
  element('show3d').setAttribute('aria-pressed', String(map3d.open));
  element('by-normal').hidden = !map3d.open;
  showMode();
});
element('by-normal').addEventListener('click', ({ currentTarget: button }) => {
  map3d.setByNormal(!map3d.byNormal);
  button.setAttribute('aria-pressed', String(map3d.byNormal));
});

/** A vehicle without an RGB-D camera has neither a 3D map nor depth images. */
function offer3d(available) {
  element('show3d').hidden = !available;
  element('depth-card').hidden = !available;
}

/** A card whose button shows and hides a stream. Without the stream nothing is requested, and a camera is not rendered. */
function offerStream(name, alt, path, age_s) {
  const box = element(name);
  let stream = null;
  element(`${name}-toggle`).addEventListener('click', ({ currentTarget: button }) => {
    const shown = button.getAttribute('aria-expanded') === 'true';
    button.setAttribute('aria-expanded', String(!shown));
    button.textContent = shown ? 'Show' : 'Hide';
    box.hidden = shown;
    stream?.stop();
    stream = shown ? null : new PictureStream(box, alt, () => commands.withToken(forVehicle(`${path}?width=480&fps=10&t=${Date.now()}`)), age_s);
  });
}

offerStream('camera', 'Picture of the onboard camera', 'stream/camera.mjpg', () => store.state?.camera_age_s ?? null);
offerStream('depth', 'Picture of the depth camera, near in red, far in blue', 'stream/depth.mjpg', () => store.state?.depth_age_s ?? null);

// --- how old is what is shown -------------------------------------------------------------------------------------

/** Age of the last state, on its way and here; null before the first. */
const dataAge_s = () => (store.state ? store.state.age_s + (performance.now() - store.stateReceived_ms) / 1000 : null);

/** {level, text} of the pill, and {banner} over the map. */
function linkNow() {
  if (ended()) return { level: 'wait', text: 'Ended', banner: endText(store.state) };
  const silence = link.silence_s();
  if (silence === null) return { level: 'wait', text: 'Connecting' };
  if (silence > 1.5) {
    const seconds = `${silence.toFixed(0)} s`;
    return { level: 'bad', text: `No link for ${seconds}`,
      banner: `Link lost ${seconds} ago. The map shows the last known state.` };
  }
  if (!store.state) return { level: 'wait', text: 'Waiting for the vehicle' };
  const age = dataAge_s();
  if (age > 1.5) {
    const seconds = `${age.toFixed(0)} s`;
    return { level: 'warn', text: `No data for ${seconds}`, banner: `The vehicle has sent nothing for ${seconds}.` };
  }
  return { level: 'good', text: 'Live' };
}

function showLink() {
  if (!ended()) showAge(dataAge_s());
  const { level, text, banner = '' } = linkNow();
  const pill = element('link'), over = element('banner');
  if (pill.dataset.level !== level) pill.dataset.level = level;
  if (pill.textContent !== text) pill.textContent = text;
  over.hidden = !banner;
  if (over.dataset.level !== level) over.dataset.level = level;
  if (over.textContent !== banner) over.textContent = banner;
  document.body.classList.toggle('stale', level === 'bad' || level === 'warn');
}

guardTaps([...document.querySelectorAll('.notices > *, #clear-keep-out')]);
showAccess();
setInterval(showLink, 250);
