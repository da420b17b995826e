// The card that starts, changes and stops missions: choose a file, edit its parameters, slide to fly.

import { toast } from './panels.js';

const kFar = 95, kGreatestStep = 30; // Of 100.
/** The list may be long, and the link slow. */
const kPatience_ms = 30_000;
const kRetry_ms = 4000;

function make(tag, properties = {}, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
}

export class MissionsCard {
  /** `give` sends a command: (name, body) -> {outcome, reason}; `onAnswer(title, answer)` shows what came back. */
  constructor(card, commands, onAnswer) {
    this.card = card;
    this.commands = commands;
    this.onAnswer = onAnswer;
    this.missions = [];
    const part = (name) => card.querySelector(`#${name}`);
    Object.assign(this, { choice: part('mission-choice'), about: part('mission-about'), form: part('mission-form'),
      slide: part('mission-slide'), stopButton: part('mission-stop') });
    this.choice.addEventListener('change', () => this.show());
    this.slide.addEventListener('input', () => this.slid());
    for (const end of ['pointerup', 'pointercancel', 'blur']) this.slide.addEventListener(end, () => this.slideBack());
    this.slideBack();
    this.stopButton.addEventListener('click', () => this.give('Stop', 'Mission stopped', 'stop'));
  }

  /** Asks again which missions there are; the choice and what was typed stay if they can. */
  async load() {
    clearTimeout(this.retry);
    if (!this.commands.allowed) return;
    try {
      const response = await this.commands.ask('GET', 'api/missions', undefined, kPatience_ms);
      this.commands.note(response);
      if (!response.ok) throw new Error(response.statusText);
      this.missions = await response.json();
    } catch {
      clearTimeout(this.retry); // Of another that has failed meanwhile.
      this.retry = setTimeout(() => this.load(), kRetry_ms);
      return;
    }
    const chosen = this.choice.value, typed = this.typed();
    this.choice.replaceChildren(...this.missions.map(({ file, name }) => make('option', { value: file, textContent: name })));
    if (this.missions.some(({ file }) => file === chosen)) this.choice.value = chosen;
    this.card.hidden = this.missions.length === 0;
    this.show();
    this.retype(typed, this.choice.value === chosen);
  }

  /** Whether anything may be started or stopped now. */
  allow(allowed, flown) {
    for (const control of [this.choice, this.slide, ...this.form.elements]) control.disabled = !allowed;
    this.stopButton.disabled = !allowed || !flown;
  }

  show() {
    const mission = this.missions.find(({ file }) => file === this.choice.value);
    this.about.textContent = mission?.about ?? '';
    const groups = new Map();
    for (const parameter of mission?.parameters ?? []) {
      const group = parameter.key.slice(0, -parameter.port.length - 1);
      if (!groups.has(group)) groups.set(group, make('fieldset', {}, make('legend', { textContent: parameter.node, title: group })));
      groups.get(group).append(this.field(parameter));
    }
    this.form.replaceChildren(...groups.values());
  }

  field({ key, port, value, expected, about, choices }) {
    const control = choices.length
      ? make('select', { name: key }, ...choices.map((text) => make('option', { textContent: text })))
      : make('input', { name: key, type: 'text', placeholder: expected, autocomplete: 'off' });
    control.value = value;
    control.dataset.before = value;
    control.title = `${about} Expected: ${expected}.`;
    return make('label', {}, make('span', { textContent: port }), control);
  }

  /** [key, value] of the parameters that differ from the file. */
  typed() {
    const changed = [...this.form.elements].filter((control) => control.name && control.value !== control.dataset.before);
    return changed.map((control) => [control.name, control.value]);
  }

  /** Fills new fields with what was typed into the old ones, and reports what the mission no longer takes. */
  retype(typed, sameFile) {
    const lost = typed.filter(([key, value]) => {
      const control = sameFile ? this.form.elements.namedItem(key) : null;
      if (!control) return true;
      control.value = value;
      if (control.value === value) return false;
      control.value = control.dataset.before; // No longer one of the choices.
      return true;
    });
    const told = lost.map(([key, value]) => `${key} = ${value}`).join(', ');
    if (told) toast('The mission has changed', `It no longer takes ${told}`, false);
  }

  /** Only what was changed is sent: the file says the rest. */
  parameters() {
    return Object.fromEntries(this.typed().map(([key, value]) => [key, value.trim()]));
  }

  slideBack() {
    this.slide.value = 0;
    this.at = 0;
    this.jumped = false;
    this.slide.style.setProperty('--share', 0);
  }

  /** A tap on the far end is no slide: the knob has to be drawn there, or moved by keys. */
  async slid() {
    const to = Number(this.slide.value);
    this.jumped ||= Math.abs(to - this.at) > kGreatestStep;
    this.at = to;
    this.slide.style.setProperty('--share', to / 100);
    if (to < kFar || this.jumped) return;
    this.slideBack();
    await this.give('Mission', 'Mission started', 'mission', { file: this.choice.value, parameters: this.parameters() });
  }

  async give(name, title, command, body) {
    this.onAnswer(name, title, await this.commands.give(command, body));
  }
}
