// What is chosen, by click, key, search or address; and the top of the page.

let chosen = REPORT.nodes[0];

function choose(name, { stay = false, quiet = false } = {}) {
  const node = NODES.get(name);
  if (!node) return;
  chosen = node;
  showPanel(node);
  mark(name);
  if (!stay) focusOn(name);
  if (!quiet) history.replaceState(null, "", `#${encodeURIComponent(name)}`);
}

function view(name) {
  for (const tab of document.querySelectorAll("[role=tab]")) {
    const open = tab.id === `tab-${name}`;
    tab.setAttribute("aria-selected", open);
    document.getElementById(tab.getAttribute("aria-controls")).hidden = !open;
  }
  if (name === "drawing" && drawing.box) show(drawing.box);
}

function middle(name) {
  const box = groupOf(name).getBoundingClientRect();
  return [box.left + box.width / 2, box.top + box.height / 2];
}

// Left and right go along wires, up and down to the nearest node above or below.
function neighbor(key) {
  const [x, y] = middle(chosen.name);
  const along = {
    ArrowLeft: () => chosen.ports.flatMap((port) => port.wires.map((wire) => wire.node)),
    ArrowRight: () => READERS.get(chosen.name).map((reader) => reader.node),
    ArrowUp: () => REPORT.nodes.map((node) => node.name).filter((name) => middle(name)[1] < y - 1),
    ArrowDown: () => REPORT.nodes.map((node) => node.name).filter((name) => middle(name)[1] > y + 1),
  };
  const wide = key === "ArrowUp" || key === "ArrowDown" ? 4 : 1;
  const far = (name) => Math.hypot(wide * (middle(name)[0] - x), middle(name)[1] - y);
  const candidates = along[key]().filter((name) => name !== chosen.name);
  return candidates.sort((a, b) => far(a) - far(b))[0];
}

function keys(event) {
  const field = event.target.closest("input, textarea, select, canvas");
  if (field || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === "/") {
    event.preventDefault();
    document.getElementById("search").focus();
    document.getElementById("search").select();
  } else if (event.key.startsWith("Arrow") && !document.getElementById("view-drawing").hidden) {
    event.preventDefault();
    const next = neighbor(event.key);
    if (next) choose(next);
  }
}

function top() {
  document.getElementById("graph").textContent = REPORT.graph || "graph";
  const outputs = REPORT.outputs.map((output) => output.name).join(", ");
  const time = REPORT.seconds ? ` · ${duration(REPORT.seconds)}` : "";
  document.getElementById("about").textContent = `${outputs}${time} · ${REPORT.made}`;
  const warned = REPORT.nodes.filter((node) => (node.warnings || []).length).length;
  const counts = Object.keys(STATES).filter((state) => REPORT.counts[state]);
  document.getElementById("counts").append(
    ...counts.map((state) => element("li", { class: `state ${state}` }, `${REPORT.counts[state]} ${STATES[state]}`)),
    ...(warned ? [element("li", { class: "state warned" }, `${warned} warned`)] : []),
  );
  if (REPORT.stopped) {
    const line = document.getElementById("stopped");
    line.hidden = false;
    line.textContent = `The run ended before it was done: ${REPORT.stopped}`;
  }
}

function asked() {
  try {
    const name = decodeURIComponent(location.hash.slice(1));
    return NODES.has(name) ? name : "";
  } catch {
    return "";
  }
}

top();
setUpDrawing(choose);
setUpTimeline();
setUpLists();
setUpSearch(choose);
for (const tab of document.querySelectorAll("[role=tab]")) tab.onclick = () => view(tab.id.slice(4));
document.addEventListener("keydown", keys);
document.addEventListener("click", (event) => {
  const to = event.target.closest("[data-to]");
  if (!to || event.ctrlKey || event.metaKey || event.shiftKey) return;
  event.preventDefault();
  choose(to.dataset.to);
});
window.addEventListener("hashchange", () => { if (asked()) choose(asked(), { quiet: true }); });
view("drawing");
show(drawing.all);
const start = asked() || REPORT.first || REPORT.nodes[0]?.name;
if (start) {
  choose(start, { quiet: true });
  focusOn(start, true);
}
