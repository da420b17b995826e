// The card of the given map: the map as a whole, with the places where the vehicle may be, or the one where it is.
import { paintTiles } from './map_tiles.js';
import { readColors } from './map_colors.js';
import { kTileSize } from './link.js';
import { moved } from './pose2.js';

const kMargin_px = 10;
/** A candidate that is less likely is drawn without its share. */
const kLeastLabelled = 0.1;

/** How sure the vehicle is of its place, in a few words. */
export function sureText({ state, places, candidates, deviation_m, deviation_yaw_rad, explained }) {
  if (state === 'localized') {
    const turn = (deviation_yaw_rad * 180) / Math.PI;
    return `± ${(100 * deviation_m).toFixed(0)} cm, ± ${turn.toFixed(1)}°, ${Math.round(100 * explained)} % explained`;
  }
  if (candidates.length === 0) return state;
  if (places === 1) return 'one place fits, not yet sure';
  const best = Math.round(100 * Math.max(...candidates.map(({ weight }) => weight)));
  return `${state}: ${places} places, the likeliest ${best} %`;
}

export class GivenMapPanel {
  constructor(card, store) {
    Object.assign(this, { card, store, drawn: '' });
    this.canvas = card.querySelector('canvas');
    this.text = card.querySelector('#given-sure');
    this.context = this.canvas.getContext('2d', { alpha: false });
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { this.drawn = ''; });
  }

  /** Paints again if anything that it shows has changed; call it when the store has changed. */
  draw() {
    const { localization } = this.store.state ?? {};
    this.card.hidden = !localization;
    if (!localization) return;
    const text = sureText(localization);
    if (this.text.textContent !== text) this.text.textContent = text;
    const { x_m, y_m, yaw_rad, candidates } = localization;
    const round = (value) => value?.toFixed(1);
    const now = JSON.stringify([round(x_m), round(y_m), round(yaw_rad), candidates, this.store.given.revision,
      this.canvas.clientWidth]);
    if (now === this.drawn) return;
    this.drawn = now;
    this.paint(localization);
  }

  /** The whole map fits: CSS pixels a metre, and where the corner of its lowest cells is. */
  layOut() {
    const { tiles, resolution_m } = this.store.given;
    let x0 = Infinity, y0 = Infinity, x1 = -Infinity, y1 = -Infinity;
    for (const { x, y, known } of tiles.values()) {
      if (!known) continue;
      x0 = Math.min(x0, x * kTileSize + known.x0);
      y0 = Math.min(y0, y * kTileSize + known.y0);
      x1 = Math.max(x1, x * kTileSize + known.x1);
      y1 = Math.max(y1, y * kTileSize + known.y1);
    }
    if (x0 > x1) return null;
    const { width, height } = this;
    const scale = Math.min((width - 2 * kMargin_px) / (x1 - x0), (height - 2 * kMargin_px) / (y1 - y0)) / resolution_m;
    return { scale,
      origin: [width / 2 - (scale * resolution_m * (x0 + x1)) / 2, height / 2 + (scale * resolution_m * (y0 + y1)) / 2] };
  }

  paint(localization) {
    const colors = readColors();
    const { canvas, context } = this;
    this.ratio = Math.min(3, window.devicePixelRatio || 1);
    this.width = canvas.clientWidth;
    this.height = canvas.clientHeight;
    Object.assign(canvas, { width: Math.max(1, this.width * this.ratio), height: Math.max(1, this.height * this.ratio) });
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.fillStyle = colors.unknown;
    context.fillRect(0, 0, this.width, this.height);
    const { T_given_grid } = this.store.given;
    const layout = this.layOut();
    if (!layout || !T_given_grid) return;
    // In the axes of the grid, which is as the map's picture is.
    paintTiles(this, this.store.given, colors.givenShades, layout.scale, layout.origin, 0);
    const at = ({ x_m, y_m, yaw_rad }) => {
      const [dx, dy] = [x_m - T_given_grid.x_m, y_m - T_given_grid.y_m];
      const [gx, gy] = moved({ x_m: 0, y_m: 0, yaw_rad: -T_given_grid.yaw_rad }, [dx, dy]);
      return [layout.origin[0] + gx * layout.scale, layout.origin[1] - gy * layout.scale, yaw_rad - T_given_grid.yaw_rad];
    };
    // The likeliest last, on top.
    for (const candidate of [...localization.candidates].reverse())
      this.paintPlace(at(candidate), colors.goal, candidate.weight, colors);
    if (localization.x_m !== null) this.paintPlace(at(localization), colors.vehicle, null, colors);
  }

  /** An arrow; the likelier, the larger and the less transparent, with its share. */
  paintPlace([x, y, yaw_rad], color, weight, colors) {
    const { context } = this;
    const share = weight ?? 1;
    const radius = 5 + 6 * Math.sqrt(share);
    context.globalAlpha = 0.35 + 0.65 * share;
    context.save();
    context.translate(x, y);
    context.rotate(-yaw_rad);
    context.beginPath();
    for (const [ahead, left] of [[1, 0], [-0.75, 0.7], [-0.35, 0], [-0.75, -0.7]]) context.lineTo(radius * ahead, radius * left);
    context.fillStyle = color;
    context.fill();
    context.restore();
    context.globalAlpha = 1;
    if (weight === null || weight < kLeastLabelled) return;
    Object.assign(context, { font: '600 11px system-ui, sans-serif', fillStyle: colors.text, strokeStyle: colors.free, lineWidth: 3 });
    const label = `${Math.round(100 * weight)} %`;
    context.strokeText(label, x + radius, y - radius / 2);
    context.fillText(label, x + radius, y - radius / 2);
  }
}
