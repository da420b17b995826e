// The lines of the 3D view: the floor, the trail, the plan, the targets, the vehicle and its camera, in the map.
import { poseMatrix, quaternionFrom, transformed } from './matrices.js';
import { inverse, moved } from './pose2.js';

const kCameraPyramid_m = 0.5;
const kCorners = 24;
const kMostFloorLines = 40;
const kArrow_m = 0.6, kArrowHead_m = 0.15;

/** [r, g, b, a] from 0 to 1, of a colour as the style sheet writes it. */
export function rgba(text) {
  if (text.startsWith('#')) {
    const value = parseInt(text.slice(1), 16);
    return [value >> 16, value >> 8, value].map((part) => (part & 255) / 255).concat(1);
  }
  const [red, green, blue, alpha = '100'] = text.match(/[\d.]+/g);
  return [red / 255, green / 255, blue / 255, alpha / 100];
}

/** Along the axes of the frame that is shown, with a line at its whole metres; in the map. */
function floorLines(low, high, T_map_shown) {
  const [x0, y0] = low.map(Math.floor), [x1, y1] = high.map(Math.ceil);
  const every = Math.max(1, Math.ceil(Math.max(x1 - x0, y1 - y0) / kMostFloorLines));
  const points = [];
  for (let x = x0; x <= x1; x += every) points.push([x, y0], [x, y1]);
  for (let y = y0; y <= y1; y += every) points.push([x0, y], [x1, y]);
  return points.flatMap((point) => [...moved(T_map_shown, point), 0]);
}

/** The hull as a ring, the heading as an arrow, and a line down to the take-off floor. */
function vehicleLines(pose, radius) {
  const m = poseMatrix(pose);
  const strips = [
    Array.from({ length: kCorners + 1 }, (_, i) => [Math.cos((2 * Math.PI * i) / kCorners), Math.sin((2 * Math.PI * i) / kCorners)]),
    [[0.8, 0], [-0.5, 0.5], [-0.25, 0], [-0.5, -0.5], [0.8, 0]],
  ];
  const points = strips.flatMap((strip) => strip.slice(1).flatMap((end, i) =>
    [strip[i], end].flatMap(([ahead, left]) => transformed(m, [radius * ahead, radius * left, 0]))));
  const [x, y, z] = pose.position;
  return [...points, x, y, z, x, y, 0];
}

/** An arrow that points down at a target that was found. */
function arrowLines({ x_m, y_m, z_m }) {
  const tip = [x_m, y_m, z_m], side = kArrowHead_m / 2;
  const tails = [[0, 0, kArrow_m], [-side, 0, kArrowHead_m], [side, 0, kArrowHead_m], [0, -side, kArrowHead_m], [0, side, kArrowHead_m]];
  return tails.flatMap((tail) => [...tail.map((value, axis) => tip[axis] + value), ...tip]);
}

function cameraLines({ pose, across, up }) {
  const m = poseMatrix(pose);
  const corners = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([left, above]) =>
    transformed(m, [kCameraPyramid_m, kCameraPyramid_m * across * left, kCameraPyramid_m * up * above]));
  return corners.flatMap((corner, i) => [...pose.position, ...corner, ...corner, ...corners[(i + 1) % 4]]);
}

/** `box` is {low, high} in the frame that is shown, or null; `store` is the page's, `map3d` that of the 3D map. */
export function linesOf(store, map3d, box, colors) {
  const lines = [];
  const add = (points, color, pairs = true) => points.length >= 6 && lines.push({ points, color: rgba(color), pairs });
  if (box) add(floorLines(box.low, box.high, inverse(store.shown().T_shown_map)), colors.grid);
  add(store.trail.flatMap(([x, y]) => [x, y, 0.02]), colors.trail, false);
  const found = (store.state?.targets ?? []).filter((target) => target.state === 'found');
  const patterns = (store.state?.objects ?? []).filter(({ confirmed, passage, what }) => confirmed && passage === 'none' && what !== 'mirror');
  add([...found, ...patterns].flatMap(arrowLines), colors.goal);
  const pose = store.state?.pose;
  if (pose && pose.x_m !== null && pose.z_m !== null) {
    const position = [pose.x_m, pose.y_m, pose.z_m];
    const plan = store.state.plan ?? [];
    if (plan.length > 0) add([...position, ...plan.flatMap(([x, y]) => [x, y, pose.z_m])], colors.plan, false);
    const vehicle = { position, quaternion: quaternionFrom(pose.roll_rad, pose.pitch_rad, pose.yaw_rad) };
    add(vehicleLines(vehicle, store.hullDiameter_m / 2), colors.vehicle);
  }
  if (map3d.camera) add(cameraLines(map3d.camera), colors.laser);
  return lines;
}
