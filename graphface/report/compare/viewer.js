// Pictures side by side, in turn, under a wipe or as their difference; zoom and position are the same for all.
//
//   const viewer = GraphfaceCompare(element, blobs);
//   viewer.show({layers: [layer, layer], pair: [0, 1], mask: 7, marks: {box: [u, v, w, h], at: [u, v]}});
//
// A layer is what graphface.report.compare.embed.layer makes: label, width, height, image (index into blobs), note and,
// where a pixel has a value, data. A layer with `message` has no picture. Words are set as text, never as markup.
"use strict";
const GraphfaceCompare = (() => {
  function make(tag, attributes = {}, ...inside) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
      if (name in made && name !== "list" && name !== "style") made[name] = value;
      else made.setAttribute(name, value);
    }
    made.append(...inside);
    return made;
  }

  function short(value) {
    if (Number.isNaN(value)) return "NaN";
    if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
    const size = Math.abs(value);
    const text = size !== 0 && (size < 1e-3 || size >= 1e5) ? value.toExponential(2) : String(+value.toPrecision(4));
    return text.replace("-", "−");
  }

  // The values under a layer's pixels, as planes of height x width.
  async function unpack(packed, blobs) {
    const codes = await unpackedCodes(packed, plane => Uint8Array.from(atob(blobs[plane]), c => c.charCodeAt(0)));
    const size = packed.height * packed.width;
    return Array.from({length: packed.channels}, (_, channel) =>
      Float64Array.from(codes.subarray(channel * size, (channel + 1) * size), code => numberOf(packed, code, channel)));
  }

  function url(layer, blobs) { return "data:image/webp;base64," + blobs[layer.image]; }

  async function pixels(layer, blobs) {
    const image = new Image();
    image.src = url(layer, blobs);
    await image.decode();
    const canvas = make("canvas", {width: layer.width, height: layer.height});
    const pen = canvas.getContext("2d", {willReadFrequently: true});
    pen.drawImage(image, 0, 0);
    const {data} = pen.getImageData(0, 0, layer.width, layer.height), size = layer.width * layer.height;
    const planes = [0, 1, 2].map(() => new Float64Array(size));
    for (let i = 0; i < size; i++) for (let k = 0; k < 3; k++) planes[k][i] = data[4 * i + k] / 255;
    return planes;
  }

  const known = new WeakMap();
  function planesOf(layer, blobs) {
    if (!known.has(layer)) known.set(layer, layer.data ? unpack(layer.data, blobs) : pixels(layer, blobs));
    return known.get(layer);
  }

  // B minus A: signed planes with the scale at which 99.5 % of what differs is in range; or why there is none.
  async function difference(one, other, blobs) {
    if (one.message || other.message) return {why: "one side has no picture"};
    const byData = one.data && other.data && one.data.channels === other.data.channels;
    const [w1, h1, w2, h2] = byData ? [one.data.width, one.data.height, other.data.width, other.data.height]
      : [one.width, one.height, other.width, other.height];
    if (w1 !== w2 || h1 !== h2) return {why: `sizes differ: ${w1} x ${h1} and ${w2} x ${h2}`};
    const bare = layer => byData ? layer : {...layer, data: null};
    const load = layer => byData || !layer.data ? planesOf(layer, blobs) : pixels(bare(layer), blobs);
    const [a, b] = await Promise.all([load(one), load(other)]);
    const planes = a.map((plane, k) => plane.map((value, i) => Object.is(value, b[k][i]) ? 0 : b[k][i] - value));
    const sizes = [];
    for (const plane of planes.slice(0, 3)) for (const d of plane) if (d !== 0 && Number.isFinite(d)) sizes.push(Math.abs(d));
    const sorted = Float64Array.from(sizes).sort();
    const scale = sorted.length ? sorted[Math.min(sorted.length - 1, Math.floor(sorted.length * 0.995))] : 1;
    return {planes, width: w1, height: h1, scale, byData, equal: !sizes.length};
  }

  function paint(canvas, found, gain) {
    canvas.width = found.width; canvas.height = found.height;
    const pen = canvas.getContext("2d"), image = pen.createImageData(found.width, found.height);
    const planes = found.planes.length >= 3 ? found.planes : [found.planes[0], found.planes[0], found.planes[0]];
    for (let i = 0; i < found.width * found.height; i++) {
      let finite = true;
      for (let k = 0; k < 3; k++) {
        const d = planes[k][i];
        finite = finite && Number.isFinite(d);
        image.data[4 * i + k] = 128 + 127 * Math.max(-1, Math.min(1, d * gain / found.scale));
      }
      if (!finite) image.data.set([255, 0, 255], 4 * i);
      image.data[4 * i + 3] = 255;
    }
    pen.putImageData(image, 0, 0);
  }

  class Viewer {
    constructor(root, blobs) {
      this.root = root; this.blobs = blobs;
      this.mode = "side"; this.zoom = 1; this.center = [0.5, 0.5]; this.at = null;
      this.gain = 1; this.masked = false; this.marked = true; this.wipe = 0.5;
      this.flipped = false; this.seconds = 0.6; this.layers = []; this.pair = [0, 1];
      root.classList.add("gc");
      this.buildBar();
      this.stage = make("div", {className: "gc-stage", tabIndex: 0, ariaLabel: "pictures; drag to move, wheel to zoom"});
      this.readout = make("div", {className: "gc-readout"});
      root.append(this.bar, this.stage, this.readout);
      new ResizeObserver(() => this.place()).observe(this.stage);
      this.stage.addEventListener("wheel", e => this.wheel(e), {passive: false});
      this.stage.addEventListener("dblclick", () => this.fit());
      this.stage.addEventListener("pointerdown", e => this.grab(e));
      this.stage.addEventListener("pointermove", e => this.point(e));
      this.stage.addEventListener("pointerleave", () => { this.at = null; this.tell(); });
      document.addEventListener("keydown", e => this.key(e));
    }

    buildBar() {
      const modes = [["side", "Side by side", "s"], ["flicker", "Flicker", "f"], ["wipe", "Wipe", "w"], ["difference", "Difference", "d"]];
      this.buttons = {};
      const group = make("div", {className: "gc-modes", role: "group", ariaLabel: "view"});
      for (const [mode, words, key] of modes) {
        const button = make("button", {type: "button", title: `key ${key}`, onclick: () => this.setMode(mode)}, words);
        this.buttons[mode] = button;
        group.append(button);
      }
      const choose = side => make("select", {ariaLabel: side ? "compared picture" : "reference picture", onchange: e => {
        this.pair[side] = +e.target.value; this.changed();
      }});
      this.selects = [choose(0), choose(1)];
      this.pairing = make("span", {className: "gc-pairing"}, this.selects[0], " against ", this.selects[1]);
      this.rate = make("input", {type: "range", min: 0.1, max: 2, step: 0.1, value: this.seconds, ariaLabel: "seconds a picture",
        oninput: e => { this.seconds = +e.target.value; this.start(); }});
      this.auto = make("input", {type: "checkbox", checked: !matchMedia("(prefers-reduced-motion: reduce)").matches, onchange: () => this.start()});
      this.rateText = make("span", {});
      this.flickering = make("span", {className: "gc-option"}, make("label", {}, this.auto, " every "), this.rate, this.rateText, make("span", {}, " or "), make("kbd", {}, "Space"));
      this.gainSlider = make("input", {type: "range", min: -3, max: 7, step: 0.25, value: 0, ariaLabel: "gain of the difference",
        oninput: e => { this.gain = 2 ** +e.target.value; this.repaint(); }});
      this.scaleText = make("span", {className: "gc-scale"});
      this.gaining = make("span", {className: "gc-option"}, "gain ", this.gainSlider, " ", this.scaleText);
      this.maskBox = make("input", {type: "checkbox", onchange: e => { this.masked = e.target.checked; this.place(); }});
      this.masking = make("label", {className: "gc-option", title: "red where anything differs, however little (key m)"}, this.maskBox, " mask");
      this.markBox = make("input", {type: "checkbox", checked: true, onchange: e => { this.marked = e.target.checked; this.place(); }});
      this.marking = make("label", {className: "gc-option", title: "a box around all that differs, a ring at the greatest difference (key b)"}, this.markBox, " marks");
      this.zoomText = make("button", {type: "button", className: "gc-zoom", title: "fit (key 0); wheel or + and - zoom", onclick: () => this.fit()});
      this.bar = make("div", {className: "gc-bar"}, group, this.pairing, this.flickering, this.gaining, this.masking, this.marking, this.zoomText);
    }

    show({layers, pair = [0, 1], mask = null, marks = null}) {
      this.layers = layers; this.mask = mask; this.marks = marks;
      const last = layers.length - 1;
      this.pair = pair.map(i => Math.min(i, last));
      for (const select of this.selects) select.replaceChildren(...layers.map((l, i) => make("option", {value: i}, l.label)));
      this.changed();
    }

    setMode(mode) { this.mode = mode; this.changed(); }

    async changed() {
      const turn = this.turn = (this.turn || 0) + 1;
      this.selects.forEach((select, side) => { select.value = this.pair[side]; });
      for (const [mode, button] of Object.entries(this.buttons)) button.setAttribute("aria-pressed", mode === this.mode);
      this.pairing.hidden = this.layers.length < 3 || this.mode === "side";
      this.flickering.hidden = this.mode !== "flicker";
      this.gaining.hidden = this.mode !== "difference";
      this.masking.hidden = this.mask === null || this.mode === "flicker";
      this.marking.hidden = !this.marks;
      this.found = null;
      this.build();
      this.place();
      this.start();
      if (this.mode !== "difference" || !this.layers.length) return;
      const found = await difference(...this.pair.map(i => this.layers[i]), this.blobs);
      if (turn === this.turn) { this.found = found; this.repaint(); this.place(); }
    }

    build() {
      const [a, b] = this.pair.map(i => this.layers[i]);
      const shown = this.mode === "side" ? this.layers.map(l => [l]) : this.mode === "difference" ? [[a]] : [[a, b]];
      this.panes = shown.map(layers => this.pane(layers));
      this.stage.replaceChildren(...this.panes.map(p => p.element));
    }

    pane(layers) {
      const port = make("div", {className: "gc-port"}), title = make("div", {className: "gc-title"});
      const pane = {port, title, layers, element: make("figure", {className: "gc-pane"}, title, port), floating: []};
      const add = (element, layer) => { pane.floating.push([element, layer]); port.append(element); return element; };
      if (this.mode === "difference") pane.canvas = add(make("canvas", {className: "gc-picture gc-signed"}), layers[0]);
      else pane.images = layers.map(layer => layer.message
        ? add(make("div", {className: "gc-message"}, layer.message), layer)
        : add(make("img", {className: "gc-picture", alt: layer.label, draggable: false, src: url(layer, this.blobs)}), layer));
      if (this.mask !== null) pane.mask = add(make("img", {className: "gc-mask", alt: "", draggable: false, src: "data:image/png;base64," + this.blobs[this.mask]}), layers[0]);
      if (this.marks) {
        pane.box = make("div", {className: "gc-box"}); pane.ring = make("div", {className: "gc-ring"});
        port.append(pane.box, pane.ring);
      }
      pane.cross = make("div", {className: "gc-cross"});
      port.append(pane.cross);
      if (this.mode === "wipe") {
        pane.handle = make("div", {className: "gc-handle", tabIndex: 0, role: "slider", ariaLabel: "wipe", ariaValueMin: 0, ariaValueMax: 100});
        port.append(pane.handle);
      }
      return pane;
    }

    // The size of a layer's picture in its pane where the zoom is 1: as large as it fits.
    fitted(pane, layer) {
      const {clientWidth: w, clientHeight: h} = pane.port, width = layer.width || 4, height = layer.height || 3;
      const factor = Math.min(w / width, h / height) * this.zoom;
      return [width * factor, height * factor];
    }

    corner(pane, layer) {
      const [w, h] = this.fitted(pane, layer);
      return [pane.port.clientWidth / 2 - this.center[0] * w, pane.port.clientHeight / 2 - this.center[1] * h, w, h];
    }

    place() {
      if (!this.panes || !this.panes.length) return;
      this.arrange();
      for (const pane of this.panes) {
        for (const [element, layer] of pane.floating) {
          const [left, top, w, h] = this.corner(pane, layer);
          Object.assign(element.style, {left: `${left}px`, top: `${top}px`, width: `${w}px`, height: `${h}px`});
          element.classList.toggle("gc-pixels", w > 3 * (layer.width || w));
        }
        if (pane.mask) pane.mask.hidden = !this.masked || this.mode === "flicker";
        this.placeMarks(pane);
        this.label(pane);
        if (this.mode === "wipe") this.placeWipe(pane);
      }
      this.zoomText.textContent = this.zoom === 1 ? "fits" : `${+this.zoom.toPrecision(3)} x`;
      this.tell();
    }

    // As many columns as make the pictures largest.
    arrange() {
      const count = this.panes.length, {clientWidth: w, clientHeight: h} = this.stage;
      const first = this.layers.find(l => !l.message) || {width: 4, height: 3};
      let best = 1, largest = 0;
      for (let columns = 1; columns <= count; columns++) {
        const rows = Math.ceil(count / columns), width = w / columns - 8, height = h / rows - 34;
        const factor = Math.min(width / first.width, height / first.height);
        if (factor > largest) { largest = factor; best = columns; }
      }
      this.stage.style.gridTemplateColumns = `repeat(${best}, minmax(0, 1fr))`;
      this.stage.style.gridAutoRows = `${Math.floor(h / Math.ceil(count / best) - 8)}px`;
    }

    placeMarks(pane) {
      if (!pane.box) return;
      const [left, top, w, h] = this.corner(pane, pane.layers[0]), {box, at} = this.marks;
      pane.box.hidden = !this.marked || !box || (box[2] > 0.98 && box[3] > 0.98);
      pane.ring.hidden = !this.marked || !at;
      if (box) Object.assign(pane.box.style, {left: `${left + box[0] * w}px`, top: `${top + box[1] * h}px`, width: `${box[2] * w}px`, height: `${box[3] * h}px`});
      if (at) Object.assign(pane.ring.style, {left: `${left + at[0] * w}px`, top: `${top + at[1] * h}px`});
    }

    label(pane) {
      const [a, b] = pane.layers, dim = text => make("span", {className: "gc-note"}, text || "");
      if (this.mode === "difference") {
        const [one, other] = this.pair.map(i => this.layers[i].label);
        pane.title.replaceChildren(`${other} − ${one}`, dim(this.found && (this.found.why || (this.found.equal ? "equal at this size" : this.found.byData ? "mid grey is no difference" : "of the drawings; mid grey is no difference"))));
      } else if (this.mode === "flicker") {
        const shown = this.flipped ? b : a;
        pane.title.replaceChildren(shown.label, dim(shown.note));
        pane.images[0].style.visibility = this.flipped ? "hidden" : "visible";
        pane.images[1].style.visibility = this.flipped ? "visible" : "hidden";
      } else if (this.mode === "wipe") pane.title.replaceChildren(make("span", {}, a.label), make("span", {className: "gc-right"}, b.label));
      else pane.title.replaceChildren(a.label, dim(a.note));
      pane.title.title = this.mode === "side" ? [a.title, a.note].filter(Boolean).join("\n") : "";
    }

    placeWipe(pane) {
      const x = this.wipe * pane.port.clientWidth, [left, , w] = this.corner(pane, pane.layers[1]);
      pane.images[1].style.clipPath = `inset(0 0 0 ${Math.max(0, Math.min(w, x - left))}px)`;
      pane.handle.style.left = `${x}px`;
      pane.handle.setAttribute("aria-valuenow", Math.round(this.wipe * 100));
    }

    repaint() {
      if (!this.found || !this.panes.length || !this.panes[0].canvas) return;
      if (this.found.why) { this.scaleText.textContent = ""; return; }
      paint(this.panes[0].canvas, this.found, this.gain);
      const reach = short(+(this.found.scale / this.gain).toPrecision(3));
      this.scaleText.textContent = `black −${reach}, white +${reach}`;
    }

    start() {
      clearInterval(this.timer);
      this.rateText.textContent = ` ${this.seconds.toFixed(1)} s`;
      if (this.mode === "flicker" && this.auto.checked) this.timer = setInterval(() => this.flip(), this.seconds * 1000);
      if (this.mode === "flicker") this.panes.forEach(p => this.label(p));
    }

    flip() { this.flipped = !this.flipped; this.panes.forEach(p => this.label(p)); }

    fit() { this.zoom = 1; this.center = [0.5, 0.5]; this.place(); }

    // Zoom so that what is under a point of a pane stays there.
    zoomAt(factor, pane, x, y) {
      const layer = pane.layers[0], [left, top, w, h] = this.corner(pane, layer);
      const u = (x - left) / w, v = (y - top) / h;
      this.zoom = Math.max(1, Math.min(64, this.zoom * factor));
      if (this.zoom < 1.02) { this.fit(); return; }
      const [wide, high] = this.fitted(pane, layer);
      this.center = [u + (pane.port.clientWidth / 2 - x) / wide, v + (pane.port.clientHeight / 2 - y) / high].map(c => Math.max(0, Math.min(1, c)));
      this.place();
    }

    under(event) {
      for (const pane of this.panes || []) {
        const box = pane.port.getBoundingClientRect(), x = event.clientX - box.left, y = event.clientY - box.top;
        if (x >= 0 && y >= 0 && x < box.width && y < box.height) return [pane, x, y];
      }
      return null;
    }

    wheel(event) {
      const under = this.under(event);
      if (!under) return;
      event.preventDefault();
      this.zoomAt(2 ** (-event.deltaY / 240), ...under);
    }

    grab(event) {
      const under = this.under(event);
      if (!under || event.button !== 0) return;
      const [pane] = under, wiping = pane.handle && event.target === pane.handle, box = pane.port.getBoundingClientRect();
      const from = [event.clientX, event.clientY], center = [...this.center], [w, h] = this.fitted(pane, pane.layers[0]);
      if (!wiping) event.preventDefault();
      this.stage.focus({preventScroll: true});
      const move = e => {
        if (wiping) this.wipe = Math.max(0, Math.min(1, (e.clientX - box.left) / box.width));
        else if (this.zoom > 1) this.center = [center[0] - (e.clientX - from[0]) / w, center[1] - (e.clientY - from[1]) / h].map(c => Math.max(0, Math.min(1, c)));
        this.place();
      };
      const end = () => { removeEventListener("pointermove", move); removeEventListener("pointerup", end); removeEventListener("pointercancel", end); };
      addEventListener("pointermove", move); addEventListener("pointerup", end); addEventListener("pointercancel", end);
    }

    point(event) {
      const under = this.under(event);
      this.at = null;
      if (under) {
        const [pane, x, y] = under, [left, top, w, h] = this.corner(pane, pane.layers[0]);
        const at = [(x - left) / w, (y - top) / h];
        if (at.every(c => c >= 0 && c < 1)) this.at = at;
      }
      this.tell();
    }

    // Position and values under the cursor, of the rows and columns that the page holds.
    async tell() {
      const asked = this.asked = (this.asked || 0) + 1, at = this.at;
      for (const pane of this.panes || []) {
        pane.cross.hidden = !at || this.panes.length < 2;
        if (!at) continue;
        const [left, top, w, h] = this.corner(pane, pane.layers[0]);
        Object.assign(pane.cross.style, {left: `${left + at[0] * w}px`, top: `${top + at[1] * h}px`});
      }
      if (!at) { this.readout.replaceChildren(make("span", {className: "gc-note"}, "Point at a picture to read its values. Wheel zooms, drag moves, double click fits.")); return; }
      const layers = this.layers.length > 2 && this.mode !== "side" ? this.pair.map(i => this.layers[i]) : this.layers;
      const read = await Promise.all(layers.map(async layer => {
        if (!layer.data) return null;
        const {width, height} = layer.data, [rows, columns] = layer.full;
        const j = Math.floor(at[0] * width), i = Math.floor(at[1] * height), planes = await planesOf(layer, this.blobs);
        return {x: Math.floor((j + 0.5) * columns / width), y: Math.floor((i + 0.5) * rows / height), values: planes.map(p => p[i * width + j])};
      }));
      if (asked !== this.asked) return;
      const first = read.find(Boolean), words = [];
      if (!first) { this.readout.replaceChildren(make("span", {className: "gc-note"}, "A pixel of this drawing has no value of its own.")); return; }
      words.push(make("b", {className: "gc-position"}, `x ${first.x}, y ${first.y}`));
      layers.forEach((layer, n) => { if (read[n]) words.push(make("span", {}, make("i", {}, layer.label), " ", read[n].values.slice(0, 6).map(short).join("  "))); });
      const [one, other] = layers.length === 2 ? read : [];
      if (one && other && one.values.length === other.values.length)
        words.push(make("span", {}, make("i", {}, "difference"), " ", one.values.slice(0, 6).map((v, k) => short(other.values[k] - v)).join("  ")));
      this.readout.replaceChildren(...words);
    }

    key(event) {
      if (event.ctrlKey || event.metaKey || event.altKey || !this.root.offsetParent || !this.panes) return;
      if (event.target.closest("input:not([type=checkbox]), select, textarea")) return;
      const modes = {s: "side", f: "flicker", w: "wipe", d: "difference"}, pane = this.panes[0];
      const middle = pane && [pane, pane.port.clientWidth / 2, pane.port.clientHeight / 2];
      if (modes[event.key]) this.setMode(modes[event.key]);
      else if (event.key === " " && this.mode === "flicker" && event.target.tagName !== "BUTTON") { this.auto.checked = false; this.start(); this.flip(); event.preventDefault(); }
      else if (event.key === "0") this.fit();
      else if ((event.key === "+" || event.key === "=") && middle) this.zoomAt(1.5, ...middle);
      else if (event.key === "-" && middle) this.zoomAt(1 / 1.5, ...middle);
      else if (event.key === "m" && !this.masking.hidden) this.maskBox.click();
      else if (event.key === "b" && !this.marking.hidden) this.markBox.click();
      else if (event.target.classList.contains("gc-handle") && event.key.startsWith("Arrow")) {
        this.wipe = Math.max(0, Math.min(1, this.wipe + (event.key === "ArrowLeft" ? -0.02 : 0.02))); this.place(); event.preventDefault();
      }
    }
  }

  const create = (root, blobs) => new Viewer(root, blobs);
  Object.assign(create, {make, short, url, difference, paint, planesOf});
  return create;
})();
