// The page of an ablation: a table of variants, and what each of them gives, at the output or at any node that differs.
"use strict";
(() => {
  const {make} = GraphfaceCompare;
  const read = id => JSON.parse(document.getElementById(id).textContent);
  const ablated = read("ablated"), blobs = read("blobs"), root = document.getElementById("ablation");
  const [names, ...figures] = ablated.columns;

  const heads = ablated.columns.map(c => make("th", {scope: "col", title: c.meaning}, c.title,
    c.meaning === "higher is better" ? " ↑" : c.meaning === "lower is better" ? " ↓" : ""));
  const lines = names.texts.map((name, row) => {
    const key = row < 9 ? make("kbd", {}, String(row + 1)) : "";
    const line = make("tr", {tabIndex: 0, onclick: () => choose(row), onkeydown: e => { if (e.key === "Enter") choose(row); }},
      make("th", {scope: "row"}, key, " ", name),
      ...figures.map(c => make("td", {className: c.best.includes(row) ? "best" : "", title: c.best.includes(row) ? `the best: ${c.meaning}` : ""}, c.texts[row])));
    return line;
  });
  const table = make("table", {}, make("thead", {}, make("tr", {}, ...heads)), make("tbody", {}, ...lines));

  const cases = make("select", {id: "case", onchange: () => show()}, ...ablated.cases.map((c, i) => make("option", {value: i}, c.label)));
  const places = make("select", {id: "place", onchange: () => show()});
  const area = make("div", {className: "viewer"});
  const hint = "A line, or its number, chooses what flicker, wipe and difference show; green is the best of a column.";
  root.append(make("h1", {}, ablated.title), make("div", {className: "scroll"}, table),
    make("p", {className: "sharing", title: ablated.sharing}, `${hint} ${ablated.sharing}`), area);
  const viewer = GraphfaceCompare(area, blobs);
  viewer.bar.prepend(make("label", {}, "Show ", places), make("label", {hidden: ablated.cases.length < 2}, "of ", cases));

  let variant = Math.min(1, names.texts.length - 1), first = 0;

  // Original and truth stand before the variants, at the output; elsewhere the first variant is what others are held against.
  function show() {
    const now = ablated.cases[+cases.value], kept = places.value;
    places.replaceChildren(...now.places.map((p, i) => make("option", {value: p}, i ? p : `${p} (the output)`)));
    places.value = now.places.includes(kept) ? kept : now.places[0];
    const index = now.places.indexOf(places.value), atOutput = index === 0;
    const before = [now.original, atOutput ? now.truth : null].filter(Boolean);
    first = before.length;
    const layers = [...before, ...now.layers[index].map((layer, v) => layer || {label: names.texts[v], message: "not drawn", note: ""})];
    const reference = atOutput && now.truth ? before.length - 1 : first;
    const chosen = first + variant;
    viewer.show({layers, pair: [reference === chosen && first > 0 && chosen === first ? 0 : reference, chosen]});
    mark();
  }

  function choose(row) {
    variant = row;
    show();
  }

  function mark() { lines.forEach((line, i) => line.setAttribute("aria-selected", i === variant)); }

  document.addEventListener("keydown", event => {
    if (event.target.closest("input, select, textarea") || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key >= "1" && event.key <= "9" && +event.key <= lines.length) choose(+event.key - 1);
    const step = {ArrowRight: 1, ArrowLeft: -1}[event.key];
    if (step && !event.target.closest(".gc-handle")) choose((variant + step + lines.length) % lines.length);
  });
  show();
})();
