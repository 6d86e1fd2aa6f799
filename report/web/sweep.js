"use strict";

// The page of a sweep: one figure over one or two axes, recovered against injected errors, expectations, failed points.

const kMostCurves = 8;

function sweepTiles(data) {
  const tile = (name, value, more) =>
      `<div class="tile"><dt>${name}</dt><dd><div class="value">${value}</div><div class="more">${more}</div></dd></div>`;
  const unmet = data.checks.filter((c) => !c.met).length;
  const tiles = [
    tile("Points driven", data.done, `of ${data.points}, ${data.design.replace("_", " ")}`),
    tile("Failed", data.failed.length, "could not be driven"),
  ];
  if (data.checks.length) tiles.push(tile("Expectations met", data.checks.length - unmet, `of ${data.checks.length}`));
  return `<dl class="tiles">${tiles.join("")}</dl>`;
}

function tableHtml(caption, heads, rows) {
  const head = heads.map((h) => `<th class="text">${h}</th>`).join("");
  const body = rows.map((cells) => `<tr>${cells.map((c) => `<td class="text">${c}</td>`).join("")}</tr>`).join("");
  return `<div class="table-wrap"><table><caption>${caption}</caption><thead><tr>${head}</tr></thead>` +
      `<tbody>${body}</tbody></table></div>`;
}

function checksHtml(data) {
  if (!data.checks.length) return "";
  const summary = tableHtml("What the sweep asks for", ["", "expectation", "checked", "not met"], data.checks.map((c) => [
    c.met ? '<b class="good">met</b>' : '<b class="bad">not met</b>', escapeHtml(c.expectation), c.checked, c.unmet.length,
  ]));
  const faults = data.checks.flatMap((c) => c.unmet.map((u) => [
    u.point === undefined ? "\u2013" : u.point, escapeHtml(u.where), escapeHtml(c.figure), escapeHtml(short(u.value)),
  ]));
  if (!faults.length) return summary;
  const shown = faults.slice(0, 200);
  const more = faults.length > shown.length ? `, the first ${shown.length} of ${faults.length}` : "";
  return summary + tableHtml(`Not met${more} (SI units)`, ["point", "where", "figure", "value"], shown);
}

function failedHtml(data) {
  if (!data.failed.length) return "";
  return tableHtml("Points that could not be driven", ["point", "where", "why"],
                   data.failed.slice(0, 200).map((f) => [f.point, escapeHtml(f.where), escapeHtml(f.error)]));
}

const sectionHtml = (title, html) => (html ? `<section><h2>${title}</h2>${html}</section>` : "");

function buildSweepPage(data) {
  document.getElementById("report").innerHTML = `
    <header>
      <h1>Sweep ${escapeHtml(data.title)}</h1>
      ${data.description ? `<p class="headline">${escapeHtml(data.description)}</p>` : ""}
      ${sweepTiles(data)}
    </header>
    <section id="map"></section>
    <section id="recovered" hidden></section>
    ${sectionHtml("Expectations", checksHtml(data))}
    ${sectionHtml("Failed points", failedHtml(data))}
    <footer>umbsim ${escapeHtml(data.version)}${data.stride > 1 ? ` · every ${data.stride}th point is shown` : ""}</footer>`;
}

// What to show first: the sweep file's wish, else the axes with the most values.
function firstView(data) {
  const byValues = [...data.axes].sort((a, b) => b.values.length - a.values.length);
  const wanted = ["recovery.e_d_error", "umbmark.e_max_syst_m"].find((f) => has(data, f));
  const x = axisOf(data, data.view.x) || byValues[0];
  const y = axisOf(data, data.view.y) || byValues.find((a) => a !== x && a.values.length > 1);
  const slice = {};
  return {x: x.key, y: y ? y.key : "", figure: has(data, data.view.figure) ? data.view.figure : wanted || data.figures[0],
          kind: "map", log: data.view.log, slice};
}

const optionsHtml = (values, chosen) => values.map(([value, text]) =>
    `<option value="${escapeHtml(value)}"${value === chosen ? " selected" : ""}>${escapeHtml(text)}</option>`).join("");

const selectHtml = (name, label, values, chosen) =>
    `<label>${label}<select data-control="${escapeHtml(name)}">${optionsHtml(values, chosen)}</select></label>`;

// Axes that the figure does not show: one of their values, or the mean over all.
const otherAxes = (data, view) =>
    data.axes.filter((a) => a.key !== view.x && a.key !== view.y && a.values.length > 1 && !isScattered(data, a));

function controlsHtml(data, view) {
  const axes = data.axes.map((a) => [a.key, a.key]);
  const selects = [
    selectHtml("figure", "Figure", data.figures.map((f) => [f, withUnit(f)]), view.figure),
    selectHtml("x", "over", axes, view.x),
    selectHtml("y", "and", [["", "\u2013"], ...axes.filter(([key]) => key !== view.x)], view.y),
    selectHtml("kind", "as", [["map", "map"], ["curves", "curves"]], view.kind),
  ];
  for (const axis of otherAxes(data, view)) {
    const values = axis.values.map((v, i) => [String(i), short(v)]);
    selects.push(selectHtml(`slice ${axis.key}`, escapeHtml(axis.key), [["all", "mean of all"], ...values], view.slice[axis.key]));
  }
  const log = `<label><input type="checkbox" data-control="log"${view.log ? " checked" : ""}>log scale of the size</label>`;
  return `<div class="controls" role="group" aria-label="What the figure shows">${selects.join("")}${log}</div>`;
}

function slicedRows(data, view) {
  return otherAxes(data, view).reduce((rows, axis) => {
    const chosen = view.slice[axis.key];
    return chosen === "all" ? rows : rows.filter((row) => valueOf(data, row, axis.key) === axis.values[Number(chosen)]);
  }, data.rows);
}

function mapOf(data, view, width) {
  const rows = slicedRows(data, view);
  const y = axisOf(data, view.y);
  const many = y && y.values.length > kMostCurves;
  if (!y || (view.kind === "curves" && !many)) {
    return curvesSvg(data, rows, view, Math.min(width, 860)) + curvesLegend(data, rows, view);
  }
  const scattered = isScattered(data, axisOf(data, view.x)) && isScattered(data, y);
  return scattered ? scatterMapSvg(data, rows, view, Math.min(width, 860)) : cellMapSvg(data, rows, view, Math.min(width, 860));
}

function setupMap(data, section) {
  const view = firstView(data);
  if (!view.y || axisOf(data, view.y).values.length <= kMostCurves) view.kind = "curves";
  const complete = () => otherAxes(data, view).forEach((a) => {
    // Names are looked at one by one, numbers in the mean.
    if (view.slice[a.key] === undefined) view.slice[a.key] = a.numeric ? "all" : "0";
  });
  section.innerHTML = `<h2>Figure 1. One figure over the axes</h2><figure><div class="control-slot"></div>
    <div class="plot wide"></div>
    <figcaption>Colours and curves show the chosen figure; where several points fall on one place (replicates, other axes)
      their mean. Lengths of figures are in mm and angles in degrees, axes as in the sweep file. A <b>ring</b> or <b>dot</b>
      marks points that do not meet an expectation, a <b>cross</b> those that could not be driven.</figcaption></figure>`;
  const plot = section.querySelector(".plot");
  function draw() {
    complete();
    section.querySelector(".control-slot").innerHTML = controlsHtml(data, view);
    plot.innerHTML = mapOf(data, view, Math.max(300, plot.clientWidth || 800));
  }
  section.addEventListener("change", (event) => {
    const name = event.target.dataset.control;
    if (name === "log") view.log = event.target.checked;
    else if (name.startsWith("slice ")) view.slice[name.slice(6)] = event.target.value;
    else view[name] = event.target.value;
    if (view.y === view.x) view.y = "";
    draw();
  });
  return draw;
}

const sweepData = loadSweep();
buildSweepPage(sweepData);
const sweepDraws = [];
if (sweepData.rows.length && sweepData.figures.length) sweepDraws.push(setupMap(sweepData, document.getElementById("map")));
const varies = (name) => has(sweepData, name) && new Set(sweepData.rows.map((r) => valueOf(sweepData, r, name)).filter(isNumber)).size > 1;
if (varies("injected.e_d") || varies("injected.e_b")) {
  document.getElementById("recovered").hidden = false;
  sweepDraws.push(setupRecovered(sweepData, document.getElementById("recovered")));
}
const drawSweep = () => sweepDraws.forEach((draw) => draw());
drawSweep();
let sweepWidth = document.documentElement.clientWidth;
window.addEventListener("resize", () => {
  if (document.documentElement.clientWidth === sweepWidth) return;
  sweepWidth = document.documentElement.clientWidth;
  drawSweep();
});
document.body.dataset.drawn = "true";
