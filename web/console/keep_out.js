// Draws a keep-out zone on the map: the taps are its corners, and a second press of the button sends it.

const kLeastCorners = 3;

export class KeepOutPen {
  /** `onChange()` when the corners changed; `send(corners_m)` with [[x, y], ...]. */
  constructor(button, onChange, send) {
    Object.assign(this, { button, onChange, send, corners_m: [], drawing: false });
    button.addEventListener('click', () => this.toggle());
  }

  toggle() {
    const { corners_m, drawing } = this;
    this.drawing = !drawing;
    this.corners_m = [];
    this.button.setAttribute('aria-pressed', String(this.drawing));
    this.onChange();
    if (drawing && corners_m.length >= kLeastCorners) this.send(corners_m);
  }

  /** Drops the corners that were tapped; true if there were any. */
  forget() {
    const some = this.corners_m.length > 0;
    this.corners_m = [];
    return some;
  }

  /** True if the tap was a corner. */
  tap({ x_m, y_m }) {
    if (this.drawing) this.corners_m.push([x_m, y_m]);
    if (this.drawing) this.onChange();
    return this.drawing;
  }
}
