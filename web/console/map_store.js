// The page's copy of the world, updated by the link's messages.
import { kTileSize } from './link.js';

const kFarthest_m = 100;

/** The known cells of a tile as a rectangle in cells within the tile, or null. */
function knownRect(shades) {
  let x0 = kTileSize, y0 = kTileSize, x1 = -1, y1 = -1;
  for (let i = 0; i < shades.length; ++i) {
    if (shades[i] === 0) continue;
    const x = i % kTileSize, y = (i / kTileSize) | 0;
    if (x < x0) x0 = x;
    if (x > x1) x1 = x;
    if (y < y0) y0 = y;
    if (y > y1) y1 = y;
  }
  return x1 < 0 ? null : { x0, y0, x1: x1 + 1, y1: y1 + 1 };
}

export class MapStore {
  constructor() {
    this.tiles = new Map(); // "x,y" -> {x, y, shades, known, picture}
    this.reset();
  }

  reset() {
    this.tiles.clear();
    this.resolution_m = 0.05;
    this.state = null;
    this.previousPose = null;
    this.stateReceived_ms = 0;
    this.trail = [];
    this.laser = new Float32Array(0);
    this.frontiers = [];
    this.frontierResolution_m = 0.05;
    this.levels = [];
    this.levelResolution_m = 0.1;
    this.hullDiameter_m = 0.55;
  }

  take(message) {
    switch (message.type) {
      case 'hello':
        this.reset();
        this.hullDiameter_m = message.hull_diameter_m;
        break;
      case 'tiles':
        if (message.forget) this.tiles.clear();
        this.resolution_m = message.resolution_m;
        for (const tile of message.tiles)
          this.tiles.set(`${tile.x},${tile.y}`, { ...tile, known: knownRect(tile.shades), picture: null });
        break;
      case 'laser':
        this.laser = message.points;
        break;
      case 'trail':
        this.trail.length = Math.min(this.trail.length, message.from);
        this.trail.push(...message.points);
        break;
      case 'frontiers':
        this.frontiers = message.frontiers;
        this.frontierResolution_m = message.resolution_m;
        break;
      case 'levels':
        this.levels = message.levels;
        this.levelResolution_m = message.resolution_m;
        break;
      case 'state':
        this.previousPose = this.pose();
        this.state = message;
        this.stateReceived_ms = performance.now();
        break;
    }
  }

  /** The pose to draw now: between the last two states, so that the vehicle glides. */
  pose() {
    const next = this.state?.pose;
    if (!next || next.x_m === null || next.y_m === null) return null;
    const last = this.previousPose;
    const t = Math.min(1, (performance.now() - this.stateReceived_ms) / 110);
    if (!last || t >= 1 || Math.hypot(next.x_m - last.x_m, next.y_m - last.y_m) > 1) return next;
    const turn = Math.atan2(Math.sin(next.yaw_rad - last.yaw_rad), Math.cos(next.yaw_rad - last.yaw_rad));
    return {
      x_m: last.x_m + t * (next.x_m - last.x_m),
      y_m: last.y_m + t * (next.y_m - last.y_m),
      yaw_rad: last.yaw_rad + t * turn,
    };
  }

  /** {x0, y0, x1, y1} in metres of all that is known, with vehicle, home and goal. */
  bounds_m() {
    const box = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };
    const include = (x, y) => {
      box.x0 = Math.min(box.x0, x);
      box.y0 = Math.min(box.y0, y);
      box.x1 = Math.max(box.x1, x);
      box.y1 = Math.max(box.y1, y);
    };
    for (const { x, y, known } of this.tiles.values()) {
      if (!known) continue;
      include((x * kTileSize + known.x0) * this.resolution_m, (y * kTileSize + known.y0) * this.resolution_m);
      include((x * kTileSize + known.x1) * this.resolution_m, (y * kTileSize + known.y1) * this.resolution_m);
    }
    if (box.x0 > box.x1) include(0, 0);
    // A diverged estimate must not shrink the map to a dot.
    const { x0, y0, x1, y1 } = box;
    const near = ({ x_m: x, y_m: y }) =>
      x !== null && y !== null && x > x0 - kFarthest_m && x < x1 + kFarthest_m && y > y0 - kFarthest_m && y < y1 + kFarthest_m;
    for (const point of [this.state?.pose, this.state?.home, this.state?.goal])
      if (point && near(point)) include(point.x_m, point.y_m);
    return box;
  }
}
