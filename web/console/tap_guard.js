// A control that appears, moves or disappears under a finger was not meant: a second tap on "Read" would send a goal, and
// one on the map would say "Go on". For a moment, taps there do nothing.

const kSettle_ms = 600;
const kSame_px = 2;

const isSame = (a, b) => ['left', 'top', 'right', 'bottom'].every((side) => Math.abs(a[side] - b[side]) <= kSame_px);

/** Of elements that are shown and hidden. */
export function guardTaps(elements) {
  let boxes = null; // Of the elements, in their order, when one of them last changed its size.
  let unsettled = []; // {box, until_ms}
  const observer = new ResizeObserver(() => {
    const now_ms = performance.now();
    const next = elements.map((element) => element.getBoundingClientRect());
    const moved = (boxes ?? next).flatMap((box, i) => (isSame(box, next[i]) ? [] : [box, next[i]]));
    unsettled = unsettled.filter(({ until_ms }) => until_ms > now_ms);
    unsettled.push(...moved.map((box) => ({ box, until_ms: now_ms + kSettle_ms })));
    boxes = next;
  });
  for (const element of elements) observer.observe(element);
  const drop = (event) => {
    const { clientX: x, clientY: y } = event;
    const covers = ({ left, top, right, bottom }) => x >= left && x < right && y >= top && y < bottom;
    if (unsettled.some(({ box, until_ms }) => performance.now() < until_ms && covers(box))) event.stopPropagation();
  };
  for (const kind of ['pointerdown', 'click']) addEventListener(kind, drop, { capture: true });
}
