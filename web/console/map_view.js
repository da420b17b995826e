// The map on a canvas: which part of it is shown, and its layers from the tiles up. Two frames: `map`, in which the
// flight reports, and the one that is shown (see MapStore.shown), in which the canvas lies and places are sent.
import { readColors } from './map_colors.js';
import { listenToGestures } from './map_gestures.js';
import { paintCertainty, paintGoal, paintHome, paintObject, paintScale, paintTarget, paintVehicle } from './map_symbols.js';
import { paintTiles } from './map_tiles.js';
import { composed, inverse, kIdentity, moved } from './pose2.js';

/** Space covered by the tools at the right, and by scale and legend at the bottom. */
const kInsets_px = { left: 20, right: 68, top: 20, bottom: 52 };

export class MapView {
  /** `onTap({x_m, y_m})` in the frame that is shown; `onMode("fit" | "follow" | "free")`; `onFrame("map" | "given")`. */
  constructor(canvas, store, { onTap, onMode, onFrame }) {
    Object.assign(this, { canvas, store, onMode, onFrame });
    this.frameShown = 'map';
    this.T_shown_map = kIdentity;
    this.context = canvas.getContext('2d', { alpha: false });
    this.center = { x_m: 0, y_m: 0 };
    this.scale = 60; // CSS pixels a metre.
    this.mode = 'fit';
    this.marker = null; // The goal that the operator asked for: {x_m, y_m, state: "asked" | "refused", since_ms}.
    this.colors = readColors();
    this.pen = null; // A zone that the operator draws.
    this.wanted = false;
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      this.colors = readColors();
      for (const { tiles } of [store, store.given]) for (const tile of tiles.values()) tile.picture = null;
      this.draw();
    });
    new ResizeObserver(() => this.draw()).observe(canvas);
    listenToGestures(this, onTap);
    this.draw();
  }

  /** Draws soon; call it when the store has changed. */
  draw() {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      this.wanted = false;
      this.paint();
    });
  }

  setMode(mode) {
    if (this.mode === mode) return;
    this.mode = mode;
    this.onMode(mode);
    this.draw();
  }

  showMarker(marker) {
    this.marker = marker && { ...marker, since_ms: performance.now() };
    this.draw();
  }

  /** Where a place in `map` is on the canvas. */
  toScreen(x_m, y_m) {
    return this.shownToScreen(...moved(this.T_shown_map, [x_m, y_m]));
  }

  shownToScreen(x_m, y_m) {
    return [
      this.width / 2 + (x_m - this.center.x_m) * this.scale,
      this.height / 2 - (y_m - this.center.y_m) * this.scale,
    ];
  }

  toShown(x_px, y_px) {
    return {
      x_m: this.center.x_m + (x_px - this.width / 2) / this.scale,
      y_m: this.center.y_m - (y_px - this.height / 2) / this.scale,
    };
  }

  zoom(factor, x_px = this.width / 2, y_px = this.height / 2) {
    const fixed = this.toShown(x_px, y_px);
    this.scale = Math.min(600, Math.max(4, this.scale * factor));
    const now = this.toShown(x_px, y_px);
    this.center.x_m += fixed.x_m - now.x_m;
    this.center.y_m += fixed.y_m - now.y_m;
    if (this.mode === 'fit') this.setMode('free');
    this.draw();
  }

  pan(dx_px, dy_px) {
    this.center.x_m -= dx_px / this.scale;
    this.center.y_m += dy_px / this.scale;
    this.setMode('free');
    this.draw();
  }

  // --- drawing --------------------------------------------------------------------------------------------------

  frame() {
    const box = this.canvas.getBoundingClientRect();
    const ratio = Math.min(3, window.devicePixelRatio || 1);
    this.width = box.width;
    this.height = box.height;
    const width = Math.max(1, Math.round(box.width * ratio)), height = Math.max(1, Math.round(box.height * ratio));
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    this.ratio = ratio;
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.followFrame();
    if (this.mode === 'fit') this.fit();
    const pose = this.store.pose();
    if (this.mode === 'follow' && pose) this.setCenter(moved(this.T_shown_map, [pose.x_m, pose.y_m]));
    // For programs that look for a place of the map on the screen: the point in the middle, and CSS pixels a metre.
    this.canvas.dataset.view = `${this.center.x_m} ${this.center.y_m} ${this.scale}`;
  }

  setCenter([x_m, y_m]) {
    this.center = { x_m, y_m };
  }

  /** What is in the middle stays there when another frame is shown. */
  followFrame() {
    const { frame, T_shown_map } = this.store.shown();
    const before = this.T_shown_map;
    this.T_shown_map = T_shown_map;
    if (frame === this.frameShown) return;
    this.frameShown = frame;
    this.setCenter(moved(composed(T_shown_map, inverse(before)), [this.center.x_m, this.center.y_m]));
    this.marker = null;
    this.onFrame(frame);
  }

  fit() {
    const { x0, y0, x1, y1 } = this.store.bounds_m();
    const { left, right, top, bottom } = kInsets_px;
    const width = Math.max(50, this.width - left - right), height = Math.max(50, this.height - top - bottom);
    this.scale = Math.min(width / Math.max(6, x1 - x0), height / Math.max(4, y1 - y0));
    this.center = {
      x_m: (x0 + x1) / 2 + (right - left) / 2 / this.scale,
      y_m: (y0 + y1) / 2 + (top - bottom) / 2 / this.scale,
    };
  }

  paint() {
    this.frame();
    const { context, colors, store } = this;
    context.fillStyle = colors.unknown;
    context.fillRect(0, 0, this.width, this.height);
    this.paintMaps();
    this.paintGrid();
    this.paintLevels();
    this.paintFrontiers();
    this.paintLaser();
    this.paintZones();
    const { state } = store;
    const pose = store.pose();
    if (state) {
      if (pose) this.paintLine(this.allToScreen([...store.trail, [pose.x_m, pose.y_m]]), colors.trail, 2.5, []);
      if (pose && state.plan.length > 0) this.paintPlan([[pose.x_m, pose.y_m], ...state.plan]);
      paintHome(this, state.home);
      for (const target of state.targets ?? []) paintTarget(this, target);
      for (const object of state.objects ?? []) paintObject(this, object);
      if (state.goal) paintGoal(this, this.toScreen(state.goal.x_m, state.goal.y_m), colors.goal, false);
      if (pose && state.localization) paintCertainty(this, pose, state.localization);
    }
    this.paintMarker();
    if (pose) paintVehicle(this, pose);
    paintScale(this);
    // Glide to the newest pose, then rest until something changes.
    if (pose && performance.now() - store.stateReceived_ms < 130) this.draw();
  }

  /** The given map under that of the flight, while the vehicle knows its place in it. */
  paintMaps() {
    const { store, colors, scale, T_shown_map } = this;
    const { given } = store;
    if (this.frameShown === 'given' && given.T_given_grid)
      paintTiles(this, given, colors.givenShades, scale, this.shownToScreen(given.T_given_grid.x_m, given.T_given_grid.y_m),
        given.T_given_grid.yaw_rad);
    paintTiles(this, store, colors.shades, scale, this.toScreen(0, 0), T_shown_map.yaw_rad);
  }

  paintGrid() {
    const { context } = this;
    const every = this.scale >= 18 ? 1 : this.scale >= 5 ? 5 : 20;
    const low = this.toShown(0, this.height), high = this.toShown(this.width, 0);
    context.fillStyle = this.colors.grid;
    for (let x = Math.ceil(low.x_m / every) * every; x <= high.x_m; x += every)
      context.fillRect(Math.round(this.shownToScreen(x, 0)[0]), 0, 1, this.height);
    for (let y = Math.ceil(low.y_m / every) * every; y <= high.y_m; y += every)
      context.fillRect(0, Math.round(this.shownToScreen(0, y)[1]), this.width, 1);
  }

  /** Rows of cells [x, y, length]. */
  paintRuns(runs, resolution_m, grow_px) {
    const { context } = this;
    const size = this.scale * resolution_m;
    context.save();
    context.translate(...this.toScreen(0, 0));
    context.rotate(-this.T_shown_map.yaw_rad);
    for (const [x, y, length] of runs)
      context.fillRect(x * size - grow_px, -(y + 1) * size - grow_px, length * size + 2 * grow_px, size + 2 * grow_px);
    context.restore();
  }

  paintLevels() {
    const { context, store } = this;
    for (const level of store.levels) {
      if (Math.abs(level.height_m) < 0.05 || level.cells.length === 0) continue;
      context.globalAlpha = Math.min(0.65, 0.18 + 0.35 * Math.abs(level.height_m));
      context.fillStyle = this.colors.level;
      this.paintRuns(level.cells, store.levelResolution_m, 0);
      context.globalAlpha = 1;
      let count = 0, x = 0, y = 0;
      for (const [cx, cy, length] of level.cells) {
        x += length * (cx + length / 2);
        y += length * (cy + 0.5);
        count += length;
      }
      const [px, py] = this.toScreen((x / count) * store.levelResolution_m, (y / count) * store.levelResolution_m);
      this.paintText(`${level.height_m.toFixed(2)} m`, px, py + 4, 'center');
    }
  }

  paintFrontiers() {
    this.context.globalAlpha = 0.9;
    const size = this.scale * this.store.frontierResolution_m;
    for (const frontier of this.store.frontiers) {
      this.context.fillStyle = this.colors.frontier[frontier.reason] ?? this.colors.text;
      this.paintRuns(frontier.cells, this.store.frontierResolution_m, Math.max(0, (3 - size) / 2));
    }
    this.context.globalAlpha = 1;
  }

  paintLaser() {
    const { context } = this;
    const { laser } = this.store;
    context.fillStyle = this.colors.laser;
    context.beginPath();
    for (let i = 0; i < laser.length; i += 2) {
      const [x, y] = this.toScreen(laser[i], laser[i + 1]);
      context.rect(x - 1.1, y - 1.1, 2.2, 2.2);
    }
    context.fill();
  }

  /** The keep-out zones, and the corners of one that is being drawn. */
  paintZones() {
    const { context } = this;
    const drawn = (this.pen?.corners_m ?? []).map(([x, y]) => this.shownToScreen(x, y));
    for (const zone of [...(this.store.state?.keep_out ?? []).map((corners) => this.allToScreen(corners)), drawn]) {
      if (zone.length === 0) continue;
      context.beginPath();
      for (const [x, y] of zone) context.lineTo(x, y);
      context.closePath();
      context.fillStyle = this.colors.frontier.blacklisted;
      context.globalAlpha = 0.18;
      context.fill();
      context.globalAlpha = 1;
      this.paintLine([...zone, zone[0]], this.colors.frontier.blacklisted, 1.8, [4, 4]);
    }
    for (const [x, y] of drawn) this.paintDisc(x, y, 4, this.colors.frontier.blacklisted);
  }

  /** Points [x, y] of `map` that are known. */
  allToScreen(points_m) {
    return points_m.filter(([x, y]) => x !== null && y !== null).map(([x, y]) => this.toScreen(x, y));
  }

  /** `points`: on the canvas. */
  paintLine(points, color, width, dash) {
    const { context } = this;
    if (points.length < 2) return;
    context.beginPath();
    for (const [x, y] of points) context.lineTo(x, y);
    Object.assign(context, { strokeStyle: color, lineWidth: width, lineJoin: 'round', lineCap: 'round' });
    context.setLineDash(dash);
    context.stroke();
    context.setLineDash([]);
  }

  paintPlan(points) {
    const line = this.allToScreen(points);
    this.paintLine(line, this.colors.plan, 2.8, [7, 7]);
    if (line.length > 0) this.paintDisc(...line.at(-1), 4, this.colors.plan);
  }

  paintDisc(x, y, radius, color) {
    this.context.beginPath();
    this.context.arc(x, y, radius, 0, 2 * Math.PI);
    this.context.fillStyle = color;
    this.context.fill();
  }

  paintRing(x, y, radius, width, color) {
    this.context.beginPath();
    this.context.arc(x, y, radius, 0, 2 * Math.PI);
    Object.assign(this.context, { strokeStyle: color, lineWidth: width });
    this.context.stroke();
  }

  paintMarker() {
    if (!this.marker) return;
    const age_s = (performance.now() - this.marker.since_ms) / 1000;
    const at = this.shownToScreen(this.marker.x_m, this.marker.y_m);
    if (this.marker.state === 'refused') {
      if (age_s > 4) {
        this.marker = null;
        return;
      }
      this.context.globalAlpha = Math.min(1, 4 - age_s);
      paintGoal(this, at, this.colors.frontier.blacklisted, true);
    } else {
      this.context.globalAlpha = 0.55 + 0.35 * Math.sin(8 * age_s);
      paintGoal(this, at, this.colors.goal, false);
    }
    this.context.globalAlpha = 1;
    this.draw();
  }

  paintText(text, x, y, align) {
    const { context, colors } = this;
    Object.assign(context, { font: '600 12px system-ui, sans-serif', textAlign: align, lineWidth: 3.5, strokeStyle: colors.free,
      fillStyle: colors.text, lineJoin: 'round' });
    context.strokeText(text, x, y);
    context.fillText(text, x, y);
  }
}
