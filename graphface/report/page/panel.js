// The panel: everything about one node.

let viewer = null;

function link(name, text = name, attributes = {}) {
  const shown = element("a", { href: `#${encodeURIComponent(name)}`, ...attributes }, text);
  shown.dataset.to = name;
  return shown;
}

function thumbnail(node, field = "") {
  const sheet = node.sheets.find((one) => one.label === field) || node.sheets[0];
  if (sheet) return element("img", { src: image(sheet.image), alt: "", width: sheet.width, height: sheet.height });
  return element("span", { class: "none" }, node.reason || STATES[node.state]);
}

function showPanel(node) {
  if (viewer) viewer.close();
  viewer = null;
  const panel = document.getElementById("panel");
  panel.replaceChildren(
    head(node),
    ...failure(node),
    ...(node.error ? feeding(node, "What it was given") : []),
    ...pictures(node),
    ...warnings(node),
    ...figuresOf(node),
    ...(node.error ? [] : feeding(node, "Inputs")),
    ...readers(node),
    ...parameters(node),
    ...documentation(node),
  );
  panel.scrollTop = 0;
}

function head(node) {
  const facts = [];
  if (node.state === "ran") facts.push(`${duration(node.seconds)}, CPU ${duration(node.cpu)}`);
  if (node.state === "failed") facts.push(`after ${duration(node.seconds)}`);
  if (node.bytes) facts.push(size(node.bytes));
  if (node.thread) facts.push(node.thread);
  return element(
    "div",
    { class: "head" },
    element("h2", {}, node.name),
    element("p", {}, badge(node), " ", facts.join(" · ")),
    node.reason && node.state !== "failed" ? element("p", { class: "reason" }, node.reason) : null,
    element("p", { class: "small" }, `${node.operator || "input"} → ${node.type}`, node.place ? ` · ${node.place}` : ""),
    node.origin ? element("p", { class: "small" }, `from ${node.origin}`) : null,
  );
}

function failure(node) {
  if (node.state === "failed" && !node.error) return [element("pre", { class: "error" }, node.reason)];
  if (node.state === "stopped") return [element("pre", { class: "error" }, `The run ended here: ${REPORT.stopped}`)];
  if (!node.error) return [];
  const { reason, code, inputs, files } = node.error;
  const given = Object.entries(inputs).map(([port, text]) => `${port}: ${text}`);
  return [
    element("pre", { class: "error" }, reason),
    code ? element("pre", { class: "code" }, code) : null,
    given.length ? element("pre", { class: "code" }, given.join("\n")) : null,
    files.length ? element("p", { class: "small" }, `made from ${files.join(", ")}`) : null,
  ].filter(Boolean);
}

function pictures(node) {
  if (!node.sheets.length) {
    return node.error ? [] : [element("div", { class: "none large" }, node.reason || STATES[node.state])];
  }
  const host = element("div", { class: "pictures" });
  const note = element("p", { class: "note" });
  const tabs = node.sheets.map((sheet) =>
    element("button", { onclick: () => open(sheet), title: sheet.type }, sheet.label ? `.${sheet.label}` : "whole value"),
  );
  const open = (sheet) => {
    if (viewer) viewer.close();
    viewer = new Viewer(sheet);
    host.replaceChildren(viewer.root);
    note.textContent = sheet.note;
    node.sheets.forEach((one, index) => tabs[index].setAttribute("aria-pressed", one === sheet));
  };
  open(node.sheets[0]);
  return [tabs.length > 1 ? element("div", { class: "choice sheets" }, ...tabs) : null, host, note].filter(Boolean);
}

function section(title, ...children) {
  return element("section", {}, element("h3", {}, title), ...children);
}

function warnings(node) {
  const texts = node.warnings || [];
  if (!texts.length) return [];
  return [section("Warnings", element("ul", { class: "warnings" }, ...texts.map((text) => element("li", {}, text))))];
}

function figuresOf(node) {
  const value = node.value ? element("p", { class: "small value" }, node.value) : null;
  if (!node.arrays.length) return value ? [section("Value", value)] : [];
  const rows = node.arrays.map((array) => {
    const count = array.shape.reduce((all, length) => all * length, 1);
    const odd = array.nan + array.infinite;
    const share = odd ? `${number((100 * array.nan) / count)} %` : "none";
    return element(
      "tr",
      {},
      element("th", { scope: "row" }, array.path || "value", element("small", {}, ` ${array.dtype} ${array.shape.join(" × ")}`)),
      element("td", {}, histogram(array)),
      ...[array.low, array.high, array.mean].map((value) => element("td", { class: "number" }, number(value))),
      element("td", { class: odd ? "number odd" : "number" }, share, array.infinite ? `, ${array.infinite} inf` : ""),
    );
  });
  const heads = ["array", "histogram", "min", "max", "mean", "NaN"];
  const table = element(
    "table",
    {},
    element("thead", {}, element("tr", {}, ...heads.map((text) => element("th", { scope: "col" }, text)))),
    element("tbody", {}, ...rows),
  );
  return [section("Value", element("div", { class: "wide" }, table))];
}

function histogram(array) {
  const { counts } = array;
  if (!counts.length) return element("small", {}, "one value");
  const most = Math.max(...counts.map((count) => Math.sqrt(count)));
  const width = 96 / counts.length;
  const bars = counts.map((count, index) => {
    const height = (28 * Math.sqrt(count)) / most;
    return shape("rect", { x: index * width, y: 28 - height, width: width + 0.05, height });
  });
  const title = shape("title", {}, `${counts.length} bins from ${number(array.low)} to ${number(array.high)}; heights are square roots`);
  return shape("svg", { class: "histogram", viewBox: "0 0 96 28", width: 96, height: 28 }, title, ...bars);
}

function feeding(node, title) {
  const rows = node.ports.map((port) => {
    const wires = port.wires.map((wire) => {
      const source = NODES.get(wire.node);
      const name = wire.field ? `${wire.node}.${wire.field}` : wire.node;
      return link(wire.node, [thumbnail(source, wire.field), element("span", {}, name)].flat(), { class: "source" });
    });
    const empty = element("span", { class: "small" }, "nothing plugged in");
    return element(
      "div",
      { class: node.error ? "port big" : "port" },
      element("div", { class: "label" }, element("b", {}, port.port), element("small", {}, ` ${port.type}`)),
      port.declined ? element("p", { class: "reason" }, `declined: ${port.declined}`) : null,
      element("div", { class: "sources" }, ...(wires.length ? wires : [empty])),
    );
  });
  return rows.length ? [section(title, ...rows)] : [];
}

function readers(node) {
  const outputs = REPORT.outputs.filter((output) => output.node === node.name);
  const taken = READERS.get(node.name);
  if (!outputs.length && !taken.length) return [];
  const asked = outputs.map((output) =>
    element("li", {}, element("b", {}, output.name), output.field ? ` (.${output.field})` : "", ", an output that was asked for"),
  );
  const links = taken.map((reader) =>
    element("li", {}, link(reader.node), element("small", {}, ` ${reader.port}${reader.field ? ` takes .${reader.field}` : ""}`)),
  );
  return [section("Goes to", element("ul", {}, ...asked, ...links))];
}

function parameters(node) {
  if (!node.parameters.length) return [];
  const rows = node.parameters.map((one) =>
    element(
      "tr",
      { class: one.set ? "set" : "" },
      element("th", { scope: "row" }, one.name),
      element("td", { class: "text" }, one.value),
      element("td", {}, one.set ? one.place : element("small", {}, "default")),
    ),
  );
  return [section("Parameters", element("div", { class: "wide" }, element("table", {}, element("tbody", {}, ...rows))))];
}

function documentation(node) {
  return node.doc ? [section(node.operator || "About this input", element("div", { class: "doc" }, node.doc))] : [];
}
