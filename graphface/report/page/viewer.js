// A picture with zoom and pan, and the value under the cursor.

class Values {
  static async of(data) {
    return new Values(data, await unpackedCodes(data, bytesOf));
  }

  constructor(data, codes) {
    this.data = data;
    this.codes = codes;
  }

  // The numbers at a column and row of the packed array, one for each channel.
  at(column, row) {
    const { height, width, channels } = this.data;
    return Array.from({ length: channels }, (_, channel) =>
      numberOf(this.data, this.codes[(channel * height + row) * width + column], channel),
    );
  }

  // Where the value stood in the array itself: rows and columns are picked, each from the middle of its share.
  original(column, row) {
    const { height, width, full } = this.data;
    return [Math.floor(((column + 0.5) * full[1]) / width), Math.floor(((row + 0.5) * full[0]) / height)];
  }
}

const MOST = 64;

class Viewer {
  constructor(sheet) {
    this.sheet = sheet;
    this.values = null;
    this.place = null;
    this.canvas = element("canvas", { tabindex: "0", role: "img", "aria-label": sheet.label || "the value" });
    this.readout = element("output", { class: "readout" });
    const button = (text, title, act) => element("button", { title, "aria-label": title, onclick: act }, text);
    this.tools = element(
      "span",
      { class: "choice" },
      button("−", "Smaller", () => this.zoom(1 / 1.5)),
      button("+", "Larger", () => this.zoom(1.5)),
      button("Fit", "The whole picture", () => this.fit()),
      button("1:1", "One pixel of the report's picture on one of the screen", () => this.oneToOne()),
    );
    this.root = element("div", { class: "viewer" }, this.canvas, element("div", { class: "bar" }, this.readout, this.tools));
    this.image = new Image();
    this.image.onload = () => this.fit();
    this.image.src = image(sheet.image);
    this.listen();
    this.watch = new ResizeObserver(() => this.fitted ? this.fit() : this.paint());
    this.watch.observe(this.canvas);
    this.ready = sheet.data ? Values.of(sheet.data).then((values) => this.take(values)) : Promise.resolve();
    this.tell();
  }

  close() {
    this.watch.disconnect();
  }

  take(values) {
    this.values = values;
    this.tell();
  }

  listen() {
    const canvas = this.canvas;
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.002)), event.offsetX, event.offsetY);
    }, { passive: false });
    canvas.addEventListener("dblclick", (event) => this.zoom(event.shiftKey ? 0.5 : 2, event.offsetX, event.offsetY));
    canvas.addEventListener("pointerdown", (event) => {
      this.dragged = [event.clientX, event.clientY];
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointerup", () => { this.dragged = null; });
    canvas.addEventListener("pointercancel", () => { this.dragged = null; });
    canvas.addEventListener("pointermove", (event) => {
      if (this.dragged) this.move(event.clientX - this.dragged[0], event.clientY - this.dragged[1]);
      if (this.dragged) this.dragged = [event.clientX, event.clientY];
      this.place = [event.offsetX, event.offsetY];
      this.tell();
    });
    canvas.addEventListener("pointerleave", () => { this.place = null; this.tell(); });
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  key(event) {
    const acts = { "+": () => this.zoom(1.5), "-": () => this.zoom(1 / 1.5), 0: () => this.fit(), 1: () => this.oneToOne() };
    if (!acts[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    acts[event.key]();
  }

  // Pixels of the screen for one of the picture, and where its corner stands.
  set(scale, x, y) {
    [this.scale, this.x, this.y] = [scale, x, y];
    this.paint();
    this.tell();
  }

  fit() {
    const { clientWidth, clientHeight } = this.canvas;
    const scale = Math.min(clientWidth / this.sheet.width, clientHeight / this.sheet.height);
    this.set(scale, (clientWidth - this.sheet.width * scale) / 2, (clientHeight - this.sheet.height * scale) / 2);
    this.fitted = true;
  }

  oneToOne() {
    this.zoom(1 / this.scale);
  }

  zoom(factor, x = this.canvas.clientWidth / 2, y = this.canvas.clientHeight / 2) {
    const scale = Math.min(MOST, Math.max(0.1, this.scale * factor));
    const kept = scale / this.scale;
    this.fitted = false;
    this.set(scale, x - (x - this.x) * kept, y - (y - this.y) * kept);
  }

  move(x, y) {
    this.fitted = false;
    this.set(this.scale, this.x + x, this.y + y);
  }

  paint() {
    const canvas = this.canvas;
    const density = window.devicePixelRatio || 1;
    canvas.width = Math.round(canvas.clientWidth * density);
    canvas.height = Math.round(canvas.clientHeight * density);
    const context = canvas.getContext("2d");
    context.scale(density, density);
    context.imageSmoothingEnabled = this.scale < 2;
    context.drawImage(this.image, this.x, this.y, this.sheet.width * this.scale, this.sheet.height * this.scale);
  }

  // The column and row of the packed array under a place on the canvas.
  cell([x, y]) {
    const { data, width, height } = this.sheet;
    const column = Math.floor((((x - this.x) / this.scale) * data.width) / width);
    const row = Math.floor((((y - this.y) / this.scale) * data.height) / height);
    return column >= 0 && row >= 0 && column < data.width && row < data.height ? [column, row] : null;
  }

  tell() {
    const { data } = this.sheet;
    this.readout.replaceChildren(...this.words(data).filter(Boolean).map((text) => element("span", {}, text)));
  }

  words(data) {
    if (!data) return ["A drawing: its pixels have no values of their own."];
    const [height, width] = data.full;
    const zoom = this.scale ? `${Math.round(this.scale * 100)} %` : "";
    if (!this.place || !this.values) return [`${width} × ${height}`, zoom, precision(data)];
    const cell = this.cell(this.place);
    if (!cell) return [`${width} × ${height}`, zoom];
    const [x, y] = this.values.original(...cell);
    const numbers = this.values.at(...cell).map((value, channel) => {
      const name = data.names[channel] || (data.channels > 1 ? `[${channel}]` : "");
      return `${name ? `${name} ` : ""}${number(value, data.whole)}`;
    });
    return [`at ${x}, ${y}`, ...numbers];
  }
}

function precision(data) {
  const sampled = data.width === data.full[1] && data.height === data.full[0] ? "" : "sampled, ";
  if (data.exact) return `${sampled}exact`;
  return `${sampled}± ${(Math.max(...data.step) / 2).toPrecision(1)}`;
}
