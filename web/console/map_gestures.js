// Touch, mouse and keys over the map: one finger moves it, two zoom, a tap is reported in the frame that is shown.

const kTapSlack_px = 9;

/** Two fingers: the middle moves the map, their distance zooms it. `last` and `next` belong to the finger that moved. */
function pinch(view, other, last, next) {
  const before = Math.hypot(last.x - other.x, last.y - other.y);
  const after = Math.hypot(next.x - other.x, next.y - other.y);
  view.pan((next.x - last.x) / 2, (next.y - last.y) / 2);
  if (before > 1) view.zoom(after / before, (next.x + other.x) / 2, (next.y + other.y) / 2);
}

function listenToPointers(view, onTap) {
  const { canvas } = view;
  const pointers = new Map();
  let press = null;
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  canvas.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, at(event));
    if (pointers.size === 1) press = { ...at(event), moved: false };
    else press.moved = true;
  });
  canvas.addEventListener('pointermove', (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const next = at(event);
    if (Math.hypot(next.x - press.x, next.y - press.y) > kTapSlack_px) press.moved = true;
    if (!press.moved) return;
    const others = [...pointers].filter(([id]) => id !== event.pointerId).map(([, point]) => point);
    if (others.length === 0) view.pan(next.x - last.x, next.y - last.y);
    if (others.length === 1) pinch(view, others[0], last, next);
    pointers.set(event.pointerId, next);
  });
  const release = (event, tap) => {
    if (pointers.delete(event.pointerId) && tap && pointers.size === 0 && !press.moved) onTap(view.toShown(press.x, press.y));
  };
  canvas.addEventListener('pointerup', (event) => release(event, true));
  canvas.addEventListener('pointercancel', (event) => release(event, false));
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    const { x, y } = at(event);
    view.zoom(Math.exp(-event.deltaY * 0.0015), x, y);
  }, { passive: false });
}

function listenToKeys(view) {
  const moves = { ArrowLeft: [60, 0], ArrowRight: [-60, 0], ArrowUp: [0, 60], ArrowDown: [0, -60] };
  view.canvas.addEventListener('keydown', (event) => {
    if (moves[event.key]) view.pan(...moves[event.key]);
    else if (event.key === '+' || event.key === '=') view.zoom(1.3);
    else if (event.key === '-') view.zoom(1 / 1.3);
    else if (event.key === 'f' || event.key === 'F') view.setMode('fit');
    else return;
    event.preventDefault();
  });
}

/** `onTap({x_m, y_m})`. */
export function listenToGestures(view, onTap) {
  listenToPointers(view, onTap);
  listenToKeys(view);
}
