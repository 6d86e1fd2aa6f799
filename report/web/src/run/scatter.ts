// Figure 1: return position errors (mm), the lecture's closing figure.

import * as Plot from "@observablehq/plot";
import {Chart, grid, square, tip, type Drawing, type Range, type View} from "../lib/chart";
import {capital, colour, degUnit, directionName, E_MAX, fixed, isNumber, mmUnit, stageName} from "../lib/format";
import {fill, find, html, type Html} from "../lib/html";
import {heading, legend, lineIcon, markerIcon, type Section} from "../lib/page";
import {CAPTIONS} from "./captions";
import {ofKind, type Run, type RunData} from "./data";
import {clustersOf, eMaxOf, outline, type Cluster} from "./statistics";

const STAGES = ["before", "bumped", "after"];

export function scatterSection(data: RunData): Section | null {
  const present = STAGES.filter((stage) => ofKind(data, stage).length > 0);
  if (!present.length) return null;
  return {id: "figure-1", setup: (section) => setup(data, present, section)};
}

function setup(data: RunData, present: string[], section: HTMLElement): void {
  const visible = new Set(present.filter((s) => s !== "bumped" || present.length === 1));
  const zoomed = present.includes("after") && present.length > 1;
  const toggle = (stage: string) =>
      html`<label><input type="checkbox" value="${stage}" ${visible.has(stage) ? html`checked` : ""}>${capital(stageName(stage))}</label>`;
  fill(section, html`${heading("figure-1", "Figure 1. Return position errors")}<figure>
    ${present.length > 1 ? html`<div class="controls" role="group" aria-label="Clusters shown">${present.map(toggle)}</div>` : ""}
    <div class="panels"><div class="panel${zoomed ? "" : " alone"}"><p class="panel-title"></p><div id="scatter-all"></div></div>
    ${zoomed && html`<div class="panel"><p class="panel-title"></p><div id="scatter-after"></div></div>`}</div>
    <div class="legend-slot"></div><figcaption>${CAPTIONS.scatter}</figcaption></figure>`);
  const shown = () => present.filter((s) => visible.has(s));
  const box = () => (zoomed && visible.has("after") && shown().length > 1 ? spanOf(data, ["after"]) : undefined);
  const charts = [new Chart(find(section, "#scatter-all"), {
    name: "return-errors", zoom: "square", draw: (width, view) => drawing(data, shown(), width, view, box())})];
  if (zoomed) {
    charts.push(new Chart(find(section, "#scatter-after"), {
      name: "return-errors-after", zoom: "square", draw: (width, view) => drawing(data, ["after"], width, view)}));
  }
  const words = () => {
    const scores = shown().filter((s) => s !== "bumped" && isNumber(eMaxOf(clustersOf(data, s)))).map((s) => `${mmUnit(eMaxOf(clustersOf(data, s)))}${zoomed ? ` ${s}` : ""}`);
    fill(find(section, ".panel-title"), html`All clusters${scores.length ? html`<span class="muted">: ${E_MAX} ${scores.join(", ")}</span>` : ""}`);
    if (zoomed) {
      const times = spanOf(data, shown().length ? shown() : ["after"]) / spanOf(data, ["after"]);
      find(section, ".panel:last-child .panel-title").textContent =
          `After calibration${times > 1.05 ? `, enlarged ${fixed(times, times < 10 ? 1 : 0)}\u00d7` : ""}`;
    }
    fill(find(section, ".legend-slot"), legendOf(data, zoomed ? [...new Set([...shown(), "after"])] : shown(), !!box()));
  };
  words();
  section.addEventListener("change", (event) => {
    const input = event.target as HTMLInputElement;
    if (input.checked) visible.add(input.value);
    else visible.delete(input.value);
    charts[0].redraw();
    words();
  });
}

/// Half the width of the square, origin-centred view that holds the points and the circle, in mm.
function spanOf(data: RunData, stages: string[]): number {
  const reach = stages.flatMap((stage) => [
    ...ofKind(data, stage).flatMap((r) => [Math.abs(r.error!.x_m), Math.abs(r.error!.y_m)]),
    ...Object.values(clustersOf(data, stage)).map((c) => c.r_cg_m)]);
  return Math.max(0, ...reach) * 1000 * 1.12 || 1;
}

const words = (run: Run): string => `${run.id}, ${stageName(run.stage)}\nx ${mmUnit(run.error!.x_m)}\ny ${mmUnit(run.error!.y_m)}\n` +
    `distance ${mmUnit(Math.hypot(run.error!.x_m, run.error!.y_m))}\nheading ${degUnit(run.error!.theta_rad)}`;

const x = (run: Run): number => run.error!.x_m * 1000;
const y = (run: Run): number => run.error!.y_m * 1000;

function clusterMarks(direction: string, cluster: Cluster): Plot.Markish[] {
  const centre: [number, number] = [cluster.centroid_x_m * 1000, cluster.centroid_y_m * 1000];
  const e = cluster.ellipse;
  const about = `centre of gravity, ${directionName(direction)}\nx ${mmUnit(cluster.centroid_x_m)}\ny ${mmUnit(cluster.centroid_y_m)}\n` +
      `r_cg ${mmUnit(cluster.r_cg_m)}`;
  return [
    e && cluster.runs > 2 ? Plot.line(outline(centre, e.a_m * 1000, e.b_m * 1000, e.angle_rad), {
      stroke: colour(direction), strokeWidth: 1, fill: colour(direction), fillOpacity: 0.12, clip: true, className: "spread"}) : null,
    Plot.link([centre], {x1: 0, y1: 0, x2: (c) => c[0], y2: (c) => c[1], stroke: colour(direction), strokeWidth: 1.6, clip: true}),
    ...[[5, "var(--card)"], [2.2, "var(--ink)"]].map(([strokeWidth, stroke], i) => Plot.dot([centre], {
      symbol: "plus", r: 8, stroke: stroke as string, strokeWidth: strokeWidth as number, clip: true,
      ...(i ? {title: () => about, tip} : {}), className: i ? "centroid" : "halo"}))];
}

/// cw: circles, ccw: triangles; hollow before, filled after, pale with cables.
function dots(runs: Run[], direction: string, stage: string): Plot.Markish {
  const full = stage !== "before";
  return Plot.dot(runs, {
    x, y, symbol: direction === "cw" ? "circle" : direction === "ccw" ? "triangle" : "square", r: 4.6, clip: true,
    stroke: stage === "after" ? "var(--card)" : colour(direction), strokeWidth: full ? 1 : 1.6,
    fill: full ? colour(direction) : "var(--card)", fillOpacity: stage === "bumped" ? 0.35 : 1, title: words, tip,
    className: `end-point ${stage}`});
}

function drawing(data: RunData, stages: string[], width: number, view: View, box?: number): Drawing {
  const span = spanOf(data, stages);
  const full: Range = [-span, span];
  const marks: Plot.Markish[] = [...grid()];
  const texts: string[] = [];
  for (const stage of stages) {
    const clusters = clustersOf(data, stage);
    const e = stage === "bumped" ? undefined : eMaxOf(clusters);
    if (isNumber(e)) {
      marks.push(Plot.line(outline([0, 0], e * 1000, e * 1000, 0, 96), {
        stroke: "var(--ink)", strokeWidth: 1.2, strokeDasharray: "6 4", clip: true, className: "emax"}));
    }
    for (const [direction, cluster] of Object.entries(clusters)) {
      marks.push(...clusterMarks(direction, cluster));
      texts.push(`${directionName(direction)} ${stageName(stage)}: centre ${mmUnit(cluster.r_cg_m)} from the origin`);
    }
    for (const direction of new Set(ofKind(data, stage).map((r) => r.direction))) {
      marks.push(dots(ofKind(data, stage, direction), direction, stage));
    }
  }
  if (box && box < span * 0.7) {
    marks.push(Plot.rect([box], {x1: (b) => -b, x2: (b) => b, y1: (b) => -b, y2: (b) => b, stroke: "var(--accent)", fill: "none", strokeWidth: 1.3}));
  }
  return {
    label: `Scatter of return position errors. ${texts.join("; ") || "Nothing selected"}.`,
    stops: stages.flatMap((s) => ofKind(data, s)).map((r) => [x(r), y(r)]),
    plot: {...square(width), marks,
           x: {domain: view.x ?? full, label: "x error (mm)", labelAnchor: "center"}, y: {domain: view.y ?? full, label: "y error (mm)"}},
  };
}

function legendOf(data: RunData, stages: string[], boxed: boolean): Html {
  const items: [Html, unknown][] = stages.flatMap((stage) => ["cw", "ccw"].flatMap((direction): [Html, unknown][] => {
    const n = ofKind(data, stage, direction).length;
    return n ? [[markerIcon(direction, stage), `${direction} ${stageName(stage)} (${n})`]] : [];
  }));
  const plus = html`<svg width="16" height="16" aria-hidden="true"><path class="centroid-icon" d="M1 8H15M8 1V15"/></svg>`;
  items.push([plus, "centre of gravity"], [lineIcon("var(--cw)"), html`r<sub>cg</sub>`]);
  if (stages.some((s) => Object.values(clustersOf(data, s)).some((c) => c.runs > 2))) {
    items.push([html`<svg width="24" height="14" aria-hidden="true"><ellipse class="spread-icon" cx="12" cy="7" rx="11" ry="6"/></svg>`, "1\u03c3 spread"]);
  }
  if (stages.some((s) => isNumber(eMaxOf(clustersOf(data, s))))) items.push([lineIcon("var(--ink)", "6 4"), html`radius ${E_MAX}`]);
  if (boxed) items.push([html`<svg width="14" height="14" aria-hidden="true"><rect class="box-icon" x="1" y="1" width="12" height="12"/></svg>`, "enlarged part"]);
  return legend(items);
}
