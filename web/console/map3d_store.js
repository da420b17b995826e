// The page's copy of the 3D map, from the messages that web/server/submap_feed.hpp describes.

const kPointBytes = 12;
const kHeadBytes = 32;

function poseAt(view, at) {
  const values = Array.from({ length: 7 }, (_, i) => view.getFloat32(at + 4 * i, true));
  return { position: values.slice(0, 3), quaternion: values.slice(3) };
}

/** The lower and the upper corner of quantized points, in steps. */
function stepBounds(steps, count) {
  const low = [65535, 65535, 65535], high = [0, 0, 0];
  for (let i = 0; i < count; ++i)
    for (let axis = 0; axis < 3; ++axis) {
      const value = steps[(kPointBytes / 2) * i + axis];
      if (value < low[axis]) low[axis] = value;
      if (value > high[axis]) high[axis] = value;
    }
  return { low, high };
}

export class Map3dStore {
  constructor() {
    this.reset();
  }

  reset() {
    this.submaps = new Map(); // Number -> {version, bytes, count, origin, step, low, high}; the points of whole versions.
    this.poses = [];
    this.camera = null; // {pose, tracked, across, up}
    this.arriving = null;
  }

  /** Takes a message; a number when the points of this submap are whole and new. Throws where memory fails. */
  take(buffer) {
    const view = new DataView(buffer);
    const type = view.getUint8(0);
    if (type === 3) return this.takePoints(view, buffer);
    if (type === 4) this.takePoses(view);
    if (type === 5)
      this.camera = {
        tracked: view.getUint8(1) === 1, pose: poseAt(view, 4), across: view.getFloat32(32, true), up: view.getFloat32(36, true),
      };
    return null;
  }

  takePoses(view) {
    const count = view.getUint16(2, true);
    this.poses = Array.from({ length: count }, (_, i) => poseAt(view, 8 + 28 * i));
    for (const number of this.submaps.keys()) if (number >= count) this.submaps.delete(number);
  }

  takePoints(view, buffer) {
    const number = view.getUint16(2, true), version = view.getUint32(4, true);
    const first = view.getUint32(8, true), count = view.getUint32(12, true);
    if (first === 0) this.arriving = { number, version, bytes: new Uint8Array(count * kPointBytes), filled: 0 };
    const part = this.arriving;
    if (!part || part.number !== number || part.version !== version || part.filled !== first) return null;
    part.bytes.set(new Uint8Array(buffer, kHeadBytes), first * kPointBytes);
    part.filled += (buffer.byteLength - kHeadBytes) / kPointBytes;
    if (part.filled < count) return null;
    this.arriving = null;
    const origin = [16, 20, 24].map((at) => view.getFloat32(at, true)), step = view.getFloat32(28, true);
    const { low, high } = stepBounds(new Uint16Array(part.bytes.buffer), count);
    const corner = (steps) => steps.map((value, axis) => origin[axis] + step * value);
    this.submaps.set(number, { version, bytes: part.bytes, count, origin, step, low: corner(low), high: corner(high) });
    return number;
  }

  get points() {
    let sum = 0;
    for (const { count } of this.submaps.values()) sum += count;
    return sum;
  }
}
