// What the controls beside the picture do.

const UNIT_VECTORS = ["texture"];

class Controls {
  constructor(view) {
    this.view = view;
    this.time = results.times.length - 1;
    this.own = null;
    this.opacityChosen = false;
    this.turn = Promise.resolve();
    this.fields = this.namesOfFields();
    this.fillFields();
    this.fillArrows();
    this.fillParts();
    this.listen();
  }

  /** Every field once, with the parts that have it. */
  namesOfFields() {
    const fields = new Map();
    for (const kind of ["contact", "body", "rigid"]) {
      results.parts.forEach((part, at) => {
        if (part.kind !== kind) return;
        for (const field of part.fields) {
          if (field.name === "motion") continue;
          const key = `${kind === "contact" ? "contact" : "body"}/${field.name}`;
          if (!fields.has(key)) fields.set(key, { key, kind, name: field.name, order: field.order, on: new Map() });
          fields.get(key).on.set(at, field);
        }
      });
    }
    return fields;
  }

  fillFields() {
    const select = byId("field");
    select.append(element("option", { value: "", textContent: "none" }));
    for (const [kind, label] of [["contact", "Contact"], ["body", "Bodies"], ["rigid", "Rigid surfaces"]]) {
      const group = element("optgroup", { label });
      for (const field of this.fields.values()) {
        if (field.kind === kind) group.append(element("option", { value: field.key, textContent: inWords(field.name) }));
      }
      if (group.children.length) select.append(group);
    }
    const first = ["contact/mean_pressure", "contact/pressure", "body/cauchy_stress", "body/displacement"].find((key) => this.fields.has(key));
    select.value = first ?? "";
    this.fillComponents();
  }

  fillComponents() {
    const order = this.fields.get(byId("field").value)?.order ?? ["value"];
    byId("component").replaceChildren(...order.map((name) => element("option", { value: name, textContent: name })));
    byId("component").parentElement.hidden = order.length === 1;
  }

  fillArrows() {
    byId("arrows").append(element("option", { value: "", textContent: "none" }));
    for (const field of this.fields.values()) {
      if (field.order.length !== 4) continue;
      const where = field.kind === "contact" ? "contact: " : "";
      byId("arrows").append(element("option", { value: field.key, textContent: where + inWords(field.name) }));
    }
  }

  fillParts() {
    // The two sides of a pair lie on each other: at first the smaller one is shown, as the larger
    // one has nodes beside the contact.
    const smaller = new Map();
    const pairOf = (part) => part.head.name.slice(0, part.head.name.lastIndexOf(`-${this.bodyOf(part)}`));
    for (const part of this.view.parts.filter((part) => part.head.kind === "contact")) {
      const [pair, area] = [pairOf(part), this.view.area(part)];
      if (!smaller.has(pair) || area < smaller.get(pair).area) smaller.set(pair, { part, area });
    }
    for (const part of this.view.parts) {
      part.visible = part.head.kind !== "contact" || smaller.get(pairOf(part)).part === part;
      const box = element("input", { type: "checkbox", checked: part.visible });
      box.addEventListener("change", () => {
        part.visible = box.checked;
        this.refresh();
      });
      const swatch = element("i", { className: "swatch" });
      swatch.style.background = part.head.kind === "contact" ? "linear-gradient(90deg, #f5b86d, #96243a)" : part.color;
      const kind = part.head.kind === "contact" ? "contact " : "";
      byId("parts").append(element("label", {}, box, swatch, kind + part.head.name));
    }
  }

  bodyOf(part) {
    return part.head.follows ? results.parts[part.head.follows[0]].name : "";
  }

  listen() {
    const on = (id, event, action) => byId(id).addEventListener(event, () => { action?.(); this.refresh(); });
    on("field", "change", () => { this.own = null; this.fillComponents(); });
    on("component", "change", () => { this.own = null; });
    on("range", "change");
    on("own-min", "change");
    on("own-max", "change");
    for (const id of ["bands", "arrows", "scale", "cut", "cut-side", "edges"]) on(id, "change");
    on("arrow-size", "input");
    on("cut-place", "input");
    on("opacity", "input", () => { this.opacityChosen = true; });
    on("time", "input", () => { this.time = Number(byId("time").value); });
    byId("play").addEventListener("click", () => this.play());
    for (const button of document.querySelectorAll("[data-from]")) {
      button.addEventListener("click", () => this.view.lookFrom(button.dataset.from.split(",").map(Number)));
    }
    byId("save").addEventListener("click", () => this.save());
    let pressed;
    this.view.canvas.addEventListener("pointerdown", (event) => { pressed = [event.clientX, event.clientY]; });
    this.view.canvas.addEventListener("pointerup", (event) => {
      const way = Math.hypot(event.clientX - pressed?.[0], event.clientY - pressed?.[1]);
      if (way < 4) this.probe(event.clientX, event.clientY);
    });
  }

  /** Draws everything anew, after what is being drawn. */
  refresh() {
    this.again = true;
    this.turn = this.turn.then(async () => {
      if (!this.again) return;
      this.again = false;
      await this.drawn();
    }).catch(failed);
    return this.turn;
  }

  async drawn() {
    const { view } = this;
    const chosen = this.fields.get(byId("field").value);
    const arrows = this.fields.get(byId("arrows").value);
    if (!this.opacityChosen) {
      const through = chosen?.kind === "contact" || arrows?.kind === "contact";
      byId("opacity").value = through ? 0.1 : 1;
    }
    view.opacity = Number(byId("opacity").value);
    view.edged = byId("edges").checked;
    view.contactColored = chosen?.kind === "contact";
    await view.deform(this.time, Number(byId("scale").value));
    await this.drawColors(chosen);
    await this.drawArrows(arrows);
    this.drawCut();
    view.recolored();
    this.tellTime();
    view.now();
    document.body.dataset.drawn = Number(document.body.dataset.drawn ?? 0) + 1;
  }

  async drawColors(chosen) {
    byId("legend").hidden = !chosen;
    if (!chosen) {
      this.view.restrict([]);
      return this.view.color([], null);
    }
    const component = byId("component").value;
    const values = [];
    for (const [at, field] of chosen.on) values[at] = await viewed(field, component, this.time);
    const extremes = this.extremes(chosen, component);
    const [low, high] = this.limits(extremes);
    const bands = byId("bands").checked;
    const colors = palette(chosen.name, low, high, chosen.kind);
    this.view.restrict(await this.pressures(chosen));
    this.view.color(values, colors, bands);
    this.legend(chosen, component, extremes, colors, bands);
  }

  /** Pressures of the sides of pairs, by part, if the field is one of contact; gaps are seen beside it, too. */
  async pressures(chosen) {
    const known = chosen.kind === "contact" && chosen.name !== "gap" ? this.fields.get("contact/pressure") : null;
    const pressures = [];
    for (const [at, field] of known?.on ?? []) pressures[at] = (await components(field, this.time))?.[0];
    return pressures;
  }

  /** Least and largest value in the files of what is shown, at this time or all. */
  extremes(chosen, component) {
    const all = byId("range").value === "all";
    const shownFields = [...chosen.on].filter(([at]) => this.view.parts[at].visible).map(([, field]) => field);
    const known = shownFields.flatMap((field) => {
      const times = field.views[component];
      return all ? times : [times[this.time]];
    });
    const found = known.filter((pair) => pair);
    if (!found.length) return null;
    return [Math.min(...found.map((pair) => pair[0])), Math.max(...found.map((pair) => pair[1]))];
  }

  limits(extremes) {
    const [low, high] = extremes ?? [0, 1];
    const own = byId("range").value === "own";
    byId("own").hidden = !own;
    if (!own) return [low, high];
    if (!this.own) {
      this.own = true;
      byId("own-min").value = low;
      byId("own-max").value = high;
    }
    return [Number(byId("own-min").value), Number(byId("own-max").value)];
  }

  legend(chosen, component, extremes, colors, bands) {
    const component_ = component === "value" ? "" : `, ${component}`;
    byId("legend-title").textContent = inWords(chosen.name) + component_;
    for (const [id, at] of [["legend-min", 0], ["legend-max", 1]]) {
      byId(id).textContent = written(extremes?.[at]);
      byId(id).dataset.value = extremes?.[at] ?? "";
      byId(id).title = extremes ? String(extremes[at]) : "";
    }
    const isStatus = chosen.name === "status";
    byId("legend-range").hidden = isStatus;
    byId("legend-bar").style.background = gradient(colors, colors.bands ?? (bands ? BANDS : 0));
    const flat = !(colors.high > colors.low);
    const marks = isStatus
      ? STATUS.map(({ code, name }) => [code, name])
      : ticks(colors.low, colors.high, 6).map((value) => [value, written(Math.abs(value) < 1e-9 * (colors.high - colors.low) ? 0 : value)]);
    byId("legend-ticks").replaceChildren(...marks.map(([value, text]) => {
      const mark = element("span", { textContent: text });
      mark.style.top = `${flat ? 50 : 100 * (1 - (value - colors.low) / (colors.high - colors.low))}%`;
      return mark;
    }));
  }

  async drawArrows(arrows) {
    const vectors = [];
    if (arrows) for (const [at, field] of arrows.on) vectors[at] = await components(field, this.time);
    const size = 2 ** Number(byId("arrow-size").value);
    const scale = arrows && UNIT_VECTORS.includes(arrows.name) ? 0.7 : 1;
    this.view.drawArrows(vectors, size * scale);
  }

  drawCut() {
    const axis = byId("cut").value;
    byId("cutting").hidden = !axis;
    this.view.clipping = axis !== "";
    if (!axis) return;
    const { low, high } = this.view;
    const share = Number(byId("cut-place").value);
    const place = low[axis] + share * (high[axis] - low[axis]);
    const sign = byId("cut-side").checked ? 1 : -1;
    this.view.cut.normal.set(0, 0, 0)[axis] = sign;
    this.view.cut.constant = -sign * place;
  }

  tellTime() {
    byId("time").max = results.times.length - 1;
    byId("time").value = this.time;
    const time = results.times[this.time];
    byId("moment").textContent = `time ${written(time)}${whereIn(time)}`;
    document.dispatchEvent(new CustomEvent("moment", { detail: time }));
  }

  play() {
    if (this.playing) {
      clearTimeout(this.playing);
      this.playing = null;
    } else {
      if (this.time === results.times.length - 1) this.time = -1;
      const pause = Math.min(400, Math.max(40, 6000 / results.times.length));
      const next = async () => {
        this.time += 1;
        await this.refresh();
        const more = this.playing && this.time < results.times.length - 1;
        this.playing = more ? setTimeout(next, pause) : null;
        this.tellPlaying();
      };
      this.playing = setTimeout(next, 0);
    }
    this.tellPlaying();
  }

  tellPlaying() {
    byId("play").textContent = this.playing ? "❚❚" : "▶";
    byId("play").setAttribute("aria-label", this.playing ? "Pause" : "Play");
  }

  probe(x, y) {
    const found = this.view.under(x, y);
    byId("probe").hidden = !found;
    if (!found) return;
    const chosen = this.fields.get(byId("field").value);
    const { part, node, at } = found;
    const lines = [part.head.name, `nearest node at (${at.map(written).join(", ")})`];
    if (chosen && part.colored) lines.push(`${byId("legend-title").textContent} ${written(part.values[node])}`);
    byId("probe").textContent = lines.join("\n");
  }

  save() {
    this.view.now();
    this.view.canvas.toBlob((picture) => {
      const link = element("a", { href: URL.createObjectURL(picture), download: "picture.png" });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    });
  }
}

/** Step and increment of a time. */
function whereIn(time) {
  const column = (name) => results.columns.indexOf(name);
  const row = results.rows.find((row) => row[column("time")] === time);
  if (!row) return time === 0 ? ", at rest" : "";
  const step = row[column("step")];
  const name = results.steps[step - 1];
  return `, step ${name ? `“${name}”` : step}, increment ${row[column("increment")]}`;
}

function failed(cause) {
  console.error(cause);
  byId("note").hidden = false;
  byId("note").textContent = `The picture cannot be drawn: ${cause.message ?? cause}`;
}

async function begin() {
  if (!results.parts.length || !results.times.length) return;
  byId("model").hidden = false;
  const view = new View(byId("view"));
  await view.load(results.parts);
  view.resized();
  const controls = new Controls(view);
  await controls.refresh();
  view.lookFrom([1, -1.6, 0.9]);
  if (results.times.length < results.written) {
    byId("note").hidden = false;
    byId("note").textContent = `To keep this file small, ${results.times.length} of ${results.written} times are in it.`;
  }
}

begin().catch(failed);
