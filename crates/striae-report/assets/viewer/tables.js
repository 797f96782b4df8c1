// How the run went: facts, warnings, steps and increments.

function table(heads, rows) {
  const head = element("tr", {}, ...heads.map((text) => element("th", { textContent: text })));
  const body = rows.map((row) => element("tr", {}, ...row.map((text) => element("td", { textContent: text }))));
  return element("table", {}, element("thead", {}, head), element("tbody", {}, ...body));
}

function beginTables() {
  const { summary } = results;
  byId("program").textContent = summary?.version ?? results.program;
  const status = byId("status");
  status.textContent = summary?.status ?? "under way";
  status.classList.add(summary?.status ?? "running");
  byId("reason").textContent = summary?.reason ?? "The run has not ended; load this page again to see more.";
  if (summary?.warnings.length) {
    byId("warnings").hidden = false;
    const items = summary.warnings.map((warning) => element("li", { textContent: warning.text }));
    const title = summary.warnings.length === 1 ? "1 warning" : `${summary.warnings.length} warnings`;
    byId("warnings").append(element("h2", { textContent: title }), element("ul", {}, ...items));
  }
  facts(summary);
  steps();
  for (const id of ["laws", "deck"]) {
    if (!byId(id).querySelector("figure, pre:not(:empty)")) byId(id).hidden = true;
  }
}

function facts(summary) {
  const rows = results.rows;
  const sum = (name) => rows.reduce((total, row) => total + row[results.columns.indexOf(name)], 0);
  const list = summary
    ? [
        ["increments", summary.increments],
        ["cut back", summary.cutbacks],
        ["Newton iterations", `${summary.newton_total} (median ${summary.newton_median}, most ${summary.newton_max})`],
        ["unknowns", summary.unknowns.toLocaleString("en")],
        ["solver", summary.solver.method],
        ["time taken", `${written(summary.wall_s)} s`],
        ["memory", summary.peak_rss_mib ? `${Math.round(summary.peak_rss_mib)} MiB` : "–"],
      ]
    : [["increments", rows.length], ["Newton iterations", rows.length ? sum("iterations") : 0]];
  const items = list.map(([name, value]) => element("div", {}, element("dt", { textContent: name }), element("dd", { textContent: value })));
  byId("facts").append(element("dl", { className: "facts" }, ...items));
  if (summary?.pairs.length) {
    const vector = (force) => `(${force.map(written).join(", ")})`;
    const pairs = summary.pairs.map((pair) => [
      pair.name, vector(pair.resultant_a), vector(pair.resultant_b), written(pair.mismatch),
      `${pair.stick} / ${pair.slip} / ${pair.open}`, written(pair.max_pressure), written(pair.dissipated),
    ]);
    const heads = ["pair at the end", "force on a", "force on b", "mismatch", "stick / slip / open", "largest pressure", "dissipated"];
    byId("facts").append(element("div", { className: "wide" }, table(heads, pairs)));
  }
}

function steps() {
  const { columns, rows } = results;
  if (!rows.length) return;
  byId("run").hidden = false;
  const column = (name) => columns.indexOf(name);
  const [increment, step, time, iterations, cut] = ["increment", "step", "time", "iterations", "cutbacks"].map(column);
  const cuts = rows.map((row, at) => row[cut] - (at ? rows[at - 1][cut] : 0));
  const numbers = [...new Set(rows.map((row) => row[step]))];
  const total = (list) => list.reduce((a, b) => a + b, 0);
  const summed = numbers.map((number) => {
    const own = rows.map((row, at) => [row, cuts[at]]).filter(([row]) => row[step] === number);
    const newton = own.map(([row]) => row[iterations]);
    const before = rows[rows.indexOf(own[0][0]) - 1]?.[time] ?? 0;
    return [
      results.steps[number - 1] ? `${number}  ${results.steps[number - 1]}` : String(number),
      `${written(before)} – ${written(own.at(-1)[0][time])}`, own.length,
      total(own.map(([, cut]) => cut)), total(newton), Math.max(...newton),
    ];
  });
  byId("steps").append(table(["step", "time", "increments", "cut back", "Newton iterations", "most in one"], summed));
  const contact = columns.map((name, at) => [name, at]).filter(([name]) => /^pair\..*\.max_pressure$/.test(name));
  const each = rows.map((row, at) => [
    row[increment], results.steps[row[step] - 1] ?? row[step], written(row[time]), row[iterations], cuts[at],
    ...contact.map(([, place]) => written(row[place])),
  ]);
  const pressures = contact.map(([name]) => `largest pressure of ${name.split(".").slice(1, -1).join(".")}`);
  byId("increments").append(table(["increment", "step", "time", "iterations", "cut back before", ...pressures], each));
}

beginTables();
