// The figures and lists beside the map.
import { hasEnded, reasonText } from './mission.js';
import { moved } from './pose2.js';

const element = (id) => document.getElementById(id);

function setText(id, text) {
  const node = element(id);
  if (node.textContent !== text) node.textContent = text;
}

function make(tag, properties = {}, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
}

const withUnit = (value, decimals, unit) => (value === null || value === undefined ? '–' : `${value.toFixed(decimals)} ${unit}`);

function clockText(seconds) {
  const whole = Math.max(0, Math.floor(seconds));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}`;
}

function placeText({ state, x_m, y_m }) {
  return state === 'localized' ? `(${x_m.toFixed(1)}, ${y_m.toFixed(1)}) m` : state;
}

/** What controls the vehicle instead of the mission, as a chip. */
const kFliers = { operator: ['operator', 'chip'], supervisor: ['supervisor', 'chip bad'], pilot: ['pilot', 'chip warn'] };

export function showState(state) {
  const { flight_state: flight, mission, avoidance } = state;
  const [flier, flierClass] = kFliers[mission.flown_by] ?? ['', 'chip'];
  setText('flown-by', flier);
  element('flown-by').className = flierClass;
  element('flown-by').hidden = !flier || hasEnded(state);
  setText('flight-state', flight);
  element('flight-state').className = flight.startsWith('emergency') ? 'chip bad' : 'chip';
  setText('mission-state', mission.state);
  element('mission-state').className =
    { failed: 'chip bad', held: 'chip warn', done: 'chip' }[mission.state] ?? 'chip soft';
  const reacts = hasEnded(state) ? '' : avoidance.retreating ? 'retreating' : avoidance.braking ? 'braking' : '';
  setText('avoidance', reacts);
  element('avoidance').hidden = !reacts;
  setText('phase', mission.phase || '–');
  setText('intent', reasonText(state, reacts));

  const { remaining, voltage_v } = state.battery;
  setText('battery', remaining === null ? '–' : `${Math.round(100 * remaining)} % · ${withUnit(voltage_v, 1, 'V')}`);
  const meter = element('battery-meter');
  meter.style.setProperty('--share', remaining ?? 0);
  meter.setAttribute('aria-valuenow', Math.round(100 * (remaining ?? 0)));
  meter.dataset.level = remaining < 0.15 ? 'empty' : remaining < 0.3 ? 'low' : 'good';
  setText('explored', withUnit(state.explored_area_m2, 1, 'm²'));
  element('given-map').hidden = !state.localization;
  if (state.localization) setText('given-place', placeText(state.localization));
  element('octree').hidden = !state.map3d;
  if (state.map3d) setText('octree-age', state.map3d.fused_age_s === null ? 'none yet' : `${state.map3d.fused_age_s.toFixed(1)} s old`);
  setText('time', clockText(state.stamp_s));
  setText('flown', withUnit(state.distance_flown_m, 1, 'm'));
  setText('speed', withUnit(state.speed_m_s, 2, 'm/s'));
  setText('height', withUnit(state.pose.z_m, 2, 'm'));
  setText('deviation', state.horizontal_valid ? withUnit(100 * state.position_deviation_m, 0, 'cm') : 'lost');
  setText('left', state.battery.left_s === null ? '–' : `${(state.battery.left_s / 60).toFixed(1)} min`);
  setText('margin', withUnit(state.thrust_margin, 2, '×'));
  setText('drift', withUnit(state.drift_m, 2, 'm'));
  setText('realtime', state.realtime_factor === null ? '–' : `${state.realtime_factor.toFixed(1)} ×`);
}

/** The age of the whole state; it grows while no state arrives. */
export function showAge(age_s) {
  setText('age', age_s === null ? '–' : age_s < 10 ? `${Math.round(1000 * age_s)} ms` : `${age_s.toFixed(0)} s`);
}

/** The places are shown in the frame of the map beside. */
export function showFrontiers(frontiers, T_shown_map) {
  const count = (wanted) => frontiers.filter(({ reason }) => reason === wanted).length;
  const open = count('open'), blocked = count('blocked');
  const parts = [`${open} open`, ...(blocked ? [`${blocked} blocked`] : []), `${frontiers.length - open - blocked} left out`];
  setText('frontier-count', frontiers.length === 0 ? 'none' : parts.join(', '));
  const rows = frontiers.map(({ reason, explanation, centroid_m, length_m }) => {
    const [x, y] = moved(T_shown_map, centroid_m);
    return make('li', {}, make('i', { className: `dot ${reason.replaceAll(' ', '-')}`, title: reason }),
      make('span', { textContent: `${explanation || reason} · ${length_m.toFixed(1)} m at (${x.toFixed(1)}, ${y.toFixed(1)})` }));
  });
  element('frontiers').replaceChildren(...(rows.length ? rows : [make('li', { className: 'empty', textContent: 'None.' })]));
}

let lastEvent = 0;

/** A new connection sends them all again. */
export function forgetEvents() {
  lastEvent = 0;
  element('events').replaceChildren();
}

export function showEvents(events) {
  const list = element('events');
  for (const { number, stamp_s, severity, source, text, reason } of events) {
    if (number <= lastEvent) continue;
    lastEvent = number;
    const words = make('div', {}, make('b', { textContent: text }), make('small', { textContent: reason ? `${source}: ${reason}` : source }));
    const row = make('li', {}, make('time', { textContent: clockText(stamp_s) }), words);
    row.dataset.severity = severity;
    list.prepend(row);
  }
  while (list.children.length > 200) list.lastChild.remove();
}

let press = null; // Where the finger was last; null after a key.
addEventListener('pointerdown', ({ clientX, clientY }) => { press = [clientX, clientY]; }, { capture: true, passive: true });
addEventListener('keydown', () => { press = null; }, { capture: true, passive: true });

const kFinger_px = 40, kEdge_px = 12;

/** Over the finger, or else over the commands; never over the commands or out of view. */
function placeToasts(list) {
  const commands = document.querySelector('.commands').getBoundingClientRect();
  const top = document.querySelector('header').getBoundingClientRect().bottom;
  const [x, y] = press ?? [commands.left + commands.width / 2, commands.top];
  const lowest = innerHeight - commands.top + 8, highest = innerHeight - top - list.offsetHeight - 8;
  list.style.bottom = `${Math.max(lowest, Math.min(innerHeight - y + kFinger_px, highest))}px`;
  list.style.left = `${Math.max(kEdge_px, Math.min(x - list.offsetWidth / 2, innerWidth - list.offsetWidth - kEdge_px))}px`;
}

export function toast(title, text, good) {
  const note = make('div', { className: good ? 'toast' : 'toast bad' }, make('b', { textContent: title }), text);
  const list = element('toasts');
  list.append(note);
  while (list.children.length > 3) list.firstChild.remove();
  placeToasts(list);
  setTimeout(() => note.remove(), good ? 2500 : 7000);
}
