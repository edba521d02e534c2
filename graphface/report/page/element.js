"use strict";

// Elements from names and texts. Text becomes text: nothing here parses markup.

const SVG = "http://www.w3.org/2000/svg";

function fill(made, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== null && value !== false) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== ""));
  return made;
}

function element(name, attributes = {}, ...children) {
  return fill(document.createElement(name), attributes, children);
}

function shape(name, attributes = {}, ...children) {
  return fill(document.createElementNS(SVG, name), attributes, children);
}

function stored(id) {
  return JSON.parse(document.getElementById(id).textContent);
}

const REPORT = stored("report");
const RUN = stored("run");
const BLOBS = document.getElementById("blobs").textContent.split("\n");
const NODES = new Map(REPORT.nodes.map((node) => [node.name, node]));
const READERS = new Map(REPORT.nodes.map((node) => [node.name, []]));
for (const node of REPORT.nodes) {
  for (const port of node.ports) {
    for (const wire of port.wires) READERS.get(wire.node).push({ node: node.name, port: port.port, field: wire.field });
  }
}

const STATES = {
  ran: "ran",
  memory: "from memory",
  disk: "from disk",
  skipped: "not run",
  failed: "failed",
  blocked: "blocked",
  stopped: "stopped",
};

// The bytes of a blob: seven bits a character (report/page/seven_bit.py).
function bytesOf(index) {
  const unsafe = [0, 10, 13, 60];
  const text = BLOBS[index];
  const bytes = new Uint8Array(Math.floor((text.length * 7) / 8));
  let [held, bits, at] = [0, 0, 0];
  for (let i = 0; i < text.length; i++) {
    const code = text.charCodeAt(i);
    held = ((held << 7) | (code < 128 ? code : unsafe[code - 128])) & 0x7fff;
    bits += 7;
    if (bits >= 8) {
      bits -= 8;
      bytes[at++] = held >> bits;
    }
  }
  return bytes;
}

const IMAGES = new Map();

function image(index) {
  if (!IMAGES.has(index)) IMAGES.set(index, URL.createObjectURL(new Blob([bytesOf(index)], { type: "image/webp" })));
  return IMAGES.get(index);
}

function duration(seconds) {
  if (seconds >= 100) return `${seconds.toFixed(0)} s`;
  if (seconds >= 1) return `${seconds.toFixed(2)} s`;
  const milliseconds = seconds * 1000;
  return `${milliseconds >= 10 ? milliseconds.toFixed(0) : milliseconds.toFixed(1)} ms`;
}

function size(bytes) {
  if (bytes >= 1e9) return `${(bytes / 1e9).toFixed(2)} GB`;
  if (bytes >= 1e6) return `${(bytes / 1e6).toFixed(1)} MB`;
  if (bytes >= 1e3) return `${(bytes / 1e3).toFixed(1)} kB`;
  return `${bytes} B`;
}

// A number of a float32: five digits say all that 16 bits hold.
function number(value, whole = false) {
  if (typeof value !== "number") return String(value);
  if (Number.isNaN(value)) return "NaN";
  if (!Number.isFinite(value)) return value > 0 ? "+inf" : "−inf";
  if (whole) return String(Math.round(value));
  if (value === 0) return "0";
  const large = Math.abs(value);
  const text = large >= 1e6 || large < 1e-4 ? value.toExponential(3) : String(Number(value.toPrecision(5)));
  return text.replace("-", "−");
}

function badge(node) {
  return element("span", { class: `state ${node.state}` }, STATES[node.state]);
}
