// Plots of the history that can be enlarged.

const LINES = ["#0b6e8a", "#d1702b", "#6a5acd", "#2e9e5b", "#c2417c", "#8a8f1f", "#7a6150", "#4f7fd1"];

/** Columns by quantity: components and counts of a pair together. */
function quantities() {
  const groups = new Map();
  const add = (title, name, column) => {
    if (!groups.has(title)) groups.set(title, []);
    groups.get(title).push({ name, column });
  };
  results.columns.forEach((column, at) => {
    const parts = column.split(".");
    const last = parts.at(-1);
    if (["increment", "step", "time", "cutbacks"].includes(column)) return;
    if (parts[0] === "energy") return add("energies", inWords(last), at);
    if (parts[0] === "pair" && parts.length > 2) {
      const names = parts.slice(1, -1);
      if (["stick", "slip", "open"].includes(last)) return add(`nodes of ${names.join(".")}`, last, at);
      if (["x", "y", "z"].includes(last)) {
        const what = names.pop().replace(/^resultant_/, "force on ");
        return add(`${inWords(what)} of ${names.join(".")}`, last, at);
      }
      return add(`${inWords(last)} of ${names.join(".")}`, inWords(last), at);
    }
    if (["x", "y", "z"].includes(last)) return add(inWords(parts.slice(0, -1).join(" ")), last, at);
    return add(inWords(column), inWords(column), at);
  });
  return groups;
}

class Plot {
  constructor(groups, first) {
    this.groups = groups;
    this.select = element("select", { ariaLabel: "Quantity" });
    for (const title of groups.keys()) this.select.append(element("option", { value: title, textContent: title }));
    this.select.value = first;
    this.svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    this.keys = element("div", { className: "keys" });
    this.node = element("div", { className: "plot" }, this.select, this.svg, this.keys);
    this.times = results.rows.map((row) => row[results.columns.indexOf("time")]);
    this.off = new Set();
    this.select.addEventListener("change", () => { this.off.clear(); this.draw(); });
    this.seeAll();
    this.listen();
  }

  seeAll() {
    this.span = [Math.min(0, this.times[0]), this.times.at(-1) || 1];
  }

  box() {
    const { width, height } = this.svg.getBoundingClientRect();
    return { left: 64, right: Math.max(width - 12, 80), top: 10, bottom: Math.max(height - 34, 40) };
  }

  time(x) {
    const { left, right } = this.box();
    const share = (x - this.svg.getBoundingClientRect().left - left) / (right - left);
    return this.span[0] + Math.min(1, Math.max(0, share)) * (this.span[1] - this.span[0]);
  }

  listen() {
    this.svg.addEventListener("pointerdown", (event) => {
      this.from = this.time(event.clientX);
      this.svg.setPointerCapture(event.pointerId);
    });
    this.svg.addEventListener("pointermove", (event) => {
      this.at = this.time(event.clientX);
      this.draw();
    });
    this.svg.addEventListener("pointerup", () => {
      const span = [this.from, this.at].sort((a, b) => a - b);
      if (span[1] - span[0] > 0.01 * (this.span[1] - this.span[0])) this.span = span;
      this.from = undefined;
      this.draw();
    });
    this.svg.addEventListener("pointerleave", () => { this.at = undefined; this.draw(); });
    this.svg.addEventListener("dblclick", () => { this.seeAll(); this.draw(); });
    this.svg.addEventListener("wheel", (event) => {
      event.preventDefault();
      const about = this.time(event.clientX);
      const factor = event.deltaY > 0 ? 1.25 : 0.8;
      const [first, last] = [Math.min(0, this.times[0]), this.times.at(-1)];
      this.span = this.span.map((end) => Math.min(last, Math.max(first, about + (end - about) * factor)));
      this.draw();
    }, { passive: false });
    document.addEventListener("moment", (event) => { this.now = event.detail; this.draw(); });
    new ResizeObserver(() => this.draw()).observe(this.svg);
  }

  draw() {
    const curves = this.groups.get(this.select.value).map((curve, at) => ({ ...curve, color: LINES[at % LINES.length] }));
    const seen = curves.filter((curve) => !this.off.has(curve.name));
    const box = this.box();
    const inside = this.times.map((time) => time >= this.span[0] && time <= this.span[1]);
    const values = seen.flatMap((curve) => results.rows.filter((_, at) => inside[at]).map((row) => row[curve.column]));
    let [low, high] = values.filter(Number.isFinite).reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [0, 0]);
    if (!(high > low)) [low, high] = [low - 1, high + 1];
    const pad = 0.05 * (high - low);
    [low, high] = [low < 0 ? low - pad : low, high > 0 ? high + pad : high];
    const x = (time) => box.left + ((time - this.span[0]) / (this.span[1] - this.span[0])) * (box.right - box.left);
    const y = (value) => box.bottom - ((value - low) / (high - low)) * (box.bottom - box.top);
    const out = [];
    for (const value of ticks(low, high, 5)) {
      const mark = Math.abs(value) < 1e-9 * (high - low) ? 0 : value;
      out.push(`<line class="grid" x1="${box.left}" x2="${box.right}" y1="${y(value)}" y2="${y(value)}"/>`);
      out.push(`<text x="${box.left - 8}" y="${y(value) + 4}" text-anchor="end">${written(mark)}</text>`);
    }
    for (const time of ticks(...this.span, 6)) {
      out.push(`<line class="axis" x1="${x(time)}" x2="${x(time)}" y1="${box.bottom}" y2="${box.bottom + 4}"/>`);
      out.push(`<text x="${x(time)}" y="${box.bottom + 18}" text-anchor="middle">${written(Math.abs(time) < 1e-12 ? 0 : time)}</text>`);
    }
    out.push(`<text x="${box.right}" y="${box.bottom + 32}" text-anchor="end">time</text>`);
    out.push(`<line class="axis" x1="${box.left}" x2="${box.right}" y1="${box.bottom}" y2="${box.bottom}"/>`);
    const id = (this.id ??= `clip-${Math.random().toString(36).slice(2)}`);
    out.push(`<clipPath id="${id}"><rect x="${box.left}" y="0" width="${box.right - box.left}" height="${box.bottom + 1}"/></clipPath>`);
    for (const curve of seen) {
      const points = results.rows.map((row, at) => `${x(this.times[at]).toFixed(2)},${y(row[curve.column]).toFixed(2)}`);
      if (points.length === 1) out.push(`<circle cx="${points[0].split(",")[0]}" cy="${points[0].split(",")[1]}" r="3" fill="${curve.color}"/>`);
      out.push(`<polyline class="curve" clip-path="url(#${id})" stroke="${curve.color}" points="${points.join(" ")}"/>`);
    }
    if (this.now >= this.span[0] && this.now <= this.span[1]) {
      out.push(`<line class="now" x1="${x(this.now)}" x2="${x(this.now)}" y1="${box.top}" y2="${box.bottom}"/>`);
    }
    if (this.from !== undefined && this.at !== undefined) {
      const [a, b] = [x(this.from), x(this.at)].sort((p, q) => p - q);
      out.push(`<rect class="brush" x="${a}" y="${box.top}" width="${b - a}" height="${box.bottom - box.top}"/>`);
    }
    this.svg.innerHTML = out.join("");
    this.tell(curves);
  }

  /** Names of the curves, with their values at the pointer or at the time of the picture. */
  tell(curves) {
    const wanted = this.at ?? this.now ?? this.times.at(-1);
    const far = (at) => Math.abs(this.times[at] - wanted);
    const row = this.times.reduce((best, _, at) => (far(at) < far(best) ? at : best), 0);
    this.keys.replaceChildren(...curves.map((curve) => {
      const line = element("i");
      line.style.background = curve.color;
      const key = element("button", { type: "button", className: this.off.has(curve.name) ? "off" : "" },
        line, `${curve.name}  ${written(results.rows[row][curve.column])}`);
      key.addEventListener("click", () => {
        if (!this.off.delete(curve.name)) this.off.add(curve.name);
        this.draw();
      });
      return key;
    }), element("span", { className: "hint", textContent: `at time ${written(this.times[row])}` }));
  }
}

function beginHistory() {
  if (!results.rows.length) return;
  byId("history").hidden = false;
  const groups = quantities();
  const titles = [...groups.keys()];
  // With contact of everything most pairs never touch.
  const largest = (title) => groups.get(title).reduce(
    (most, { column }) => results.rows.reduce((most, row) => Math.max(most, Math.abs(row[column]) || 0), most), 0);
  const forces = titles.filter((title) => title.startsWith("force on a "));
  const force = forces.sort((one, other) => largest(other) - largest(one))[0] ?? titles.find((title) => title.startsWith("reaction")) ?? titles[0];
  const energies = titles.find((title) => title === "energies") ?? titles.at(-1);
  for (const first of [force, energies]) {
    const plot = new Plot(groups, first);
    byId("plots").append(plot.node);
    plot.draw();
  }
}

beginHistory();
