// The live connection: parses what the server sends, reconnects by itself, and says how old the data is.

import { socketUrl } from './address.js';
import { forVehicle } from './vehicle.js';

/** Cells along a side of a tile. */
export const kTileSize = 64;

/** Run-length coded shades of a tile to kTileSize * kTileSize numbers, row by row from the bottom. */
function decodeTile(bytes) {
  const shades = new Uint8Array(kTileSize * kTileSize);
  let at = 0;
  for (let i = 0; i < bytes.length; ++i) {
    const shade = bytes[i] >> 4;
    let n = bytes[i] & 15;
    if (n === 15) {
      n = bytes[i + 1] | (bytes[i + 2] << 8);
      i += 2;
    }
    shades.fill(shade, at, at + n + 1);
    at += n + 1;
  }
  return shades;
}

function decodeBinary(buffer) {
  const view = new DataView(buffer);
  const count = view.getUint16(2, true);
  if (view.getUint8(0) === 2) {
    const points = new Float32Array(2 * count);
    for (let i = 0; i < 2 * count; ++i) points[i] = view.getInt16(4 + 2 * i, true) / 100;
    return { type: 'laser', points };
  }
  const tiles = [];
  let at = 8;
  for (let i = 0; i < count; ++i) {
    const length = view.getUint16(at + 4, true);
    tiles.push({
      x: view.getInt16(at, true),
      y: view.getInt16(at + 2, true),
      shades: decodeTile(new Uint8Array(buffer, at + 6, length)),
    });
    at += 6 + length;
  }
  const type = view.getUint8(0) === 3 ? 'given_tiles' : 'tiles';
  return { type, forget: view.getUint8(1) === 1, resolution_m: view.getFloat32(4, true), tiles };
}

/** A connection that is silent for longer is given up: it may have died without a word. */
const kMostSilence_ms = 6000;

export class Link {
  /**
   * `onMessage` is given each decoded message; "hello" is the first after every (re)connection. `pathOf` may add to the
   * path of the socket.
   */
  constructor(onMessage, pathOf) {
    this.onMessage = onMessage;
    this.pathOf = pathOf;
    this.lastMessage_ms = null;
    this.delay_ms = 250;
    this.connect();
  }

  connect() {
    const socket = new WebSocket(socketUrl(this.pathOf(forVehicle('api/ws'))));
    socket.binaryType = 'arraybuffer';
    const opened_ms = performance.now();
    socket.onmessage = (event) => {
      this.lastMessage_ms = performance.now();
      this.delay_ms = 250;
      this.onMessage(typeof event.data === 'string' ? JSON.parse(event.data) : decodeBinary(event.data));
    };
    // Closing a dead connection waits for its other end, which may take a minute: it is left to itself.
    const giveUp = () => {
      clearInterval(watch);
      socket.onmessage = socket.onclose = null;
      socket.close();
      setTimeout(() => this.connect(), this.delay_ms);
      this.delay_ms = Math.min(4000, this.delay_ms * 2);
    };
    socket.onclose = giveUp;
    const watch = setInterval(() => {
      if (performance.now() - Math.max(opened_ms, this.lastMessage_ms ?? 0) > kMostSilence_ms) giveUp();
    }, 500);
  }

  /** Seconds since the last message of the server; null before the first. */
  silence_s() {
    return this.lastMessage_ms === null ? null : (performance.now() - this.lastMessage_ms) / 1000;
  }
}
