// What a state says about its mission: whether the flight is over, how it ended, whether it takes goals.

/** No more states need come. */
export function hasEnded({ ending }) {
  return ending !== null;
}

export function fliesItsOwnGoals({ mission }) {
  return !mission.accepts_goals;
}

/** How a flight that has ended ended, in a sentence. */
export function endText({ ending }) {
  return `The flight has ended: ${ending.outcome}${ending.reason ? ` (${ending.reason})` : ''}.`;
}

/** What the mission, else its intent says; then what slows the vehicle down. Nothing that the phase says already. */
export function reasonText({ mission, intent, avoidance }, reacts) {
  return [mission.reason || intent.reason, reacts && avoidance.reason]
    .filter((text) => text && text !== mission.phase)
    .join(' · ');
}
