"use strict";

// Puts the page together from the data, and draws again when the width changes.

function loadData() {
  const data = JSON.parse(document.getElementById("report-data").textContent);
  data.summary = data.summary || {};
  data.runs = (Array.isArray(data.runs) ? data.runs : []).map((run) => ({stage: "before", ...run}));
  data.bumps = Array.isArray(data.bumps) ? data.bumps : [];
  return data;
}

function headline(data) {
  const {umbmark = {}, recovery, one_way: oneWay} = data.summary;
  const counts = ["cw", "ccw"].map((d) => (umbmark[d] || {}).runs).filter(isNumber);
  if (isNumber(umbmark.e_max_syst_m)) {
    const driven = counts.length === 2 ? `Over ${counts[0]} clockwise and ${counts[1]} counter-clockwise squares` :
                                         "Over squares driven both ways";
    const before = `${driven} the largest systematic return error, ${E_MAX}, is <b>${mmUnit(umbmark.e_max_syst_m)}</b>`;
    if (!recovery || !isNumber(recovery.e_max_after_m)) return `${before}.`;
    const after = `${before}. Calibrated and driven again, it is <b>${mmUnit(recovery.e_max_after_m)}</b>`;
    if (!isNumber(recovery.improvement)) return `${after}.`;
    return `${after}: <b>${factor(recovery.improvement)} times</b> smaller.`;
  }
  if (!oneWay) return "";
  const direction = escapeHtml(directionName(oneWay.direction));
  return `Driven ${direction} only, the mean return error is <b>${mmUnit(oneWay.r_cg_m)}</b>.`;
}

function tilesHtml(data) {
  const {umbmark = {}, recovery = {}, injected = {}, extended = {}} = data.summary;
  const form = formsOf(data)[0];
  const tiles = [];
  const tile = (name, value, unit, more = "") => {
    if (value === "\u2013") return;
    const number = `<div class="value">${value}${unit ? `<small>${unit}</small>` : ""}</div>`;
    tiles.push(`<div class="tile"><dt>${name}</dt><dd>${number}<div class="more">${more}</div></dd></div>`);
  };
  const measured = (v) => `${form.label}${isNumber(v) ? `; injected ${fixed(v, 5)}` : ""}`;
  tile(
      `${E_MAX} before`, mm(umbmark.e_max_syst_m), "\u00a0mm",
      worst(umbmark) ? `set by the ${worst(umbmark)} runs` : "");
  tile(`${E_MAX} after`, mm(recovery.e_max_after_m), "\u00a0mm", "driven again");
  tile(
      "Improvement", factor(recovery.improvement), "\u00a0\u00d7",
      isNumber(recovery.passes) ? `in ${recovery.passes} pass${recovery.passes === 1 ? "" : "es"}` : "");
  tile("E<sub>d</sub>, wheel diameters", fixed(form.e_d, 5), "", measured(injected.e_d));
  tile("E<sub>b</sub>, wheelbase", fixed(form.e_b, 5), "", measured(injected.e_b));
  tile(
      "Extended figure", degUnit(extended.mean_abs_heading_error_rad), "",
      isNumber(extended.per_bump_heading_error_rad) ? `${degUnit(extended.per_bump_heading_error_rad)} per bump` : "");
  return tiles.length ? `<dl class="tiles">${tiles.join("")}</dl>` : "";
}

function footerText(data) {
  const parts = [];
  if (data.scenario) parts.push(`scenario ${data.scenario}`);
  if (data.seed !== undefined) parts.push(`seed ${data.seed}`);
  parts.push(`umbsim ${data.version || ""}`.trim());
  return escapeHtml(parts.join(" · "));
}

function warningsHtml(data) {
  const warnings = (data.summary.warnings || []).map((text) => `<li>${escapeHtml(text)}</li>`);
  return warnings.length ? `<ul class="notice warnings">${warnings.join("")}</ul>` : "";
}

function buildPage(data) {
  document.getElementById("report").innerHTML = `
    <header>
      <h1>${escapeHtml(data.title || "UMBmark report")}</h1>
      ${headline(data) ? `<p class="headline">${headline(data)}</p>` : ""}
      ${data.description ? `<p class="muted">${escapeHtml(data.description)}</p>` : ""}
      ${warningsHtml(data)}
      ${tilesHtml(data)}
    </header>
    <section id="scatter" hidden></section>
    <section id="paths" hidden></section>
    <section id="growth" hidden></section>
    ${section("One-way test", oneWayHtml(data))}
    ${section("Two-way test (UMBmark)", umbmarkHtml(data))}
    ${section("Systematic and non-systematic error", sharesTableHtml(data))}
    ${section("Pose uncertainty", uncertaintyHtml(data))}
    ${section("Extended UMBmark", extendedHtml(data))}
    ${section("Calibration", calibrationHtml(data) + recoveryHtml(data))}
    ${section("All runs", returnErrorsHtml(data))}
    ${section("Cost", costHtml(data))}
    <footer>${footerText(data)}</footer>`;
}

function setupFigures(data) {
  const draws = [];
  const show = (id) => {
    const element = document.getElementById(id);
    element.hidden = false;
    return element;
  };
  if (data.runs.some((r) => hasError(r) && STAGES.includes(r.stage))) draws.push(setupScatter(data, show("scatter")));
  const selection = {};
  for (const direction of directionsWithPaths(data)) {
    selection[direction] = data.runs.find((r) => hasPath(r) && r.direction === direction);
  }
  if (Object.keys(selection).length) {
    const drawGrowth = setupGrowth(data, show("growth"), selection);
    draws.push(setupPaths(data, show("paths"), selection, drawGrowth), drawGrowth);
  }
  return draws;
}

const reportData = loadData();
buildPage(reportData);
const redraw = setupFigures(reportData);
const drawAll = () => redraw.forEach((draw) => draw());
drawAll();
let drawnWidth = document.documentElement.clientWidth;
window.addEventListener("resize", () => {
  if (document.documentElement.clientWidth === drawnWidth) return;
  drawnWidth = document.documentElement.clientWidth;
  drawAll();
});
document.body.dataset.drawn = "true";
