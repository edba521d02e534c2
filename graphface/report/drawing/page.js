// Moves about in the drawing, folds frames, searches, and shows what feeds a node and what it feeds.
"use strict";
(() => {
  const states = JSON.parse(document.getElementById("states").textContent);
  const view = document.getElementById("view");
  const svg = view.querySelector("svg");
  const nodes = [...svg.querySelectorAll(".node")];
  const frames = [...svg.querySelectorAll(".frame")];
  const wires = [...svg.querySelectorAll(".wire")];
  const names = nodes.map((node) => node.dataset.node);
  const paths = frames.map((frame) => frame.dataset.frame);
  const READABLE = 0.6, LARGEST = 4, MARGIN = 16;
  let state = states[0];
  let box = { x: 0, y: 0, scale: 1 };

  // ---- what is seen
  const size = () => [Math.max(view.clientWidth, 1), Math.max(view.clientHeight, 1)];
  const fitting = ([width, height]) => {
    const [w, h] = size();
    return Math.min((w - 2 * MARGIN) / width, (h - 2 * MARGIN) / height, 1.25);
  };
  function look() {
    const [w, h] = size();
    svg.setAttribute("viewBox", `${box.x} ${box.y} ${w / box.scale} ${h / box.scale}`);
  }
  function fit() {
    const scale = fitting(state.size), [w, h] = size();
    box = { scale, x: (state.size[0] - w / scale) / 2, y: (state.size[1] - h / scale) / 2 };
    look();
  }
  function zoom(factor, x = size()[0] / 2, y = size()[1] / 2) {
    const scale = Math.min(Math.max(box.scale * factor, fitting(state.size) / 2), LARGEST);
    box.x += x / box.scale - x / scale;
    box.y += y / box.scale - y / scale;
    box.scale = scale;
    look();
  }
  function center(x, y) {
    const [w, h] = size();
    box.scale = Math.max(box.scale, 0.8);
    box.x = x - w / box.scale / 2;
    box.y = y - h / box.scale / 2;
    look();
  }

  // ---- folding
  function show(next) {
    state = next;
    const paper = svg.querySelector(".paper");
    paper.setAttribute("width", state.size[0]);
    paper.setAttribute("height", state.size[1]);
    nodes.forEach((node, i) => place(node, state.nodes[i]));
    frames.forEach((frame, i) => {
      const sides = state.frames[i], folded = state.folded.includes(paths[i]);
      place(frame, sides);
      if (!sides) return;
      frame.classList.toggle("folded", folded);
      const rect = frame.querySelector("rect");
      rect.setAttribute("width", sides[2]);
      rect.setAttribute("height", sides[3]);
      const sign = frame.querySelector(".fold-sign");
      sign.setAttribute("x", sides[2] - 22);
      sign.textContent = folded ? "+" : "−";
    });
    wires.forEach((wire, i) => {
      wire.toggleAttribute("hidden", !state.wires[i]);
      wire.setAttribute("d", state.wires[i] || "M0 0");
    });
    release();
  }
  function place(element, corner) {
    element.toggleAttribute("hidden", !corner);
    if (corner) element.setAttribute("transform", `translate(${corner[0]} ${corner[1]})`);
  }
  // The known layout that has this frame as wanted and differs least from what is seen.
  function nearest(accept, wanted) {
    const distance = (s) => s.folded.filter((f) => !wanted.has(f)).length +
      [...wanted].filter((f) => !s.folded.includes(f)).length;
    const fitting = states.filter(accept);
    return fitting.length ? fitting.reduce((a, b) => (distance(b) < distance(a) ? b : a)) : state;
  }
  function toggle(path) {
    const at = paths.indexOf(path), before = state.frames[at], wanted = new Set(state.folded);
    const folded = wanted.has(path);
    if (folded) wanted.delete(path);
    else {
      for (const f of wanted) if (f.startsWith(path + "/")) wanted.delete(f);
      wanted.add(path);
    }
    show(nearest((s) => s.frames[at] && s.folded.includes(path) !== folded, wanted));
    const after = state.frames[at];
    if (before && after) { // the frame's corner stays where it was on the screen
      box.x += after[0] - before[0];
      box.y += after[1] - before[1];
    }
    look();
  }
  function reveal(name) {
    const hiding = state.folded.filter((path) => name.startsWith(path + "/"));
    hiding.forEach(toggle);
    for (let i = 0; i < paths.length && !state.nodes[names.indexOf(name)]; i++) {
      const around = state.folded.find((path) => name.startsWith(path + "/"));
      if (around) toggle(around);
    }
  }

  // ---- what feeds what
  const links = { from: new Map(), to: new Map() };
  wires.forEach((wire, i) => {
    for (const [side, key] of [["from", wire.dataset.to], ["to", wire.dataset.from]]) {
      if (!links[side].has(key)) links[side].set(key, []);
      links[side].get(key).push(i);
    }
  });
  function reach(starts, side, seenNodes, seenWires) {
    const stack = [...starts];
    const seen = new Set(stack);
    while (stack.length) {
      for (const i of links[side].get(stack.pop()) || []) {
        seenWires.add(i);
        const next = side === "from" ? wires[i].dataset.from : wires[i].dataset.to;
        if (!seen.has(next)) { seen.add(next); stack.push(next); }
      }
    }
    seen.forEach((name) => seenNodes.add(name));
  }
  let pinned = null;
  function relate(starts) {
    const seenNodes = new Set(), seenWires = new Set();
    reach(starts, "from", seenNodes, seenWires);
    reach(starts, "to", seenNodes, seenWires);
    svg.classList.add("focused");
    nodes.forEach((node, i) => node.classList.toggle("related", seenNodes.has(names[i])));
    wires.forEach((wire, i) => wire.classList.toggle("related", seenWires.has(i)));
    frames.forEach((frame, i) =>
      frame.classList.toggle("related", [...seenNodes].some((name) => name.startsWith(paths[i] + "/"))));
  }
  function release() {
    if (pinned) return;
    svg.classList.remove("focused");
  }
  function pin(starts) {
    pinned = starts;
    if (starts) relate(starts); else release();
  }
  nodes.forEach((node, i) => {
    node.addEventListener("mouseenter", () => pinned || relate([names[i]]));
    node.addEventListener("mouseleave", release);
    node.addEventListener("focus", () => node.matches(":focus-visible") && relate([names[i]]));
    node.addEventListener("blur", release);
  });
  frames.forEach((frame, i) => {
    const sign = document.createElementNS("http://www.w3.org/2000/svg", "text");
    sign.setAttribute("class", "fold-sign");
    sign.setAttribute("y", 20);
    frame.append(sign);
    frame.setAttribute("tabindex", 0);
    const inside = names.filter((name) => name.startsWith(paths[i] + "/"));
    frame.addEventListener("mouseenter", () => pinned || (frame.classList.contains("folded") && relate(inside)));
    frame.addEventListener("mouseleave", release);
    frame.addEventListener("keydown", (event) => {
      if (event.key === "Enter" || event.key === " ") { event.preventDefault(); toggle(paths[i]); }
    });
  });

  // ---- mouse and keys
  let drag = null;
  view.addEventListener("pointerdown", (event) => {
    if (event.button === 0) drag = { x: event.clientX, y: event.clientY, moved: false, on: event.target };
  });
  window.addEventListener("pointermove", (event) => {
    if (!drag) return;
    const dx = event.clientX - drag.x, dy = event.clientY - drag.y;
    if (!drag.moved && Math.hypot(dx, dy) < 4) return;
    drag = { ...drag, x: event.clientX, y: event.clientY, moved: true };
    view.classList.add("moving");
    box.x -= dx / box.scale;
    box.y -= dy / box.scale;
    look();
  });
  window.addEventListener("pointerup", () => {
    const done = drag;
    drag = null;
    view.classList.remove("moving");
    if (!done || done.moved) return;
    const node = done.on.closest(".node"), frame = done.on.closest(".frame");
    if (node) pin(pinned && pinned[0] === node.dataset.node ? null : [node.dataset.node]);
    else if (frame) toggle(frame.dataset.frame);
    else pin(null);
  });
  view.addEventListener("wheel", (event) => {
    event.preventDefault();
    const frame = view.getBoundingClientRect();
    const step = event.deltaMode === 1 ? 16 * event.deltaY : event.deltaY;
    zoom(Math.exp(-step / 500), event.clientX - frame.left, event.clientY - frame.top);
  }, { passive: false });
  const search = document.getElementById("search"), found = document.getElementById("found");
  let matches = [], at = -1;
  search.addEventListener("input", () => {
    const text = search.value.trim().toLowerCase();
    const says = (node, i) => `${names[i]} ${node.querySelector(".operator").textContent}`.toLowerCase();
    matches = text ? nodes.map((_, i) => i).filter((i) => says(nodes[i], i).includes(text)) : [];
    at = -1;
    nodes.forEach((node, i) => node.classList.toggle("match", matches.includes(i)));
    frames.forEach((frame, i) => frame.classList.toggle("match",
      frame.classList.contains("folded") && matches.some((m) => names[m].startsWith(paths[i] + "/"))));
    found.textContent = text ? `${matches.length} found` : "";
  });
  search.addEventListener("keydown", (event) => {
    if (event.key === "Escape") { search.value = ""; search.dispatchEvent(new Event("input")); search.blur(); }
    if (event.key !== "Enter" || !matches.length) return;
    at = (at + (event.shiftKey ? matches.length - 1 : 1)) % matches.length;
    reveal(names[matches[at]]);
    const corner = state.nodes[matches[at]];
    if (corner) center(corner[0] + 70, corner[1] + 40);
    found.textContent = `${at + 1} of ${matches.length}`;
  });
  document.addEventListener("keydown", (event) => {
    if (event.target === search || event.ctrlKey || event.metaKey || event.altKey) return;
    const keys = { "+": () => zoom(1.25), "=": () => zoom(1.25), "-": () => zoom(0.8), 0: fit, Escape: () => pin(null),
      "/": () => { event.preventDefault(); search.focus(); } };
    if (keys[event.key]) keys[event.key]();
  });
  const on = (id, act) => document.getElementById(id).addEventListener("click", act);
  const last = states.find((s) => s.frames.every((f, i) => !f || s.folded.includes(paths[i]))) || states[0];
  on("in", () => zoom(1.25));
  on("out", () => zoom(0.8));
  on("fit", fit);
  on("fold", () => { show(last); fit(); });
  on("open", () => { show(states[0]); fit(); });
  window.addEventListener("resize", look);

  // What can be read at once is shown first: everything where that is not too small, else what has more folded.
  const legible = states.filter((s) => fitting(s.size) >= READABLE);
  const open = (s) => s.nodes.filter(Boolean).length;
  show(legible.length ? legible.reduce((a, b) => (open(b) > open(a) ? b : a)) : last);
  fit();
})();
