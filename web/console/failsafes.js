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

/** What the list shows instead when the table cannot be had; it is asked for again when it is next opened. */
function missingItem(reason) {
  const item = document.createElement('li');
  item.textContent = `The table of fail-safes cannot be read: ${reason}`;
  return item;
}

async function readTable() {
  const answer = await fetch('failsafes.json');
  if (!answer.ok) throw new Error(`status ${answer.status}`);
  return answer.json();
}

export function showFailsafesOnDemand(card) {
  let known = false;
  card.addEventListener('toggle', async () => {
    if (!card.open || known) return;
    const list = card.querySelector('ol');
    try {
      list.replaceChildren(...(await readTable()).map(itemOf));
      known = true;
    } catch (error) {
      list.replaceChildren(missingItem(error.message));
    }
  });
}
