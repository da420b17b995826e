// The mission's tree while it runs. Only nodes that changed are touched, once a frame, so that a tree of hundreds of
// nodes costs nothing while little happens.

const kMostOpen = 80; // A larger tree begins with its subtrees closed.

function make(tag, properties = {}, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
}

const isUnderWay = (status) => status === 'RUNNING' || status === 'SUSPENDED';

function durationText({ status, began_s: began, duration_s: lasted }, now_s) {
  const seconds = isUnderWay(status) && began !== null ? Math.max(0, now_s - began) : lasted;
  if (seconds === null || (seconds < 0.05 && !isUnderWay(status))) return '';
  return seconds < 100 ? `${seconds.toFixed(1)} s` : `${Math.floor(seconds / 60)} min ${Math.floor(seconds % 60)} s`;
}

const portsText = (ports) => Object.entries(ports).map(([name, value]) => `${name}: ${value}`).join(' · ');

export class MissionTree {
  constructor(list) {
    this.list = list;
    this.nodes = new Map(); // id -> {facts, item, row, status, detail, children}
    this.changed = new Set();
    this.drawing = false;
    this.now_s = 0;
    list.addEventListener('click', (event) => this.toggle(this.nodeOf(event.target)));
    list.addEventListener('keydown', (event) => this.onKey(event));
  }

  /** A message of the link: the whole tree, or the nodes that changed. */
  take({ whole, nodes }) {
    if (whole) this.build(nodes);
    for (const facts of nodes) {
      const node = this.nodes.get(facts.id);
      if (!node) continue;
      Object.assign(node.facts, facts);
      this.changed.add(facts.id);
    }
    this.draw();
  }

  /** The time of the flight, for the durations of what is under way. */
  tell(now_s) {
    this.now_s = now_s;
    for (const [id, { facts }] of this.nodes) if (isUnderWay(facts.status)) this.changed.add(id);
    this.draw();
  }

  build(all) {
    this.nodes.clear();
    this.changed.clear();
    const lists = new Map([[-1, document.createDocumentFragment()]]);
    for (const facts of all) {
      const status = make('small'), detail = make('p', { hidden: true });
      const row = make('div', { className: 'node', tabIndex: this.nodes.size === 0 ? 0 : -1 },
        make('span', { textContent: facts.name, title: facts.type }), status);
      const children = make('ul', { role: 'group' });
      const item = make('li', { role: 'treeitem' }, row, detail, children);
      item.dataset.id = facts.id;
      lists.set(facts.id, children);
      (lists.get(facts.parent) ?? lists.get(-1)).append(item);
      this.nodes.set(facts.id, { facts: { ...facts }, item, row, status, detail, children });
    }
    for (const node of this.nodes.values()) {
      if (!node.children.firstChild) node.children.remove();
      else this.setOpen(node, all.length <= kMostOpen || node.facts.type !== 'SubTree');
    }
    this.list.replaceChildren(lists.get(-1));
  }

  draw() {
    if (this.drawing || this.changed.size === 0) return;
    this.drawing = true;
    requestAnimationFrame(() => {
      this.drawing = false;
      for (const id of this.changed) this.show(this.nodes.get(id));
      this.changed.clear();
    });
  }

  show({ facts, row, status, detail }) {
    if (row.dataset.status !== facts.status) row.dataset.status = facts.status;
    const words = [durationText(facts, this.now_s), facts.status.toLowerCase()].filter(Boolean).join(' · ');
    if (status.textContent !== words) status.textContent = words;
    // What a node is given matters while it works, and why it failed afterwards.
    const told = [facts.reason, isUnderWay(facts.status) || facts.reason ? portsText(facts.ports) : ''].filter(Boolean).join(' · ');
    if (detail.textContent !== told) detail.textContent = told;
    if (detail.hidden !== !told) detail.hidden = !told;
    const title = portsText(facts.ports);
    if (row.title !== title) row.title = title;
  }

  nodeOf(target) {
    const item = target.closest('li[role=treeitem]');
    return item ? this.nodes.get(Number(item.dataset.id)) : undefined;
  }

  setOpen(node, open) {
    node.item.setAttribute('aria-expanded', String(open));
    node.children.hidden = !open;
  }

  toggle(node) {
    if (node?.children.isConnected) this.setOpen(node, node.children.hidden);
  }

  onKey(event) {
    const node = this.nodeOf(event.target);
    if (!node) return;
    const rows = [...this.list.querySelectorAll('.node')].filter((row) => row.offsetParent !== null);
    const at = rows.indexOf(node.row);
    const to = { ArrowDown: rows[at + 1], ArrowUp: rows[at - 1], Home: rows[0], End: rows.at(-1) }[event.key];
    if (to) {
      node.row.tabIndex = -1;
      to.tabIndex = 0;
      to.focus();
    } else if (event.key === 'Enter' || event.key === ' ') {
      this.toggle(node);
    } else if ((event.key === 'ArrowRight' || event.key === 'ArrowLeft') && node.children.isConnected) {
      this.setOpen(node, event.key === 'ArrowRight');
    } else if (!['ArrowDown', 'ArrowUp', 'Home', 'End'].includes(event.key)) {
      return;
    }
    event.preventDefault();
  }
}
