// Sends the operator's commands, with the token of the link that was printed at start.

import { folder } from './address.js';
import { forVehicle } from './vehicle.js';

/** Several vehicles' pages may lie below one host, each in its folder and with its token. */
const kKey = `swiftlet-token ${folder()}`;
/** The server answers a command within two seconds, even without the vehicle; a dead link gives no answer. */
const kPatience_ms = 2000;

/** The token moves from the address to this tab's storage, so that it is not shared with a copied address. */
function takeToken() {
  const url = new URL(location.href);
  const given = url.searchParams.get('token');
  if (given) {
    sessionStorage.setItem(kKey, given);
    url.searchParams.delete('token');
    history.replaceState(null, '', url);
  }
  return given ?? sessionStorage.getItem(kKey);
}

export class Commands {
  constructor() {
    this.token = takeToken();
    /** The token was refused: the link is of another start of the program. */
    this.refused = false;
  }

  get allowed() {
    return Boolean(this.token);
  }

  /** Asks the server whether the token is the operator's. Without an answer the state stays as it is. */
  async check() {
    if (!this.token) return;
    try {
      this.note(await this.ask('GET', 'api/token'));
    } catch {
      // The next hello asks again.
    }
  }

  /**
   * `name`: goal, hold, resume, home, land, mission, stop, keep_out, clear_keep_out or go_on. Resolves to {outcome, reason};
   * never rejects. The outcome is "accepted", "refused" or "no answer".
   */
  async give(name, body) {
    try {
      const response = await this.ask('POST', `api/${name}`, body && JSON.stringify(body));
      const { accepted, reason = '' } = await response.json();
      this.note(response);
      const outcome = accepted === true ? 'accepted' : response.status === 504 ? 'no answer' : 'refused';
      return { outcome, reason };
    } catch {
      return { outcome: 'no answer', reason: 'the link is lost or slow; the vehicle may still carry it out' };
    }
  }

  ask(method, path, body, patience_ms = kPatience_ms) {
    // Not in `Authorization`, where a proxy may want a password of its own.
    return fetch(forVehicle(path), {
      method,
      headers: { 'X-Swiftlet-Token': this.token, 'Content-Type': 'application/json' },
      body,
      signal: AbortSignal.timeout(patience_ms),
    });
  }

  /** Forgets a token that the server refuses. The password that a proxy asks for is another matter. */
  note(response) {
    if (response.status !== 401 || response.headers.get('WWW-Authenticate') !== 'Bearer') return;
    this.token = null;
    this.refused = true;
    sessionStorage.removeItem(kKey);
  }

  /** The path with the token, for what cannot send a header: the server keeps room for operators. */
  withToken(path) {
    if (!this.token) return path;
    return `${path}${path.includes('?') ? '&' : '?'}token=${encodeURIComponent(this.token)}`;
  }
}
