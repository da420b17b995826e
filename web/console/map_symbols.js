// Symbols on the map: home, goal, targets, recognized objects, vehicle and the scale. `view` is the MapView they are painted on.

export function paintHome(view, { x_m, y_m }) {
  const { context, colors } = view;
  const [x, y] = view.toScreen(x_m, y_m);
  view.paintDisc(x, y, 11, colors.free);
  view.paintRing(x, y, 11, 2, colors.home);
  context.beginPath();
  for (const [dx, dy] of [[-4.8, 4.8], [-4.8, -0.6], [0, -5.6], [4.8, -0.6], [4.8, 4.8]]) context.lineTo(x + dx, y + dy);
  context.fillStyle = colors.home;
  context.fill();
}

/** At a place on the canvas. */
export function paintGoal(view, [x, y], color, crossed) {
  const { context } = view;
  context.lineCap = 'round';
  view.paintRing(x, y, 10, 6, view.colors.free);
  view.paintRing(x, y, 10, 3, color);
  const ends = crossed ? [[-5, -5, 5, 5], [-5, 5, 5, -5]]
    : [[0, -10, 0, -16], [0, 10, 0, 16], [-10, 0, -16, 0], [10, 0, 16, 0]];
  context.beginPath();
  for (const [ax, ay, bx, by] of ends) {
    context.moveTo(x + ax, y + ay);
    context.lineTo(x + bx, y + by);
  }
  Object.assign(context, { strokeStyle: color, lineWidth: 3 });
  context.stroke();
  if (!crossed) view.paintDisc(x, y, 3, color);
}

/** A diamond with its name; hollow while the target is only a candidate, and with an arrow at it once it is found. */
export function paintTarget(view, { x_m, y_m, label, state }) {
  const { context, colors } = view;
  const [x, y] = view.toScreen(x_m, y_m);
  const diamond = (radius, color) => {
    context.beginPath();
    for (const [dx, dy] of [[radius, 0], [0, -radius], [-radius, 0], [0, radius]]) context.lineTo(x + dx, y + dy);
    context.fillStyle = color;
    context.fill();
  };
  diamond(12, colors.free);
  diamond(9, colors.goal);
  if (state === 'candidate') {
    diamond(5, colors.free);
  } else {
    context.beginPath();
    for (const [dx, dy] of [[-6, -22], [6, -22], [0, -13]]) context.lineTo(x + dx, y + dy);
    context.fill();
    context.fillRect(x - 1.5, y - 35, 3, 14);
  }
  view.paintText(label, x + 14, y + 4, 'left');
}

/** The width of a window or a door between its sides, crossed out where nothing comes through; a pattern is a target. */
export function paintObject(view, { x_m, y_m, yaw_rad, width_m, label, what, passage, confirmed }) {
  if (!confirmed) return;
  if (passage === 'none' && what !== 'mirror') return paintTarget(view, { x_m, y_m, label, state: 'found' });
  const { context, colors } = view;
  const half_m = width_m / 2, side_m = 7 / view.scale, cos = Math.cos(yaw_rad), sin = Math.sin(yaw_rad);
  const place = (normal_m, along_m) =>
    view.toScreen(x_m + cos * normal_m - sin * along_m, y_m + sin * normal_m + cos * along_m);
  const lines = [[0, -half_m, 0, half_m], [-side_m, -half_m, side_m, -half_m], [-side_m, half_m, side_m, half_m]];
  if (passage !== 'open') lines.push([-side_m, -half_m, side_m, half_m], [side_m, -half_m, -side_m, half_m]);
  context.lineCap = 'round';
  for (const [strokeStyle, lineWidth] of [[colors.free, 7], [colors.goal, 3]]) {
    context.beginPath();
    for (const [a, b, c, d] of lines) {
      context.moveTo(...place(a, b));
      context.lineTo(...place(c, d));
    }
    Object.assign(context, { strokeStyle, lineWidth });
    context.stroke();
  }
  const [x, y] = place(2.2 * side_m, 0);
  view.paintText(label, x, y + 4, 'center');
}

export function paintVehicle(view, { x_m, y_m, yaw_rad }) {
  const { context, colors } = view;
  const [x, y] = view.toScreen(x_m, y_m);
  const radius = Math.max(11, (view.scale * view.store.hullDiameter_m) / 2);
  context.globalAlpha = 0.28;
  view.paintDisc(x, y, radius, colors.vehicle);
  context.globalAlpha = 1;
  view.paintRing(x, y, radius, Math.min(3, Math.max(1.8, 0.12 * radius)), colors.vehicle);
  context.save();
  context.translate(x, y);
  context.rotate(-(yaw_rad + view.T_shown_map.yaw_rad));
  context.beginPath();
  for (const [ahead, left] of [[0.78, 0], [-0.52, 0.48], [-0.26, 0], [-0.52, -0.48]])
    context.lineTo(radius * ahead, radius * left);
  context.fillStyle = colors.vehicle;
  context.fill();
  context.restore();
}

/** The place in the given map is within the ring with 95 %: 2.45 deviations of a plane's Gaussian. */
export function paintCertainty(view, pose, { state, deviation_m }) {
  if (state !== 'localized' || deviation_m === null) return;
  const { context, colors } = view;
  // `deviation_m` is the root of the trace, of two axes.
  const radius = (2.45 * deviation_m * view.scale) / Math.SQRT2;
  context.setLineDash([3, 3]);
  view.paintRing(...view.toScreen(pose.x_m, pose.y_m), Math.max(2, radius), 1.6, colors.goal);
  context.setLineDash([]);
}

export function paintScale(view) {
  const { context, colors } = view;
  const longest_m = 110 / view.scale;
  const power = 10 ** Math.floor(Math.log10(longest_m));
  const length_m = [5, 2, 1].map((f) => f * power).find((value) => value <= longest_m);
  const x = 16, y = view.height - 16, width = length_m * view.scale;
  for (const [color, line] of [[colors.unknown, 5], [colors.text, 2]]) {
    context.beginPath();
    context.moveTo(x, y - 6);
    context.lineTo(x, y);
    context.lineTo(x + width, y);
    context.lineTo(x + width, y - 6);
    Object.assign(context, { strokeStyle: color, lineWidth: line, lineJoin: 'miter', lineCap: 'butt' });
    context.stroke();
  }
  view.paintText(`${length_m} m`, x + width / 2, y - 7, 'center');
}
