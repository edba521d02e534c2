// The drawing: thumbnails, heat, pan and zoom. Its zoom is the viewBox of the SVG, so lines stay sharp.

const drawing = { svg: null, box: null, all: null };

function setUpDrawing(choose) {
  const host = document.getElementById("drawing");
  const content = document.getElementById("svg").content;
  for (const picture of content.querySelectorAll("image")) {
    picture.setAttribute("href", image(Number(picture.getAttribute("href").split("#")[1])));
  }
  const svg = content.querySelector("svg");
  host.append(svg);
  drawing.svg = svg;
  const [, , width, height] = svg.getAttribute("viewBox").split(" ").map(Number);
  drawing.all = { x: 0, y: 0, width, height };
  svg.setAttribute("width", "100%");
  svg.setAttribute("height", "100%");
  for (const group of svg.querySelectorAll("[data-node]")) group.setAttribute("role", "button");
  listen(svg, choose);
  new ResizeObserver(() => { if (drawing.box) show(drawing.box); }).observe(host);
  const center = () => [svg.clientWidth / 2, svg.clientHeight / 2];
  document.getElementById("in").onclick = () => zoom(1 / 1.4, ...center());
  document.getElementById("out").onclick = () => zoom(1.4, ...center());
  document.getElementById("whole").onclick = () => show(drawing.all);
  document.getElementById("there").onclick = () => focusOn(chosen.name, true);
  for (const button of document.querySelectorAll("[data-heat]")) button.onclick = () => heat(button.dataset.heat);
  heat("seconds");
}

function groupOf(name) {
  return drawing.svg.querySelector(`[data-node="${CSS.escape(name)}"]`);
}

function listen(svg, choose) {
  let dragged = null;
  let moved = 0;
  svg.addEventListener("wheel", (event) => {
    event.preventDefault();
    const from = svg.getBoundingClientRect();
    zoom(Math.exp(event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), event.clientX - from.left, event.clientY - from.top);
  }, { passive: false });
  svg.addEventListener("pointerdown", (event) => { dragged = [event.clientX, event.clientY]; moved = 0; });
  window.addEventListener("pointerup", () => { dragged = null; });
  window.addEventListener("pointermove", (event) => {
    if (!dragged) return;
    const [x, y] = [event.clientX - dragged[0], event.clientY - dragged[1]];
    moved += Math.abs(x) + Math.abs(y);
    dragged = [event.clientX, event.clientY];
    const scale = drawing.box.width / svg.clientWidth;
    show({ ...drawing.box, x: drawing.box.x - x * scale, y: drawing.box.y - y * scale });
  });
  svg.addEventListener("click", (event) => {
    const group = event.target.closest("[data-node]");
    if (group && moved < 6) choose(group.dataset.node, { stay: true });
  });
  svg.addEventListener("keydown", (event) => {
    const group = event.target.closest("[data-node]");
    if (group && (event.key === "Enter" || event.key === " ")) {
      event.preventDefault();
      choose(group.dataset.node, { stay: true });
    }
  });
}

// A box widened to the shape of the window, so that a length on the screen is the same in both directions.
function show(box) {
  const { clientWidth, clientHeight } = drawing.svg;
  if (!clientWidth || !clientHeight) return;
  const scale = Math.max(box.width / clientWidth, box.height / clientHeight);
  const [width, height] = [clientWidth * scale, clientHeight * scale];
  drawing.box = { x: box.x - (width - box.width) / 2, y: box.y - (height - box.height) / 2, width, height };
  const { x, y } = drawing.box;
  drawing.svg.setAttribute("viewBox", `${x} ${y} ${width} ${height}`);
}

function zoom(factor, x, y) {
  const { svg, box, all } = drawing;
  const width = Math.min(Math.max(box.width * factor, 120), 3 * Math.max(all.width, all.height));
  const kept = width / box.width;
  const at = [box.x + (x / svg.clientWidth) * box.width, box.y + (y / svg.clientHeight) * box.height];
  show({
    x: at[0] - (at[0] - box.x) * kept,
    y: at[1] - (at[1] - box.y) * kept,
    width,
    height: box.height * kept,
  });
}

// Bring a node into view: at a size that can be read where asked to, else by moving as little as that takes.
function focusOn(name, close = false) {
  const group = groupOf(name);
  if (!group || !drawing.svg.clientWidth) return;
  const place = group.transform.baseVal.consolidate().matrix;
  const { width, height } = group.querySelector(".box").getBBox();
  const middle = [place.e + width / 2, place.f + height / 2];
  const [w, h] = close ? [drawing.svg.clientWidth, drawing.svg.clientHeight] : [drawing.box.width, drawing.box.height];
  const inside = (value, low, length, part) => value - part / 2 > low && value + part / 2 < low + length;
  const seen = inside(middle[0], drawing.box.x, drawing.box.width, width) && inside(middle[1], drawing.box.y, drawing.box.height, height);
  if (seen && !close) return;
  show({ x: within(middle[0], w, drawing.all.width), y: within(middle[1], h, drawing.all.height), width: w, height: h });
}

// Where a window of this width begins that has a place in its middle, without leaving the drawing.
function within(middle, width, whole) {
  return width < whole ? Math.min(Math.max(middle - width / 2, 0), whole - width) : (whole - width) / 2;
}

function mark(name) {
  for (const group of drawing.svg.querySelectorAll(".chosen, .near")) group.classList.remove("chosen", "near");
  const group = groupOf(name);
  if (group) group.classList.add("chosen");
  for (const wire of drawing.svg.querySelectorAll(".wire")) {
    if (wire.dataset.from === name || wire.dataset.to === name) wire.classList.add("near");
  }
}

// Square roots, so that what takes a hundredth of the longest still shows a tenth of the bar.
function heat(quantity) {
  const most = Math.max(...REPORT.nodes.map((node) => node[quantity] || 0), 1e-9);
  for (const node of REPORT.nodes) {
    const group = groupOf(node.name);
    const bar = group && group.querySelector(".heat");
    if (!bar) continue;
    const share = Math.sqrt((node[quantity] || 0) / most);
    bar.setAttribute("width", share * Number(group.querySelector(".cold").getAttribute("width")));
    bar.setAttribute("fill", `hsl(${50 - 50 * share} 90% 52%)`);
  }
  for (const button of document.querySelectorAll("[data-heat]")) {
    button.setAttribute("aria-pressed", button.dataset.heat === quantity);
  }
}
