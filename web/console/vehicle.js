// Which of several vehicles this page shows and commands: the one its address names, or the first.

const chosen = new URL(location.href).searchParams.get('vehicle');

/** The path, relative to the page, for the vehicle of this page. */
export function forVehicle(path) {
  if (chosen === null) return path;
  return `${path}${path.includes('?') ? '&' : '?'}vehicle=${encodeURIComponent(chosen)}`;
}

/** Fills the select with the names, of which `shown` is on this page; hidden for one vehicle. Another opens its page. */
export function offerVehicles(select, names, shown) {
  select.hidden = names.length < 2;
  if (select.options.length !== names.length) select.replaceChildren(...names.map((name) => new Option(name, name)));
  select.value = shown ?? '';
  select.onchange = () => {
    const url = new URL(location.href);
    url.searchParams.set('vehicle', select.value);
    location.assign(url);
  };
}
