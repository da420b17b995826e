// Facts about the mission in a state: whether the flight is over, how it ended, whether it takes goals.

/** No more states need come. */
export function hasEnded({ ending }) {
  return ending !== null;
}

export function fliesItsOwnGoals({ mission }) {
  return !mission.accepts_goals;
}

/** What the vehicle does while it obeys a command of the operator. */
const kObeyed = { hold: 'hold', home: 'fly home', land: 'land' };

/** Whether the vehicle is carrying out that button's command. */
export function isObeyed(command, { mission }) {
  return mission.flown_by === 'operator' && mission.phase === kObeyed[command];
}

/** How a flight ended, in a sentence. */
export function endText({ ending }) {
  return `The flight has ended: ${ending.outcome}${ending.reason ? ` (${ending.reason})` : ''}.`;
}

/**
 * The reason of the mission, or else of its intent; what the mission flies to after a hold; the cause of braking.
 * Does not repeat the phase.
 */
export function reasonText({ mission, intent, avoidance }, reacts) {
  const next = mission.waiting && `next, after Resume: ${mission.waiting}`;
  return [mission.reason || intent.reason, next, reacts && avoidance.reason]
    .filter((text) => text && text !== mission.phase)
    .join(' · ');
}
