// Figure 1: return position errors (mm), the lecture's closing figure.

import * as Plot from "@observablehq/plot";
import {group} from "d3";
import {Chart, type Drawing, type Point} from "../lib/chart";
import {capital, colour, degUnit, directionName, E_MAX, fixed, isNumber, mmUnit, stageName} from "../lib/format";
import {fill, find, html, type Html} from "../lib/html";
import {heading, icon, legend, lineIcon, markerIcon, SPREAD, type Section} from "../lib/page";
import {CAPTIONS} from "./captions";
import {ofKind, type RunData} from "./data";
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
    name: "return-errors", zoom: "square", draw: () => drawing(data, shown(), box())})];
  if (zoomed) {
    charts.push(new Chart(find(section, "#scatter-after"), {
      name: "return-errors-after", zoom: "square", draw: () => drawing(data, ["after"])}));
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

/// An end of a run in a plane of errors, mm.
export interface End {
  x: number;
  y: number;
  direction: string;
  stage: string;
  words: string;
}

/// cw: circles, ccw: triangles; hollow before, filled after, pale with cables.
export const endMarks = (ends: End[]): Plot.Markish[] => [...group(ends, (e) => e.stage, (e) => e.direction)].flatMap(([stage, own]) => [...own].map(([direction, some]) =>
    Plot.dot(some, {
      x: "x", y: "y", symbol: direction === "cw" ? "circle" : direction === "ccw" ? "triangle" : "square", r: 4.6,
      stroke: stage === "after" ? "var(--card)" : colour(direction), strokeWidth: stage === "before" ? 1.6 : 1,
      fill: stage === "before" ? "var(--card)" : colour(direction), fillOpacity: stage === "bumped" ? 0.35 : 1, className: `end-point ${stage}`})));

/// Square axes about the origin.
export const axesTo = (reach: number, x: string, y: string): Pick<Drawing, "x" | "y"> =>
    ({x: {domain: [-reach, reach], label: x}, y: {domain: [-reach, reach], label: y, tickSpacing: 80}});

/// Places that a chart cannot tell apart have one tip, which tells of all of them.
export function together(points: Point[], reach: number): Point[] {
  const near = (v: unknown) => Math.round(Number(v) / reach * 200);
  return [...group(points, (p) => `${near(p.x)} ${near(p.y)}`).values()].map((some) => ({...some[0], words: some.map((p) => p.words).join("\n\n")}));
}

const endsOf = (data: RunData, stages: string[]): End[] => stages.flatMap((stage) => ofKind(data, stage)).map(({id, direction, stage, error}) => ({
  x: error!.x_m * 1000, y: error!.y_m * 1000, direction, stage, words: `${id}, ${stageName(stage)}\nx ${mmUnit(error!.x_m)}\ny ${mmUnit(error!.y_m)}\n` +
      `distance ${mmUnit(Math.hypot(error!.x_m, error!.y_m))}\nheading ${degUnit(error!.theta_rad)}`}));

interface Centre extends Point {
  direction: string;
  cluster: Cluster;
}

function centresOf(data: RunData, stage: string): Centre[] {
  return Object.entries(clustersOf(data, stage)).map(([direction, cluster]) => ({
    direction, cluster, x: cluster.centroid_x_m * 1000, y: cluster.centroid_y_m * 1000,
    words: `centre of gravity, ${directionName(direction)}\nx ${mmUnit(cluster.centroid_x_m)}\ny ${mmUnit(cluster.centroid_y_m)}\nr_cg ${mmUnit(cluster.r_cg_m)}`}));
}

const circle = (radius: number, className: string): Plot.Markish =>
    Plot.line(outline([0, 0], radius, radius, 0, 96), {stroke: "var(--ink)", strokeWidth: 1.2, strokeDasharray: "6 4", className});

function centreMarks(centres: Centre[]): Plot.Markish[] {
  const plus = (strokeWidth: number, stroke: string, className: string) => Plot.dot(centres, {x: "x", y: "y", symbol: "plus", r: 8, stroke, strokeWidth, className});
  return [
    ...centres.filter(({cluster}) => cluster.ellipse && cluster.runs > 2).map(({x, y, direction, cluster: {ellipse: e}}) =>
      Plot.line(outline([Number(x), Number(y)], e!.a_m * 1000, e!.b_m * 1000, e!.angle_rad), {
        stroke: colour(direction), strokeWidth: 1, fill: colour(direction), fillOpacity: 0.12, className: "spread"})),
    Plot.link(centres, {x1: 0, y1: 0, x2: "x", y2: "y", stroke: (c) => colour(c.direction), strokeWidth: 1.6}), plus(5, "var(--card)", "halo"), plus(2.2, "var(--ink)", "centroid")];
}

function drawing(data: RunData, stages: string[], box?: number): Drawing {
  const span = spanOf(data, stages);
  const ends = endsOf(data, stages);
  const centres = stages.map((stage) => centresOf(data, stage));
  const radii = stages.filter((s) => s !== "bumped").map((s) => eMaxOf(clustersOf(data, s))).filter(isNumber);
  const texts = stages.flatMap((stage, i) => centres[i].map((c) => `${directionName(c.direction)} ${stageName(stage)}: centre ${mmUnit(c.cluster.r_cg_m)} from the origin`));
  return {
    label: `Scatter of return position errors. ${texts.join("; ") || "Nothing selected"}.`, points: together([...ends, ...centres.flat()], span),
    ...axesTo(span, "x error (mm)", "y error (mm)"), plot: {color: {type: "identity"}},
    marks: [...radii.map((r) => circle(r * 1000, "emax")), ...centres.flatMap(centreMarks), ...endMarks(ends),
      box && box < span * 0.7 ? Plot.rect([box], {x1: -box, x2: box, y1: -box, y2: box, stroke: "var(--accent)", fill: "none", strokeWidth: 1.3}) : null],
  };
}

function legendOf(data: RunData, stages: string[], boxed: boolean): Html {
  const items: [Html, unknown][] = stages.flatMap((stage) => ["cw", "ccw"].flatMap((direction): [Html, unknown][] => {
    const n = ofKind(data, stage, direction).length;
    return n ? [[markerIcon(direction, stage), `${direction} ${stageName(stage)} (${n})`]] : [];
  }));
  items.push([icon("centroid-icon", "M1 8H15M8 1V15"), "centre of gravity"], [lineIcon("var(--cw)"), html`r<sub>cg</sub>`]);
  if (stages.some((s) => Object.values(clustersOf(data, s)).some((c) => c.runs > 2))) {
    items.push([icon("spread-icon", SPREAD), "1\u03c3 spread"]);
  }
  if (stages.some((s) => isNumber(eMaxOf(clustersOf(data, s))))) items.push([lineIcon("var(--ink)", "6 4"), html`radius ${E_MAX}`]);
  if (boxed) items.push([icon("box-icon", "M2 2H14V14H2Z"), "enlarged part"]);
  return legend(items);
}
