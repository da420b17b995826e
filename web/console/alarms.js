// Alarms: events that the vehicle calls so (alarmOf in common/event.hpp). Each stays over the page until it is read; a new one
// vibrates and sounds, and the sound comes again until all are read or it is muted.

const kMutedKey = 'swiftlet-muted', kReadKey = 'swiftlet-alarms-read';
const kMostShown = 3;
const kRepeat_ms = 8000;
const kVibration_ms = [400, 150, 400, 150, 400];
/** Two tones in turn, in Hz; heard over rotors better than one. */
const kTones_hz = [988, 740, 988, 740];
const kTone_s = 0.18;

/** The same alarm comes again with each connection, and that of another flight may have its number. */
const keyOf = ({ number, stamp_s, text, vehicle = '' }) => `${number} ${stamp_s} ${text} ${vehicle}`;

/** A browser lets a page sound only once it has been touched. */
class Siren {
  constructor() {
    for (const kind of ['pointerdown', 'keydown']) addEventListener(kind, () => this.wake(), { capture: true, passive: true });
  }

  wake() {
    const Context = window.AudioContext ?? window.webkitAudioContext;
    if (!Context) return null;
    this.context ??= new Context();
    if (this.context.state === 'suspended') this.context.resume().catch(() => {});
    return this.context;
  }

  sound() {
    const context = this.wake();
    if (context?.state !== 'running') return; // Tones of a context that is suspended sound all at once at the first touch.
    const volume = context.createGain();
    volume.gain.value = 0.5;
    volume.connect(context.destination);
    kTones_hz.forEach((tone_hz, i) => {
      const tone = context.createOscillator();
      tone.type = 'square';
      tone.frequency.value = tone_hz;
      tone.connect(volume);
      tone.start(context.currentTime + i * kTone_s);
      tone.stop(context.currentTime + (i + 1) * kTone_s);
    });
  }
}

export class Alarms {
  /** `panel` holds a list and the button by which it is read; `textOf(event)` is {title, detail}. */
  constructor(panel, muteButton, textOf) {
    Object.assign(this, { panel, muteButton, textOf, unread: [] });
    this.list = panel.querySelector('ol');
    this.siren = new Siren();
    this.read = new Set(JSON.parse(sessionStorage.getItem(kReadKey) ?? '[]'));
    this.muted = localStorage.getItem(kMutedKey) === 'yes';
    panel.querySelector('button').addEventListener('click', () => this.readShown());
    muteButton.addEventListener('click', () => this.mute(!this.muted));
    this.mute(this.muted);
    setInterval(() => this.unread.length > 0 && this.call(), kRepeat_ms);
  }

  mute(muted) {
    this.muted = muted;
    localStorage.setItem(kMutedKey, muted ? 'yes' : 'no');
    this.muteButton.setAttribute('aria-pressed', String(muted));
  }

  /** Of events, oldest first, those that are alarms. */
  take(events) {
    const known = new Set(this.unread.map(keyOf));
    const fresh = events.filter((event) => event.alarm && !known.has(keyOf(event)) && !this.read.has(keyOf(event)));
    if (fresh.length === 0) return;
    this.unread.push(...fresh);
    this.show();
    this.call();
  }

  call() {
    navigator.vibrate?.(kVibration_ms);
    if (!this.muted) this.siren.sound();
  }

  /** The newest first. */
  shown() {
    return this.unread.slice(-kMostShown).reverse();
  }

  /** Those that did not fit come next. */
  readShown() {
    for (const event of this.shown()) this.read.add(keyOf(event));
    sessionStorage.setItem(kReadKey, JSON.stringify([...this.read].slice(-500)));
    this.unread = this.unread.filter((event) => !this.read.has(keyOf(event)));
    navigator.vibrate?.(0);
    this.show();
  }

  show() {
    const rows = this.shown().map((event) => {
      const { title, detail } = this.textOf(event);
      const row = document.createElement('li');
      row.append(title, Object.assign(document.createElement('small'), { textContent: detail }));
      return row;
    });
    this.list.replaceChildren(...rows);
    this.panel.hidden = rows.length === 0;
  }
}
