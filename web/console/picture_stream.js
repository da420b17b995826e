// A live picture: reads an MJPEG stream by itself, so that the age of the picture is known and it comes back by itself
// after a dropped link. (An image element shows the last picture for ever, without an error.)

/** The server repeats a picture after a second without a new one; longer silence is a dead link. */
const kMostSilence_ms = 3500;
/** An older picture is marked as stale. */
const kStale_s = 2;

const kHeadEnd = [13, 10, 13, 10];

/** Where the part's head ends in the bytes, or -1. */
function headEnd(bytes) {
  for (let i = 0; i + 4 <= bytes.length; ++i) if (kHeadEnd.every((byte, k) => bytes[i + k] === byte)) return i + 4;
  return -1;
}

function joined(a, b) {
  const bytes = new Uint8Array(a.length + b.length);
  bytes.set(a);
  bytes.set(b, a.length);
  return bytes;
}

/** Takes the whole parts out of the bytes: [{stamp, jpeg}], and what is left of them. */
function takeParts(bytes) {
  const parts = [];
  for (;;) {
    const begin = headEnd(bytes);
    if (begin < 0) return { parts, rest: bytes };
    const head = new TextDecoder().decode(bytes.subarray(0, begin));
    const length = Number(head.match(/Content-Length: (\d+)/)?.[1]);
    if (!(length >= 0)) throw new Error('not a stream of pictures');
    if (bytes.length < begin + length) return { parts, rest: bytes };
    parts.push({ stamp: head.match(/X-Timestamp: (\S+)/)?.[1], jpeg: bytes.slice(begin, begin + length) });
    bytes = bytes.slice(begin + length);
  }
}

export class PictureStream {
  /**
   * Fills `box` with an image and its age until stop(). `path()` is asked at each connection; `age_s()` is how old the
   * server says its newest picture is, or null.
   */
  constructor(box, alt, path, age_s) {
    Object.assign(this, { box, path, sourceAge_s: age_s, stopped: false, stamp: null, born_ms: null, delay_ms: 500 });
    this.image = Object.assign(new Image(), { alt });
    this.label = Object.assign(document.createElement('p'), { className: 'picture-age', textContent: 'Connecting' });
    box.replaceChildren(this.image, this.label);
    this.clock = setInterval(() => this.showAge(), 250);
    this.run();
  }

  stop() {
    this.stopped = true;
    clearInterval(this.clock);
    this.reader?.abort();
    URL.revokeObjectURL(this.image.src);
    this.box.replaceChildren();
  }

  /** Asks for the path again, at once. */
  reconnect() {
    this.delay_ms = 0;
    this.reader?.abort();
  }

  async run() {
    while (!this.stopped) {
      try {
        await this.read();
      } catch {
        // Ended, cut or silent: connected again below.
      }
      if (this.stopped) return;
      await new Promise((done) => setTimeout(done, this.delay_ms));
      this.delay_ms = Math.min(4000, Math.max(500, 2 * this.delay_ms));
    }
  }

  async read() {
    this.reader = new AbortController();
    let watch;
    const alive = () => {
      clearTimeout(watch);
      watch = setTimeout(() => this.reader.abort(), kMostSilence_ms);
    };
    alive();
    try {
      const response = await fetch(this.path(), { signal: this.reader.signal });
      if (!response.ok) throw new Error(`status ${response.status}`);
      const stream = response.body.getReader();
      for (let rest = new Uint8Array(0); ;) {
        const { done, value } = await stream.read();
        if (done) return;
        alive();
        const taken = takeParts(joined(rest, value));
        rest = taken.rest;
        if (taken.parts.length > 0) this.show(taken.parts.at(-1));
      }
    } finally {
      clearTimeout(watch);
      this.reader.abort();
    }
  }

  show({ stamp, jpeg }) {
    this.delay_ms = 500;
    if (stamp === this.stamp && this.image.src) return;
    this.stamp = stamp;
    this.born_ms = performance.now() - 1000 * (this.sourceAge_s() ?? 0);
    const last = this.image.src;
    this.image.src = URL.createObjectURL(new Blob([jpeg], { type: 'image/jpeg' }));
    if (last) URL.revokeObjectURL(last);
  }

  showAge() {
    if (this.born_ms === null) return;
    const age_s = (performance.now() - this.born_ms) / 1000;
    const stale = age_s > kStale_s;
    this.box.classList.toggle('stale', stale);
    const text = stale ? `${age_s.toFixed(0)} s old` : `${age_s.toFixed(1)} s`;
    if (this.label.textContent !== text) this.label.textContent = text;
  }
}
