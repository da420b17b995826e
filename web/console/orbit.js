// From where the 3D map is seen, and the gestures that change it: one finger turns, two move and zoom, the wheel zooms,
// the right button or Shift moves. The angles, the bounds and the field of view are those of rendering/viewpoint3d.hpp, so
// that the stream shows the same.

import { moved } from './pose2.js';

const kDegree = Math.PI / 180;
/** Tangent of half the vertical field of view. */
export const kUp = Math.tan(25 * kDegree);
const kNearest_m = 0.3, kFarthest_m = 500;
const kMostElevation = 88 * kDegree;
const kRadiansPerPixel = 0.006;

export class Orbit {
  /** `onChange()` is called when a hand has changed something. */
  constructor(onChange) {
    Object.assign(this, { onChange, kind: 'whole', target: [0, 0, 0], distance: 4, azimuth: -2.0, elevation: 0.7 });
  }

  /** The unit vector from the target to the eye. */
  direction() {
    const level = Math.cos(this.elevation);
    return [level * Math.cos(this.azimuth), level * Math.sin(this.azimuth), Math.sin(this.elevation)];
  }

  eye() {
    return this.direction().map((value, axis) => this.target[axis] + this.distance * value);
  }

  setKind(kind) {
    this.kind = kind;
    if (kind === 'follow') this.distance = Math.min(this.distance, 6);
    this.onChange();
  }

  turn(dx_px, dy_px) {
    this.azimuth = Math.atan2(Math.sin(this.azimuth - dx_px * kRadiansPerPixel), Math.cos(this.azimuth - dx_px * kRadiansPerPixel));
    this.elevation = Math.min(kMostElevation, Math.max(-kMostElevation, this.elevation + dy_px * kRadiansPerPixel));
    this.onChange();
  }

  zoom(factor) {
    if (this.kind === 'whole') this.kind = 'orbit';
    this.distance = Math.min(kFarthest_m, Math.max(kNearest_m, this.distance / factor));
    this.onChange();
  }

  /** Moves what is at the target by pixels of a view of this height. */
  pan(dx_px, dy_px, height_px) {
    this.kind = 'orbit';
    const metres = (2 * kUp * this.distance) / height_px;
    const right = [-Math.sin(this.azimuth), Math.cos(this.azimuth), 0];
    const [x, y, z] = this.direction();
    const up = [-z * Math.cos(this.azimuth), -z * Math.sin(this.azimuth), Math.hypot(x, y)];
    this.target = this.target.map((value, axis) => value + metres * (dy_px * up[axis] - dx_px * right[axis]));
    this.onChange();
  }

  /** Sets target and distance so that the box is in a view of this shape (width over height). */
  fit(low, high, shape) {
    this.target = low.map((value, axis) => 0.5 * (value + high[axis]));
    const [x, y, z] = this.direction(), level = Math.hypot(x, y);
    const right = [-Math.sin(this.azimuth), Math.cos(this.azimuth), 0];
    const up = [-z * Math.cos(this.azimuth), -z * Math.sin(this.azimuth), level];
    this.distance = 1;
    for (let corner = 0; corner < 8; ++corner) {
      const from = this.target.map((value, axis) => ((corner >> axis) & 1 ? high : low)[axis] - value);
      const along = (axis) => from[0] * axis[0] + from[1] * axis[1] + from[2] * axis[2];
      const towards = along([x, y, z]);
      this.distance = Math.max(this.distance, Math.abs(along(right)) / (kUp * shape) + towards, Math.abs(along(up)) / kUp + towards);
    }
    this.distance *= 1.04;
  }

  /** The same view, where target and azimuth are those of another frame; `T` takes this one's coordinates there. */
  seenIn(T) {
    const seen = Object.assign(new Orbit(this.onChange), this);
    const [x, y] = moved(T, this.target);
    const azimuth = this.azimuth + T.yaw_rad;
    return Object.assign(seen, { target: [x, y, this.target[2]], azimuth: Math.atan2(Math.sin(azimuth), Math.cos(azimuth)) });
  }

  /** For /stream/map3d.mjpg, whose viewpoint is one of `map`. */
  query() {
    const angles = `azimuth=${(this.azimuth / kDegree).toFixed(1)}&elevation=${(this.elevation / kDegree).toFixed(1)}`;
    if (this.kind === 'whole') return `view=whole&${angles}`;
    const away = `distance=${this.distance.toFixed(2)}&${angles}`;
    if (this.kind === 'follow') return `view=follow&${away}`;
    const [x, y, z] = this.target.map((value) => value.toFixed(2));
    return `view=orbit&x=${x}&y=${y}&z=${z}&${away}`;
  }
}

function pinch(orbit, other, last, next, height_px) {
  const before = Math.hypot(last.x - other.x, last.y - other.y);
  const after = Math.hypot(next.x - other.x, next.y - other.y);
  orbit.pan((next.x - last.x) / 2, (next.y - last.y) / 2, height_px);
  if (before > 1 && after > 1) orbit.zoom(after / before);
}

export function listenToOrbit(element, orbit) {
  const pointers = new Map();
  element.addEventListener('pointerdown', (event) => {
    element.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  element.addEventListener('pointermove', (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const next = { x: event.clientX, y: event.clientY };
    const [other] = [...pointers].filter(([id]) => id !== event.pointerId).map(([, point]) => point);
    if (other) pinch(orbit, other, last, next, element.clientHeight);
    else if (event.buttons & 2 || event.shiftKey) orbit.pan(next.x - last.x, next.y - last.y, element.clientHeight);
    else orbit.turn(next.x - last.x, next.y - last.y);
    pointers.set(event.pointerId, next);
  });
  for (const end of ['pointerup', 'pointercancel']) element.addEventListener(end, (event) => pointers.delete(event.pointerId));
  element.addEventListener('contextmenu', (event) => event.preventDefault());
  element.addEventListener('wheel', (event) => {
    event.preventDefault();
    orbit.zoom(Math.exp(-event.deltaY * 0.0015));
  }, { passive: false });
  const turns = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
  element.addEventListener('keydown', (event) => {
    if (turns[event.key]) orbit.turn(...turns[event.key]);
    else if (event.key === '+' || event.key === '=') orbit.zoom(1.3);
    else if (event.key === '-') orbit.zoom(1 / 1.3);
    else if (event.key === 'f' || event.key === 'F') orbit.setKind('whole');
    else return;
    event.preventDefault();
  });
}
