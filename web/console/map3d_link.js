// The connection that brings the 3D map; it exists only while a 3D view is shown.
import { socketUrl } from './address.js';
import { forVehicle } from './vehicle.js';

export class Map3dLink {
  /** `onMessage` is given each message as bytes, `onOpen` is called before the first of each connection. */
  constructor(onMessage, onOpen, pathOf) {
    Object.assign(this, { onMessage, onOpen, pathOf, delay_ms: 250 });
    this.connect();
  }

  connect() {
    this.socket = new WebSocket(socketUrl(this.pathOf(forVehicle('api/map3d'))));
    this.socket.binaryType = 'arraybuffer';
    this.socket.onopen = () => this.onOpen();
    this.socket.onmessage = (event) => {
      this.delay_ms = 250;
      this.onMessage(event.data);
    };
    this.socket.onclose = () => {
      this.retry = setTimeout(() => this.connect(), this.delay_ms);
      this.delay_ms = Math.min(4000, this.delay_ms * 2);
    };
  }

  /** For a connection that may have died without a word: makes another. */
  reconnect() {
    this.close();
    this.connect();
  }

  /** Closing a dead connection waits for its other end, so nothing of it is heard any more. */
  close() {
    clearTimeout(this.retry);
    Object.assign(this.socket, { onopen: null, onmessage: null, onclose: null });
    this.socket.close();
  }
}
