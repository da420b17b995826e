// The 3D map on a canvas: draws when something has changed.
import { readColors } from './map_colors.js';
import { Map3dGl } from './map3d_gl.js';
import { linesOf, rgba } from './map3d_lines.js';
import { inFrame, lookAt, perspective, planarMatrix, poseMatrix, product, transformed } from './matrices.js';
import { kUp } from './orbit.js';
import { composed, inverse } from './pose2.js';

const kNear_m = 0.05, kFar_m = 1000;

/** The corners of the submaps' points, in the frame that is shown; null without points. */
function boundsOf(map3d, shownFromMap) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const [number, submap] of map3d.submaps) {
    const pose = map3d.poses[number];
    if (!pose || submap.count === 0) continue;
    const m = product(shownFromMap, poseMatrix(pose));
    for (let corner = 0; corner < 8; ++corner) {
      const at = transformed(m, [0, 1, 2].map((axis) => ((corner >> axis) & 1 ? submap.high : submap.low)[axis]));
      for (let axis = 0; axis < 3; ++axis) {
        low[axis] = Math.min(low[axis], at[axis]);
        high[axis] = Math.max(high[axis], at[axis]);
      }
    }
  }
  return low[0] > high[0] ? null : { low, high };
}

export class Map3dView {
  /** `store` is the page's, `map3d` that of the 3D map. `onFail(reason)` is called once if drawing fails. Throws without WebGL. */
  constructor(canvas, store, map3d, orbit, onFail) {
    Object.assign(this, { canvas, store, map3d, orbit, onFail, byNormal: false, wanted: false, stopped: false, asked: 0 });
    this.gl = new Map3dGl(canvas);
    this.colors = readColors();
    this.lost = (event) => {
      event.preventDefault();
      this.fail('the graphics context is lost');
    };
    canvas.addEventListener('webglcontextlost', this.lost);
    this.observer = new ResizeObserver(() => this.draw());
    this.observer.observe(canvas);
    this.scheme = matchMedia('(prefers-color-scheme: dark)');
    this.recolor = () => {
      this.colors = readColors();
      this.draw();
    };
    this.scheme.addEventListener('change', this.recolor);
    this.draw();
  }

  fail(reason) {
    if (this.stopped) return;
    this.stop();
    this.onFail(reason);
  }

  stop() {
    this.stopped = true;
    this.observer.disconnect();
    this.scheme.removeEventListener('change', this.recolor);
    this.canvas.removeEventListener('webglcontextlost', this.lost);
    this.gl.dispose();
  }

  /** The points of this submap are new from `first` on. */
  upload({ number, first }) {
    this.gl.upload(number, this.map3d.submaps.get(number), first);
  }

  /**
   * Draws soon. A machine that takes long for a picture rests as long before the next: otherwise pictures that are no
   * longer wanted queue up, and a tap waits for all of them.
   */
  draw() {
    this.canvas.dataset.asked = ++this.asked;
    if (this.wanted || this.stopped) return;
    this.wanted = true;
    const paintNext = () => requestAnimationFrame(() => {
      this.wanted = false;
      if (this.stopped) return;
      try {
        const begin = performance.now();
        this.paint();
        this.canvas.dataset.answered = this.asked; // For programs that look at the page: up to which request it is drawn.
        const end = performance.now();
        this.restsUntil = 2 * end - begin;
      } catch (error) {
        this.fail(error.message);
      }
    });
    const rest_ms = (this.restsUntil ?? 0) - performance.now();
    if (rest_ms > 0) setTimeout(paintNext, rest_ms);
    else paintNext();
  }

  paint() {
    const { canvas, orbit, map3d, store } = this;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio)), height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const { frame, T_shown_map } = store.shown();
    // Found or lost, the place in the given map turns the coordinates and not the view.
    if (this.seen && this.seen.frame !== frame)
      Object.assign(orbit, orbit.seenIn(composed(T_shown_map, inverse(this.seen.T_shown_map))));
    this.seen = { frame, T_shown_map };
    const shownFromMap = planarMatrix(T_shown_map);
    const box = boundsOf(map3d, shownFromMap), pose = store.state?.pose;
    if (orbit.kind === 'whole' && box) orbit.fit(box.low, box.high, width / height);
    if (orbit.kind === 'follow' && pose && pose.x_m !== null) orbit.target = transformed(shownFromMap, [pose.x_m, pose.y_m, pose.z_m ?? 0]);
    const eye = orbit.eye();
    const clipFromShown = product(perspective((kUp * width) / height, kUp, kNear_m, kFar_m), lookAt(eye, orbit.target));
    const clipFromMap = product(clipFromShown, shownFromMap);
    const lines = linesOf(store, map3d, box, this.colors);
    // The page's state comes several times a second, also while nothing moves: a picture like the last is not drawn again.
    const content = JSON.stringify([map3d.messages, width, height, clipFromMap, this.byNormal, lines, this.colors['behind-3d']]);
    if (content === this.content) return;
    this.content = content;
    this.gl.begin(rgba(this.colors['behind-3d']));
    this.gl.drawSubmaps(map3d, clipFromMap, inFrame(shownFromMap, eye), height / (2 * kUp), this.byNormal);
    this.gl.drawLines(lines, clipFromMap);
    this.gl.finish();
    // For programs that look at the page: what is drawn.
    canvas.dataset.points = map3d.points;
    canvas.dataset.submaps = map3d.poses.length;
    canvas.dataset.frame = frame;
  }
}
