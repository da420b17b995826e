// The page's copy of the 3D map, from the messages that web/server/submap_feed.hpp describes.

const kPointBytes = 12;
const kHeadBytes = 20;

function poseAt(view, at) {
  const values = Array.from({ length: 7 }, (_, i) => view.getFloat32(at + 4 * i, true));
  return { position: values.slice(0, 3), quaternion: values.slice(3) };
}

/** A list of points that grows. */
class Points {
  constructor(step, capacity) {
    this.step = step;
    this.count = 0;
    this.low = [Infinity, Infinity, Infinity];
    this.high = [-Infinity, -Infinity, -Infinity];
    this.bytes = new Uint8Array(capacity * kPointBytes);
  }

  add(bytes) {
    const end = this.count * kPointBytes + bytes.length;
    if (end > this.bytes.length) {
      const larger = new Uint8Array(Math.max(end, 2 * this.bytes.length));
      larger.set(this.bytes);
      this.bytes = larger;
    }
    this.bytes.set(bytes, this.count * kPointBytes);
    const steps = new Int16Array(this.bytes.buffer);
    for (; this.count * kPointBytes < end; ++this.count)
      for (let axis = 0; axis < 3; ++axis) {
        const value = this.step * steps[(kPointBytes / 2) * this.count + axis];
        this.low[axis] = Math.min(this.low[axis], value);
        this.high[axis] = Math.max(this.high[axis], value);
      }
  }
}

export class Map3dStore {
  constructor() {
    this.reset();
  }

  reset() {
    this.submaps = new Map(); // Number -> Points; two lists for each submap.
    this.poses = [];
    this.camera = null; // {pose, tracked, across, up}
    this.arriving = null;
    this.messages = 0; // Taken since the reset.
  }

  /** Takes a message; {number, first} where a submap has new points from `first` on, else null. Throws where memory fails. */
  take(buffer) {
    ++this.messages;
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
    const added = view.getUint8(1) === 1, number = view.getUint16(2, true);
    const first = view.getUint32(8, true), count = view.getUint32(12, true), step = view.getFloat32(16, true);
    if (added && first === 0) this.submaps.set(number, new Points(step, count));
    if (!added && first === 0) this.arriving = new Points(step, count);
    const into = added ? this.submaps.get(number) : this.arriving;
    if (!into || into.count !== first) return null;
    into.add(new Uint8Array(buffer, kHeadBytes));
    if (added) return { number, first };
    if (into.count < count) return null;
    this.submaps.set(number, into);
    this.arriving = null;
    return { number, first: 0 };
  }

  get points() {
    let sum = 0;
    for (const { count } of this.submaps.values()) sum += count;
    return sum;
  }
}
