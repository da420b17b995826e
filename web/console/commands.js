// Sends the operator's commands, with the token of the link that was printed at start.

import { forVehicle } from './vehicle.js';

const kKey = 'swiftlet-token';

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
  }

  get allowed() {
    return Boolean(this.token);
  }

  /** `name`: goal, hold, resume, home or land. Resolves to {accepted, reason}; never rejects. */
  async give(name, body) {
    try {
      const response = await fetch(forVehicle(`/api/${name}`), {
        method: 'POST',
        headers: { Authorization: `Bearer ${this.token}`, 'Content-Type': 'application/json' },
        body: body ? JSON.stringify(body) : undefined,
        signal: AbortSignal.timeout(6000),
      });
      const answer = await response.json();
      if (response.status === 401) {
        this.token = null;
        sessionStorage.removeItem(kKey);
      }
      return { accepted: answer.accepted === true, reason: answer.reason ?? '' };
    } catch {
      return { accepted: false, reason: 'the vehicle’s computer did not answer; nothing is known to have happened' };
    }
  }
}
