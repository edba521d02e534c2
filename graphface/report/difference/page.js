// The page of a comparison: the nodes in a list, the chosen one under the viewer, or all of them in one column.
"use strict";
(() => {
  const {make, url, difference, paint} = GraphfaceCompare;
  const read = id => JSON.parse(document.getElementById(id).textContent);
  const found = read("found"), blobs = read("blobs"), root = document.getElementById("differences");

  const head = make("header", {},
    make("div", {className: "sides"}, ...found.sides.map(side => make("div", {}, make("b", {}, side.label), " ", make("span", {}, side.title)))),
    make("p", {className: "summary"}, found.summary));
  for (const note of found.notes) head.append(make("p", {className: "note"}, note));

  const list = make("nav", {ariaLabel: "nodes that differ, in order"}), main = make("main");
  root.append(head, make("div", {className: "columns"}, list, main));
  if (!found.nodes.length) { list.hidden = true; main.append(make("p", {className: "equal"}, "Nothing differs.")); return; }

  // Bars grow with the square root of the difference: a hundredth of the range is a tenth of the bar.
  const share = node => node.size === null ? 1 : Math.max(0.02, Math.min(1, Math.sqrt(node.size)));
  const all = make("button", {type: "button", className: "all", onclick: () => open(-1)}, "All nodes in one column");
  list.append(all);
  const entries = found.nodes.map((node, index) => {
    const bar = make("span", {className: "bar"});
    bar.style.width = `${100 * share(node)}%`;
    const entry = make("button", {type: "button", title: node.cause, onclick: () => open(index)},
      make("span", {className: "name"}, node.name), make("span", {className: "short"}, node.short),
      make("span", {className: "track"}, bar));
    if (node.caused) entry.append(make("span", {className: "changed"}, "changed here"));
    entry.classList.toggle("caused", node.caused);
    list.append(entry);
    return entry;
  });

  const title = make("h1"), cause = make("p", {className: "cause"}), parts = make("table", {className: "parts"});
  const tabs = make("div", {className: "tabs", role: "group", ariaLabel: "part of the value"}), place = make("div", {className: "viewer"});
  const column = make("div", {className: "column"});
  const single = make("div", {className: "single"}, title, cause, tabs, place, parts);
  main.append(single, column);
  const viewer = GraphfaceCompare(place, blobs);
  let now = found.first;

  function open(index) {
    now = index;
    entries.forEach((entry, i) => entry.setAttribute("aria-current", i === index));
    all.setAttribute("aria-current", index < 0);
    single.hidden = index < 0;
    column.hidden = index >= 0;
    if (index < 0) { fill(); return; }
    const node = found.nodes[index];
    entries[index].scrollIntoView({block: "nearest"});
    title.textContent = node.title;
    cause.replaceChildren(...described(node));
    parts.replaceChildren(...node.parts.map(([path, words, at]) => make("tr", {},
      make("th", {scope: "row"}, path || "value"), make("td", {}, words), make("td", {}, at && `greatest at ${at}`))));
    tabs.hidden = node.panels.length < 2;
    tabs.replaceChildren(...node.panels.map((panel, i) => make("button", {type: "button", onclick: () => choose(node, i)}, panel.label)));
    // What has a value under each pixel says more than a drawing of all parts.
    choose(node, Math.max(0, node.panels.findIndex(panel => panel.layers.every(layer => layer.data))));
  }

  // What was changed at the node; or links to the nodes above from which it has its difference.
  function described(node) {
    if (node.caused || !node.above.length) return [make("span", {className: node.caused ? "changed" : ""}, node.cause || "")];
    const links = node.above.map(name => {
      const index = found.nodes.findIndex(other => other.name === name);
      return index < 0 ? make("span", {}, name) : make("a", {href: "#", onclick: event => { event.preventDefault(); open(index); }}, name);
    });
    return ["inherited from ", ...links.flatMap((link, i) => i ? [", ", link] : [link])];
  }

  function choose(node, index) {
    [...tabs.children].forEach((tab, i) => tab.setAttribute("aria-pressed", i === index));
    const panel = node.panels[index];
    viewer.show({layers: panel.layers.map((layer, i) => ({...layer, title: found.sides[i].title})), mask: panel.mask ?? null, marks: panel.marks ?? null});
  }

  function fill() {
    if (column.childElementCount) return;
    const seen = new IntersectionObserver(records => records.filter(r => r.isIntersecting).forEach(async ({target}) => {
      seen.unobserve(target);
      const panel = target.panel, signed = await difference(...panel.layers, blobs);
      if (signed.why) target.replaceWith(make("div", {className: "why"}, signed.why));
      else paint(target, signed, 1);
    }));
    column.append(make("div", {className: "row heads"}, ...[...found.sides.map(s => s.label), `${found.sides[1].label} − ${found.sides[0].label}`].map(text => make("b", {}, text))));
    found.nodes.forEach((node, index) => {
      const panel = node.panels.find(p => p.layers.every(l => l.data)) || node.panels[0], row = make("div", {className: "row"});
      for (const layer of panel.layers)
        row.append(layer.message ? make("div", {className: "why"}, layer.message)
          : make("img", {src: url(layer, blobs), alt: `${node.name}, ${layer.label}`, width: layer.width, height: layer.height, loading: "lazy"}));
      const canvas = make("canvas", {width: panel.layers[0].width || 4, height: panel.layers[0].height || 3});
      canvas.panel = panel;
      row.append(canvas);
      seen.observe(canvas);
      column.append(make("h2", {}, make("a", {href: "#", onclick: event => { event.preventDefault(); open(index); }}, node.name),
        make("span", {className: "short"}, ` ${node.short}`), node.caused ? make("span", {className: "changed"}, ` ${node.cause}`) : ""), row);
    });
  }

  document.addEventListener("keydown", event => {
    if (event.target.closest("input, select, textarea") || event.target.closest(".gc-handle")) return;
    const step = {ArrowDown: 1, ArrowUp: -1, j: 1, k: -1}[event.key];
    if (!step || event.ctrlKey || event.metaKey || event.altKey || now < 0) return;
    event.preventDefault();
    open(Math.max(0, Math.min(found.nodes.length - 1, now + step)));
    entries[now].focus({preventScroll: true});
  });
  open(now);
})();
