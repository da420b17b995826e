// The colours of the map, from the style sheet, so that they follow the reader's light or dark scheme.

/** "#rrggbb" or "rgb(r g b / a%)" of a style property, as the canvas takes it. */
const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function parseHex(hex) {
  const value = parseInt(hex.slice(1), 16);
  return [value >> 16, (value >> 8) & 255, value & 255];
}

const mix = (a, b, t) => a.map((value, i) => Math.round(value + t * (b[i] - value)));

export function readColors() {
  const color = {};
  for (const name of ['unknown', 'free', 'wall', 'grid', 'text', 'trail', 'plan', 'goal', 'home', 'vehicle', 'laser', 'level', 'given-free', 'given-wall',
    'behind-3d'])
    color[name] = style(`--map-${name}`);
  color.card = style('--card');
  color.frontier = Object.fromEntries(
    ['open', 'too small', 'unreachable', 'blocked', 'out of bounds', 'blacklisted', 'position uncertain'].map((reason) => [
      reason,
      style(`--frontier-${reason.replaceAll(' ', '-')}`),
    ]),
  );
  const unknown = parseHex(color.unknown);
  // Shades 1 (surely) to 4 are free, 5 to 8 (surely) occupied; see web/server/tile_codec.hpp.
  // Free cells keep a contrast of 3:1 with unknown ones, however often they were seen.
  const shades = (free, wall) => [unknown, ...[1, 0.98, 0.96, 0.94].map((t) => mix(unknown, parseHex(free), t)),
    ...[0.6, 0.75, 0.9, 1].map((t) => mix(unknown, parseHex(wall), t))];
  color.shades = shades(color.free, color.wall);
  color.givenShades = shades(color['given-free'], color['given-wall']);
  return color;
}
