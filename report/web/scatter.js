"use strict";

// Figure 1: return position errors (mm), the lecture's closing figure.

const STAGES = ["before", "bumped", "after"];

function setupScatter(data, section) {
  const present = STAGES.filter((stage) => runsOf(data, stage).length > 0);
  const visible = new Set(present.filter((s) => s !== "bumped" || present.length === 1));
  const zoomed = present.includes("after") && present.length > 1;
  const panel = (title, cssClass = "") =>
      `<div class="panel ${cssClass}"><p class="panel-title">${title}</p><div class="plot"></div></div>`;
  const boxes = present.map(toggle).join("");
  const toggles = `<div class="controls" role="group" aria-label="Clusters shown">${boxes}</div>`;
  section.innerHTML = `
    <h2>Figure 1. Return position errors</h2>
    <figure>
      ${present.length > 1 ? toggles : ""}
      <div class="panels">${zoomed ? panel("All clusters") + panel("") : panel("All clusters", "alone")}</div>
      <div class="legend-slot"></div>
      <figcaption>${CAPTIONS.scatter}</figcaption>
    </figure>`;

  function toggle(stage) {
    const checked = visible.has(stage) ? "checked" : "";
    const text = stageName(stage)[0].toUpperCase() + stageName(stage).slice(1);
    return `<label><input type="checkbox" value="${stage}" ${checked}>${text}</label>`;
  }

  function draw() {
    const plots = section.querySelectorAll(".plot");
    const shown = present.filter((s) => visible.has(s));
    const zoomSpan = zoomed ? spanOf(data, ["after"]) : undefined;
    plots[0].innerHTML =
        scatterSvg(data, shown, panelWidth(plots[0]), visible.has("after") && shown.length > 1 ? zoomSpan : undefined);
    if (zoomed) {
      const title = plots[1].previousElementSibling;
      const times = spanOf(data, shown.length ? shown : ["after"]) / zoomSpan;
      title.textContent =
          `After calibration${times > 1.05 ? `, enlarged ${fixed(times, times < 10 ? 1 : 0)}\u00d7` : ""}`;
      plots[1].innerHTML = scatterSvg(data, ["after"], panelWidth(plots[1]));
    }
    section.querySelector(".legend-slot").innerHTML = scatterLegend(data, shown, zoomed);
  }

  section.addEventListener("change", (event) => {
    if (event.target.checked)
      visible.add(event.target.value);
    else
      visible.delete(event.target.value);
    draw();
  });
  return draw;
}

// Half the width of the square, origin-centred view that holds the points and the circle, in mm.
function spanOf(data, stages) {
  let span = 0;
  for (const stage of stages) {
    for (const run of runsOf(data, stage)) span = Math.max(span, Math.abs(run.error.x_m), Math.abs(run.error.y_m));
    span = Math.max(span, ...Object.values(clustersOf(data, stage)).map((c) => c.r_cg_m));
  }
  return span > 0 ? span * 1000 * 1.12 : 1;
}

function scatterSvg(data, stages, width, zoomSpan) {
  const span = spanOf(data, stages);
  const plot = Plot.square({width, x: [-span, span], y: [-span, span], xLabel: "x error (mm)", yLabel: "y error (mm)"});
  const texts = [];
  for (const stage of stages) {
    const clusters = clustersOf(data, stage);
    drawCircle(plot, clusters, stage === "bumped" ? undefined : eMaxOf(clusters));
    for (const [direction, cluster] of Object.entries(clusters)) {
      drawCluster(plot, runsOf(data, stage, direction), direction, stage, cluster);
      texts.push(`${directionName(direction)} ${stageName(stage)}: centre ${mmUnit(cluster.r_cg_m)} from the origin`);
    }
    for (const run of runsOf(data, stage))
      if (!clusters[run.direction]) drawPoint(plot, run);
  }
  if (zoomSpan && zoomSpan < span * 0.7) drawZoomBox(plot, zoomSpan);
  return plot.svg(`Scatter of return position errors. ${texts.join("; ") || "Nothing selected"}.`);
}

function drawCluster(plot, runs, direction, stage, cluster) {
  const centre = [cluster.centroid_x_m * 1000, cluster.centroid_y_m * 1000];
  if (runs.length > 2) {
    const {a_m, b_m, angle_rad} = cluster.ellipse;
    plot.ellipse(centre, {a: a_m * 1000, b: b_m * 1000, angle_rad}, `spread ${direction}`);
  }
  plot.line([0, 0], centre, `radius ${direction}`);
  runs.forEach((run) => drawPoint(plot, run));
  plot.cross(centre);
}

function drawPoint(plot, run) {
  const {x_m, y_m, theta_rad} = run.error;
  const title = `${run.id}, ${stageName(run.stage)}: x ${mmUnit(x_m)}, y ${mmUnit(y_m)}, heading ${degUnit(theta_rad)}`;
  plot.marker([x_m * 1000, y_m * 1000], run.direction, run.stage, title);
}

function drawCircle(plot, clusters, eMax) {
  if (!isNumber(eMax)) return;
  const r = eMax * 1000;
  plot.circle([0, 0], r, "emax");
  if (r * plot.scale < 70) return;
  const directions = Object.values(clusters).map((c) => Math.atan2(c.centroid_y_m, c.centroid_x_m));
  const distance = (a) => Math.min(...directions.map((d) => Math.abs(Math.atan2(Math.sin(a - d), Math.cos(a - d)))));
  const best =
      [90, 270, 120, 60, 240, 300].map((a) => a / DEG).reduce((a, b) => (distance(b) > distance(a) + 1e-9 ? b : a));
  const text = `E<tspan dy="3" font-size="9">max,syst</tspan><tspan dy="-3"> = ${mmUnit(eMax)}</tspan>`;
  plot.label([r * Math.cos(best), r * Math.sin(best)], text, 20);
}

function drawZoomBox(plot, span) {
  const size = Math.max(6, 2 * span * plot.scale);
  const [x, y] = [plot.px(0) - size / 2, plot.py(0) - size / 2];
  plot.add(`<rect class="zoom-box" x="${px(x)}" y="${px(y)}" width="${px(size)}" height="${px(size)}"/>`);
}

function scatterLegend(data, shown, zoomed) {
  const stages = zoomed && !shown.includes("after") ? [...shown, "after"] : shown;
  const items = [];
  for (const stage of stages) {
    for (const direction of ["cw", "ccw"]) {
      const n = runsOf(data, stage, direction).length;
      if (n) items.push([markerIcon(direction, stage), `${direction} ${stageName(stage)} (${n})`]);
    }
  }
  const cross = '<svg width="16" height="16" aria-hidden="true"><path class="centroid" d="M1 8H15M8 1V15"/></svg>';
  const ellipse =
      '<svg width="24" height="14" aria-hidden="true"><ellipse class="spread cw" cx="12" cy="7" rx="11" ry="6"/></svg>';
  const square = '<rect class="zoom-box" x="1" y="1" width="12" height="12"/>';
  const box = `<svg width="14" height="14" aria-hidden="true">${square}</svg>`;
  items.push([cross, "centre of gravity"], [lineIcon("radius cw"), "r<sub>cg</sub>"]);
  if (stages.some((s) => ["cw", "ccw"].some((d) => runsOf(data, s, d).length > 2)))
    items.push([ellipse, "1\u03c3 spread"]);
  if (stages.some((s) => isNumber(eMaxOf(clustersOf(data, s))))) items.push([lineIcon("emax"), `radius ${E_MAX}`]);
  if (zoomed && shown.includes("after") && shown.length > 1) items.push([box, "enlarged part"]);
  return legendHtml(items);
}
