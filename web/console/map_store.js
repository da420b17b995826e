// The page's copy of the world, updated by the link's messages.
import { kTileSize } from './link.js';
import { inverse, kIdentity, moved } from './pose2.js';

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
    /** "x,y" -> {x, y, shades, known, picture}: of the map of the flight, and of the given map in its own cells. */
    this.tiles = new Map();
    this.given = { tiles: new Map(), resolution_m: 0.05, T_given_grid: null, revision: 0 };
    this.reset();
  }

  reset() {
    this.tiles.clear();
    this.given.tiles.clear();
    this.given.T_given_grid = null;
    ++this.given.revision;
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
        this.takeTiles(this, message);
        break;
      case 'given_tiles':
        this.takeTiles(this.given, message);
        ++this.given.revision;
        break;
      case 'given_map':
        this.given.T_given_grid = message.T_given_grid;
        ++this.given.revision;
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

  takeTiles(map, { forget, resolution_m, tiles }) {
    if (forget) map.tiles.clear();
    map.resolution_m = resolution_m;
    for (const tile of tiles) map.tiles.set(`${tile.x},${tile.y}`, { ...tile, known: knownRect(tile.shades), picture: null });
  }

  /**
   * The frame that the page shows, in which places are sent: the given map's while the vehicle is localized in it,
   * else `map`. Everything on the page that shows or takes places uses this; rendering/shown_frame.hpp is the same rule
   * for the pictures that the server draws.
   */
  shown() {
    const T_map_given = this.state?.localization?.T_map_given;
    return T_map_given ? { frame: 'given', T_shown_map: inverse(T_map_given) } : { frame: 'map', T_shown_map: kIdentity };
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

  /** {x0, y0, x1, y1} in metres of all that is known, with vehicle, home and goal, in the frame that is shown. */
  bounds_m() {
    const { frame, T_shown_map } = this.shown();
    const box = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };
    const include = (T, point) => {
      const [x, y] = moved(T, point);
      box.x0 = Math.min(box.x0, x);
      box.y0 = Math.min(box.y0, y);
      box.x1 = Math.max(box.x1, x);
      box.y1 = Math.max(box.y1, y);
    };
    const includeTiles = (T, { tiles, resolution_m: cell_m }) => {
      for (const { x, y, known } of tiles.values()) {
        if (!known) continue;
        for (const cx of [known.x0, known.x1])
          for (const cy of [known.y0, known.y1])
            include(T, [(x * kTileSize + cx) * cell_m, (y * kTileSize + cy) * cell_m]);
      }
    };
    includeTiles(T_shown_map, this);
    if (frame === 'given' && this.given.T_given_grid) includeTiles(this.given.T_given_grid, this.given);
    if (box.x0 > box.x1) include(T_shown_map, [0, 0]);
    // A diverged estimate must not shrink the map to a dot.
    const { x0, y0, x1, y1 } = box;
    const near = ([x, y]) => x > x0 - kFarthest_m && x < x1 + kFarthest_m && y > y0 - kFarthest_m && y < y1 + kFarthest_m;
    for (const place of [this.state?.pose, this.state?.home, this.state?.goal]) {
      if (!place || place.x_m === null || place.y_m === null) continue;
      const point = [place.x_m, place.y_m];
      if (near(moved(T_shown_map, point))) include(T_shown_map, point);
    }
    return box;
  }
}
