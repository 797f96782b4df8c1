"use strict";
// What the page knows, and how it writes numbers.

const results = JSON.parse(document.getElementById("results").textContent);
const byId = (id) => document.getElementById(id);

/** A number with four digits, as a person writes it. */
function written(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) {
    const [digits, power] = value.toExponential(3).split("e");
    const raised = [...String(Number(power))].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
    return minus(`${Number(digits)}·10`) + raised.join("");
  }
  return minus(String(Number(value.toPrecision(4))));
}

function minus(text) {
  return text.replace("-", "−");
}

/** About so many round numbers from low to high. */
function ticks(low, high, count) {
  if (!(high > low)) return [low];
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map((f) => f * power).find((s) => s >= rough * 0.999);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => (first + i) * step);
}

/** Names of files in words. */
function inWords(name) {
  const known = {
    cauchy_stress: "Cauchy stress",
    von_mises: "von Mises stress",
    mean_pressure: "mean contact pressure",
    pressure: "nodal contact pressure",
    traction: "contact traction",
    status: "contact status",
    kept: "nodes with traction unknowns",
    motion: "displacement",
  };
  return known[name] ?? name.replaceAll("_", " ");
}

function element(name, properties = {}, ...children) {
  const node = Object.assign(document.createElement(name), properties);
  node.append(...children);
  return node;
}
