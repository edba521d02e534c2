// Search by name, operator and warning. Arrow keys walk through what was found, Enter goes there.

const LONGEST = 12;

function matches(node, words) {
  const text = [node.name, node.operator, node.reason, ...(node.warnings || [])].join("\n").toLowerCase();
  return words.every((word) => text.includes(word));
}

function setUpSearch(choose) {
  const field = document.getElementById("search");
  const list = document.getElementById("found");
  let found = [];
  let at = 0;

  const close = () => {
    list.hidden = true;
    field.setAttribute("aria-expanded", "false");
  };
  const go = (node) => {
    close();
    field.blur();
    choose(node.name);
  };
  const paint = () => {
    const rows = found.slice(0, LONGEST).map((node, index) =>
      element(
        "li",
        { role: "option", "aria-selected": index === at, onpointerdown: (event) => { event.preventDefault(); go(node); } },
        element("b", {}, node.name),
        element("small", {}, ` ${node.operator || "input"} `),
        badge(node),
        ...(node.warnings || []).map((text) => element("small", { class: "odd" }, ` ${text}`)),
      ),
    );
    const rest = found.length - rows.length;
    if (rest > 0) rows.push(element("li", { class: "small" }, `and ${rest} more`));
    if (!found.length) rows.push(element("li", { class: "small" }, "nothing of that name, operator or warning"));
    list.replaceChildren(...rows);
  };
  const look = () => {
    const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
    found = words.length ? REPORT.nodes.filter((node) => matches(node, words)) : [];
    at = 0;
    list.hidden = !words.length;
    field.setAttribute("aria-expanded", String(!list.hidden));
    for (const node of REPORT.nodes) {
      const group = groupOf(node.name);
      if (group) group.classList.toggle("faint", words.length > 0 && !found.includes(node));
    }
    paint();
  };

  field.addEventListener("input", look);
  field.addEventListener("focus", () => { if (field.value) look(); });
  field.addEventListener("blur", close);
  field.addEventListener("keydown", (event) => {
    const last = Math.min(found.length, LONGEST) - 1;
    if (event.key === "ArrowDown") at = Math.min(at + 1, last);
    else if (event.key === "ArrowUp") at = Math.max(at - 1, 0);
    else if (event.key === "Enter" && found[at]) return go(found[at]);
    else if (event.key === "Escape") {
      field.value = "";
      look();
      field.blur();
      return undefined;
    } else return undefined;
    event.preventDefault();
    return paint();
  });
}
