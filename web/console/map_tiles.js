// Tiles of a map on a canvas: pictures made once for each tile, and painted where the map lies.
import { kTileSize } from './link.js';

/** Turned tiles overlap by this much, so that no seam shows between them. */
const kOverlap_px = 0.4;

/** The picture of a tile, in which what is unknown is transparent. */
function pictureOf(tile, shades) {
  if (tile.picture) return tile.picture;
  const picture = document.createElement('canvas');
  picture.width = picture.height = kTileSize;
  const context = picture.getContext('2d');
  const data = context.createImageData(kTileSize, kTileSize);
  for (let i = 0; i < tile.shades.length; ++i) {
    const [red, green, blue] = shades[tile.shades[i]];
    const row = kTileSize - 1 - ((i / kTileSize) | 0);
    const at = 4 * (row * kTileSize + (i % kTileSize));
    data.data[at] = red;
    data.data[at + 1] = green;
    data.data[at + 2] = blue;
    data.data[at + 3] = tile.shades[i] === 0 ? 0 : 255;
  }
  context.putImageData(data, 0, 0);
  tile.picture = picture;
  return picture;
}

/**
 * `canvas`: {context, ratio, width, height}, sizes in CSS pixels. `scale`: CSS pixels a metre. `origin`: where the origin
 * of the tiles is on the screen, [x, y]. `yaw_rad`: how far they are turned, counter-clockwise.
 */
export function paintTiles({ context, ratio, width, height }, { tiles, resolution_m }, shades, scale, [ox, oy], yaw_rad) {
  const size = kTileSize * resolution_m * scale;
  // On whole device pixels, so that no seam shows between tiles.
  const snapped = yaw_rad === 0;
  const snap = (value, offset) => (snapped ? Math.round((value + offset) * ratio) / ratio - offset : value);
  const overlap = snapped ? 0 : kOverlap_px;
  const cos = Math.cos(yaw_rad), sin = Math.sin(yaw_rad);
  context.save();
  context.imageSmoothingEnabled = scale * resolution_m * ratio < 2 || !snapped;
  context.translate(ox, oy);
  context.rotate(-yaw_rad);
  for (const tile of tiles.values()) {
    const x = tile.x * size, y = -(tile.y + 1) * size; // The upper left corner, before the turn.
    const cx = ox + cos * (x + size / 2) + sin * (y + size / 2), cy = oy - sin * (x + size / 2) + cos * (y + size / 2);
    if (!tile.known || cx < -size || cy < -size || cx > width + size || cy > height + size) continue;
    const left = snap(x, ox), top = snap(y, oy);
    context.drawImage(pictureOf(tile, shades), left, top, snap(x + size, ox) - left + overlap,
      snap(y + size, oy) - top + overlap);
  }
  context.restore();
}
