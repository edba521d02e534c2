// When each node ran, by thread.

function setUpTimeline() {
  const view = document.getElementById("view-timeline");
  const ran = REPORT.nodes.filter((node) => typeof node.start === "number" && node.seconds !== undefined);
  if (!ran.length) {
    view.append(element("p", { class: "none large" }, "No node ran, or nobody followed when they did: nothing to show by time."));
    return;
  }
  const end = Math.max(...ran.map((node) => node.start + node.seconds), 1e-6);
  const threads = [...new Set(ran.map((node) => node.thread))].sort();
  const rows = threads.map((thread) => {
    const bars = ran.filter((node) => node.thread === thread).map((node) => bar(node, end));
    return element("div", { class: "thread" }, element("h3", {}, thread), element("div", { class: "bars" }, ...bars));
  });
  const ticks = scale(end).map((at) => element("span", { style: `left:${(100 * at) / end}%` }, duration(at)));
  const words = `${ran.length} nodes in ${duration(REPORT.seconds)}; ${duration(REPORT.drawing)} of CPU drew this report, which leaves gaps.`;
  view.append(element("p", { class: "small" }, words), element("div", { class: "ticks" }, ...ticks), ...rows);
}

function bar(node, end) {
  const style = `left:${(100 * node.start) / end}%;width:${(100 * node.seconds) / end}%`;
  const title = `${node.name}\n${node.operator || "input"}\nfrom ${duration(node.start)}, ${duration(node.seconds)}`;
  return link(node.name, node.name, { class: `bar ${node.state}`, style, title });
}

// About eight round numbers from 0 to the end.
function scale(end) {
  const raw = end / 8;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((digit) => digit * power).find((one) => one >= raw);
  return Array.from({ length: Math.floor(end / step) + 1 }, (_, index) => index * step);
}
