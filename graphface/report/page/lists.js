// The other views: all nodes as a table, the graph as YAML, what went in and what it ran on.

const COLUMNS = [
  ["#", (node) => REPORT.nodes.indexOf(node)], // as in the graph: each after what it depends on
  ["node", (node) => node.name],
  ["operator", (node) => node.operator || "input"],
  ["state", (node) => node.state],
  ["time", (node) => node.seconds || 0],
  ["memory", (node) => node.bytes || 0],
  ["warnings", (node) => (node.warnings || []).length],
];

function setUpLists() {
  nodeTable("#", false);
  document.getElementById("view-yaml").append(element("pre", { class: "code" }, REPORT.yaml));
  const inputs = REPORT.inputs.map((one) =>
    element("tr", {}, element("th", { scope: "row" }, link(one.name)), ...[one.type, one.origin, one.digest].map((text) => element("td", {}, text))),
  );
  const versions = Object.entries({ ...RUN.versions, platform: RUN.platform, made: REPORT.made }).map(([name, text]) =>
    element("tr", {}, element("th", { scope: "row" }, name), element("td", {}, text)),
  );
  const table = (heads, rows) =>
    element("table", {}, element("thead", {}, element("tr", {}, ...heads.map((text) => element("th", { scope: "col" }, text)))), element("tbody", {}, ...rows));
  document.getElementById("view-run").append(
    element("h3", {}, "Inputs"),
    element("div", { class: "wide" }, table(["input", "type", "from", "digest"], inputs)),
    element("h3", {}, "Versions"),
    table(["of", "version"], versions),
  );
}

function nodeTable(by, down) {
  const value = COLUMNS.find(([name]) => name === by)[1];
  const order = (a, b) => (value(a) < value(b) ? -1 : value(a) > value(b) ? 1 : 0) * (down ? -1 : 1);
  const heads = COLUMNS.map(([name]) => {
    const sorted = name === by ? (down ? "descending" : "ascending") : "none";
    const act = () => nodeTable(name, name === by ? !down : ["time", "memory", "warnings"].includes(name));
    return element("th", { scope: "col", "aria-sort": sorted }, element("button", { onclick: act }, name));
  });
  const rows = [...REPORT.nodes].sort(order).map((node) =>
    element(
      "tr",
      {},
      element("td", { class: "number" }, REPORT.nodes.indexOf(node) + 1),
      element("th", { scope: "row" }, link(node.name, [thumbnailOnly(node), element("span", {}, node.name)], { class: "source" })),
      element("td", {}, node.operator || "input"),
      element("td", {}, badge(node), node.reason ? element("small", {}, ` ${node.reason}`) : null),
      element("td", { class: "number" }, node.state === "ran" || node.state === "failed" ? duration(node.seconds) : ""),
      element("td", { class: "number" }, node.bytes ? size(node.bytes) : ""),
      element("td", {}, (node.warnings || []).join("; ")),
    ),
  );
  document.getElementById("view-nodes").replaceChildren(
    element("table", { class: "nodes" }, element("thead", {}, element("tr", {}, ...heads)), element("tbody", {}, ...rows)),
  );
}

function thumbnailOnly(node) {
  return node.sheets.length ? thumbnail(node) : element("span", { class: "none" });
}
