// Draws a keep-out zone on the map: the taps are its corners, and a second press of the button sends it. Corners are
// dropped only when the operator wants it, or with a message.

const kLeastCorners = 3;

export class KeepOutPen {
  /**
   * `onChange()` when the corners changed; `send(corners_m)` with [[x, y], ...], which resolves to whether the zone was
   * taken; `say(title, text)` tells the operator.
   */
  constructor(button, { onChange, send, say }) {
    Object.assign(this, { button, onChange, send, say, corners_m: [], drawing: false, warned: false, frames: 0 });
    button.addEventListener('click', () => this.toggle());
  }

  toggle() {
    const count = this.corners_m.length;
    if (!this.drawing) return this.draw([]);
    if (this.warned) return this.giveUp();
    if (count >= kLeastCorners) return this.finish();
    if (count === 0) return this.stop();
    this.warn('Not a zone yet', `Tap ${kLeastCorners - count} more corner${count === 2 ? '' : 's'}, or press again to give it up.`);
  }

  draw(corners_m) {
    Object.assign(this, { corners_m, drawing: true, warned: false });
    this.show();
  }

  stop() {
    Object.assign(this, { corners_m: [], drawing: false });
    this.show();
  }

  show() {
    this.button.setAttribute('aria-pressed', String(this.drawing));
    this.onChange();
  }

  /** Pressed again before another corner, the button gives the zone up. */
  warn(title, text) {
    this.warned = true;
    this.say(title, text);
  }

  giveUp() {
    const count = this.corners_m.length;
    this.stop();
    this.say('Zone given up', count === 1 ? 'Its one corner is forgotten.' : `Its ${count} corners are forgotten.`);
  }

  /** A zone that was not taken can be changed and sent again. */
  async finish() {
    const { corners_m, frames } = this;
    this.stop();
    if ((await this.send(corners_m)) || this.drawing) return;
    if (this.frames !== frames) return this.sayForgotten();
    this.draw(corners_m);
    this.warn('The corners stay', 'Tap more and press again to send them, or press now to give them up.');
  }

  /** The map is shown in another frame, in which the corners would lie elsewhere. */
  forget() {
    if (this.corners_m.length > 0) this.sayForgotten();
    Object.assign(this, { corners_m: [], warned: false, frames: this.frames + 1 });
  }

  sayForgotten() {
    this.say('Corners forgotten', 'The map is shown in another frame now: draw the zone again.');
  }

  /** True if the tap was a corner. */
  tap({ x_m, y_m }) {
    if (!this.drawing) return false;
    this.corners_m.push([x_m, y_m]);
    this.warned = false;
    this.onChange();
    return true;
  }
}
