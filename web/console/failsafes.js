// What the vehicle does about what is found to be wrong: the table of `swiftlet failsafe`, read when it is first opened.

/** One row as a list item: the finding and its phases, and below it what is done, until when, and what the operator can do. */
function itemOf({ finding, phases, response, ends, operator_can }) {
  const item = document.createElement('li');
  const title = document.createElement('b');
  title.textContent = `${finding}: ${response}`;
  const detail = document.createElement('span');
  detail.className = 'soft';
  detail.textContent = `${phases.join(', ')}. Ends ${ends}. You can ${operator_can}.`;
  item.append(title, document.createElement('br'), detail);
  return item;
}

export function showFailsafesOnDemand(card) {
  card.addEventListener('toggle', async () => {
    const list = card.querySelector('ol');
    if (!card.open || list.children.length > 0) return;
    const answer = await fetch('failsafes.json');
    if (answer.ok) list.replaceChildren(...(await answer.json()).map(itemOf));
  });
}
