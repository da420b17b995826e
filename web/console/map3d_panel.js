// The 3D map over the 2D one: drawn by the page where WebGL works, else a stream of pictures that the server draws from
// the same viewpoint. The hand turns either.
import { forVehicle } from './vehicle.js';
import { Map3dLink } from './map3d_link.js';
import { Map3dStore } from './map3d_store.js';
import { Map3dView } from './map3d_view.js';
import { listenToOrbit, Orbit } from './orbit.js';
import { PictureStream } from './picture_stream.js';
import { inverse } from './pose2.js';

/** Without a first message after this time the page shows the stream until it comes. */
const kPatience_ms = 1200;
/** Period of the stream's requests while a hand turns its view. */
const kStreamRestart_ms = 250;

export class Map3dPanel {
  /** `box` holds a canvas, a place for the stream and a note. `withToken(path)` adds the token to a path. */
  constructor(box, store, withToken) {
    Object.assign(this, { box, store, withToken, view: null, stream: null, bridging: false, byNormal: false });
    this.canvas = box.querySelector('canvas');
    this.streamBox = box.querySelector('.map3d-stream');
    this.note = box.querySelector('.map3d-note');
    this.map3d = new Map3dStore();
    this.orbit = new Orbit(() => this.changed());
    listenToOrbit(box, this.orbit);
  }

  get open() {
    return !this.box.hidden;
  }

  show() {
    this.box.hidden = false;
    this.note.textContent = '';
    this.map3d.reset();
    // A canvas that has lost its context gives no other.
    const fresh = this.canvas.cloneNode();
    this.canvas.replaceWith(fresh);
    this.canvas = fresh;
    this.canvas.hidden = false;
    try {
      this.view = new Map3dView(this.canvas, this.store, this.map3d, this.orbit, (reason) => this.fallBack(reason));
      this.view.byNormal = this.byNormal;
    } catch (error) {
      return this.fallBack(error.message);
    }
    this.link = new Map3dLink((bytes) => this.take(bytes), () => this.map3d.reset(), this.withToken);
    this.patience = setTimeout(() => this.bridge(), kPatience_ms);
  }

  /** Shows the stream until the first points come. */
  bridge() {
    this.bridging = true;
    this.showStream('the points have not come yet');
  }

  hide() {
    this.box.hidden = true;
    this.stopDrawing();
    this.endStream();
  }

  /** The page's own link had to connect again: the 3D map's link has failed with it, perhaps without an error. */
  reconnect() {
    this.link?.reconnect();
  }

  stopDrawing() {
    clearTimeout(this.patience);
    this.link?.close();
    this.view?.stop();
    this.link = this.view = null;
    this.map3d.reset();
  }

  take(bytes) {
    clearTimeout(this.patience);
    if (this.bridging) this.endStream();
    try {
      const news = this.map3d.take(bytes);
      if (news) this.view?.upload(news);
    } catch (error) {
      return this.fallBack(error.message);
    }
    this.view?.draw();
  }

  /** Shows the stream from now on, and says why. */
  fallBack(reason) {
    if (!this.open) return;
    this.stopDrawing();
    this.endStream();
    this.showStream(reason);
  }

  showStream(reason) {
    this.canvas.hidden = true;
    this.note.textContent = `Drawn by the vehicle’s computer: ${reason}`;
    this.stream = new PictureStream(this.streamBox, 'Picture of the 3D map', () => this.streamPath(), () => this.store.state?.age_s ?? null);
  }

  endStream() {
    this.stream?.stop();
    this.stream = null;
    this.bridging = false;
    this.canvas.hidden = false;
    this.note.textContent = '';
  }

  streamPath() {
    const scheme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
    const width = Math.min(960, Math.max(64, this.box.clientWidth)), height = Math.round((width * this.box.clientHeight) / this.box.clientWidth);
    return this.withToken(forVehicle(`stream/map3d.mjpg?${this.orbit.seenIn(inverse(this.store.shown().T_shown_map)).query()}&width=${width}&height=${Math.max(64, height)}` +
      `&scheme=${scheme}&color=${this.byNormal ? 'normal' : 'measured'}&fps=10&t=${Date.now()}`));
  }

  setByNormal(byNormal) {
    this.byNormal = byNormal;
    if (this.view) this.view.byNormal = byNormal;
    this.changed();
  }

  /** The viewpoint or the colours have changed. */
  changed() {
    this.onMode?.(this.orbit.kind);
    this.view?.draw();
    if (!this.stream || this.restart) return;
    this.restart = setTimeout(() => {
      this.restart = null;
      this.stream?.reconnect();
    }, kStreamRestart_ms);
  }

  /** The page's own store has changed. */
  draw() {
    if (this.open) this.view?.draw();
  }
}
