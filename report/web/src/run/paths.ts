// Figure 2: driven paths, truth against odometry, with the error enlarged; repeats of the chosen run stand behind it.

import * as Plot from "@observablehq/plot";
import {Chart, grid, square, tip, type Drawing, type Range, type View} from "../lib/chart";
import {capital, colour, DEG, degUnit, directionName, fixed, isNumber, mmUnit, plural, stageName} from "../lib/format";
import {factorAt, factorFor, sayFactor, slider} from "../lib/enlarge";
import {fill, find, html, type Html} from "../lib/html";
import {heading, legend, lineIcon, type Section} from "../lib/page";
import {CAPTIONS} from "./captions";
import {directions, repeats, type Choice} from "./choice";
import {hasError, hasTrack, type Pose, type RunData, type Tracked} from "./data";
import {errorSeries, poseAt, samplesOf} from "./series";
import {outline} from "./statistics";

/// Truth as shown: odometry + k (truth - odometry).
export function enlarged(run: Tracked, k: number): Pose[] {
  return run.odometry.slice(0, samplesOf(run)).map((o, i) => o.map((v, c) => v + k * (run.truth[i][c] - v)) as Pose);
}

const largestEllipse = (run: Tracked): number => Math.max(0, ...(run.ellipses ?? []).map((e) => e[2]));
const largestError = (run: Tracked): number => Math.max(0, ...errorSeries(run).map((s) => s.position)) / 1000;

export type Box = [number, number, number, number];

export function boundsOf(points: number[][]): Box {
  const b: Box = [Infinity, -Infinity, Infinity, -Infinity];
  for (const [x, y] of points) {
    b[0] = Math.min(b[0], x);
    b[1] = Math.max(b[1], x);
    b[2] = Math.min(b[2], y);
    b[3] = Math.max(b[3], y);
  }
  return b;
}

export const spanOf = (b: Box): number => Math.max(b[1] - b[0], b[3] - b[2]);

function firstFactor(runs: Tracked[]): number {
  const size = Math.max(...runs.map((r) => spanOf(boundsOf(r.odometry))));
  return factorFor(size, Math.max(...runs.map((r) => Math.max(largestError(r), largestEllipse(r)))));
}

/// A cable lies on the true floor; it is shown moved like the true path there. [x, y, heading]
function cablesShown(data: RunData, run: Tracked, k: number): Pose[] {
  return data.bumps.filter((b) => b.run === run.id && isNumber(b.x_m) && isNumber(b.y_m)).map((b): Pose => {
    const i = poseAt(run.truth.slice(0, samplesOf(run)), b.x_m, b.y_m, data.wheelbase_m ?? 0);
    const [t, o] = [run.truth[i], run.odometry[i]];
    return [b.x_m + (k - 1) * (t[0] - o[0]), b.y_m + (k - 1) * (t[1] - o[1]), t[2]];
  });
}

/// Moved and enlarged with the error, so that the truth lies inside an ellipse as shown or not at all.
function ellipsesShown(run: Tracked, k: number): [number, number][][] {
  return (run.ellipses ?? []).map(([x, y, a, b, angle, index]) => {
    const o = run.odometry[index];
    return outline([o[0] + k * (x - o[0]), o[1] + k * (y - o[1])], k * a, k * b, angle, 32);
  });
}

export function pathsSection(data: RunData, choice: Choice): Section | null {
  if (!directions(choice).length) return null;
  return {id: "figure-2", setup: (section) => setup(data, choice, section)};
}

function setup(data: RunData, choice: Choice, section: HTMLElement): void {
  const all = directions(choice);
  let k = firstFactor(Object.values(choice.runs.value));
  const uncertain = data.runs.some((r) => r.ellipses?.length);
  const option = (r: Tracked) => html`<option value="${data.runs.indexOf(r)}" ${
      r === choice.runs.value[r.direction] ? html`selected` : ""}>${r.id}, ${stageName(r.stage)}</option>`;
  const panel = (direction: string, i: number) => html`<div class="panel${all.length === 1 ? " alone" : ""}">
    <label>Run <select data-direction="${direction}" aria-label="${directionName(direction)} run">${
      data.runs.filter(hasTrack).filter((r) => r.direction === direction).map(option)}</select></label>
    <p class="panel-title"></p><div id="path-${i}"></div></div>`;
  fill(section, html`${heading("figure-2", "Figure 2. Driven paths")}<figure>
    <div class="controls">${slider("Error shown", k)}</div>
    <div class="panels">${all.map(panel)}</div>${legendOf(data, all)}
    <figcaption>${CAPTIONS.paths}${uncertain && CAPTIONS.ellipses}</figcaption></figure>`);
  const charts = all.map((direction, i) => new Chart(find(section, `#path-${i}`), {
    name: `path-${direction}`, zoom: "square", draw: (width, view) => drawing(data, choice, direction, k, width, view)}));
  const redraw = () => {
    sayFactor(section, k);
    section.querySelectorAll(".panel-title").forEach((title, i) => fill(title, returnError(choice.runs.value[all[i]])));
    charts.forEach((chart) => chart.redraw());
    cursor();
  };
  const cursor = () => charts.forEach((chart, i) => {
    const moment = choice.moment.value;
    const run = choice.runs.value[all[i]];
    chart.cursor(moment?.run === run ? [{...at(run, moment.index, k), colour: "var(--accent)"}] : []);
  });
  section.addEventListener("input", (event) => {
    const input = event.target as HTMLInputElement;
    if (input.type === "range") {
      k = factorAt(input);
      redraw();
    } else if (input.dataset.direction) {
      choice.runs.set({...choice.runs.value, [input.dataset.direction]: data.runs[Number(input.value)] as Tracked});
    }
  });
  choice.runs.on(() => {
    section.querySelectorAll<HTMLSelectElement>("select").forEach((s) => {
      s.value = String(data.runs.indexOf(choice.runs.value[s.dataset.direction!]));
    });
    redraw();
  });
  choice.stretch.on(redraw);
  choice.moment.on(cursor);
  redraw();
}

function at(run: Tracked, index: number, k: number): {x: number; y: number} {
  const i = Math.min(Math.floor(index), samplesOf(run) - 2);
  const [p, q] = enlarged({...run, truth: run.truth.slice(i, i + 2), odometry: run.odometry.slice(i, i + 2)}, k);
  return {x: p[0] + (index - i) * (q[0] - p[0]), y: p[1] + (index - i) * (q[1] - p[1])};
}

function returnError(run: Tracked): Html {
  const e = run.error;
  return html`${capital(directionName(run.direction))}<span class="muted">${
      hasError(run) ? `: return error ${mmUnit(Math.hypot(e!.x_m, e!.y_m))}, ${degUnit(e!.theta_rad)}` : ""}</span>`;
}

export const line = (points: number[][], options: Plot.LineOptions): Plot.Markish =>
    Plot.line(points, {x: (p) => p[0], y: (p) => p[1], clip: true, ...options});

function drawing(data: RunData, choice: Choice, direction: string, k: number, width: number, view: View): Drawing {
  const run = choice.runs.value[direction];
  const shown = Object.values(choice.runs.value);
  const extent = (r: Tracked) => [...r.odometry, ...enlarged(r, k), ...cablesShown(data, r, k), ...ellipsesShown(r, k).flat()];
  const span = Math.max(...shown.map((r) => spanOf(boundsOf(extent(r)))), 0.01) * 1.1;
  const b = boundsOf(extent(run));
  const domain = (low: number, high: number): Range => [(low + high - span) / 2, (low + high + span) / 2];
  const truth = enlarged(run, k);
  const cables = cablesShown(data, run, k);
  const [end, calculated] = [truth[truth.length - 1], run.odometry[truth.length - 1]];
  const stretch = choice.stretch.value;
  const inside = (r: Tracked) => errorSeries(r).filter((s) => stretch && s.distance >= stretch[0] && s.distance <= stretch[1]);
  const words = (i: number) => {
    const s = errorSeries(run)[i];
    return `${fixed(s.distance, 2)} m driven\nx ${fixed(run.truth[i][0], 3)} m, y ${fixed(run.truth[i][1], 3)} m\n` +
        `position error ${fixed(s.position, 1)} mm\nheading error ${fixed(s.heading, 3)}°`;
  };
  const c = colour(direction);
  return {
    label: `Path of run ${run.id}, truth solid against odometry dashed, in metres, error shown ${k} times` +
        (cables.length ? `, ${plural(cables.length, "cable")} marked` : ""),
    stops: truth.filter((_, i) => i % 8 === 0).map((p) => [p[0], p[1]]),
    plot: {
      ...square(width), marks: [...grid(),
        ...ellipsesShown(run, k).map((e) => line(e, {stroke: c, strokeOpacity: 0.7, fill: c, fillOpacity: 0.1, strokeWidth: 1, className: "ellipse"})),
        ...repeats(data, run).filter((r) => r !== run).map((r) => line(enlarged(r, k), {stroke: c, strokeOpacity: 0.3, strokeWidth: 1, className: "repeat"})),
        line(inside(run).map((s) => truth[s.index]), {stroke: "var(--bump)", strokeWidth: 9, strokeOpacity: 0.45, strokeLinecap: "round", className: "stretch"}),
        line(run.odometry.slice(0, truth.length), {stroke: "var(--muted)", strokeDasharray: "6 4", strokeWidth: 1.6, className: "odometry"}),
        line(truth, {stroke: c, strokeWidth: 2.2, className: "truth"}),
        Plot.vector(cables, {x: (p) => p[0], y: (p) => p[1], rotate: (p) => -p[2] * DEG, length: 10, shape: {draw: (path, l) => {
          path.moveTo(0, -l / 2);
          path.lineTo(0, l / 2);
        }}, stroke: "var(--bump)", strokeWidth: 3, title: (_, i) => `cable ${i + 1}`, clip: true, className: "cable"}),
        Plot.dot((run.fixes ?? []).map((i) => truth[i]), {x: (p) => p[0], y: (p) => p[1], symbol: "diamond", r: 7, fill: "var(--card)",
          stroke: "var(--ink)", strokeWidth: 1.8, title: () => "absolute fix", clip: true, className: "fix"}),
        line([calculated, end], {stroke: "var(--ink)", strokeWidth: 1.4}),
        Plot.dot([run.odometry[0]], {x: (p) => p[0], y: (p) => p[1], symbol: "triangle", r: 7, rotate: (p) => 90 - p[2] * DEG, fill: "var(--ink)",
          title: () => "start", clip: true}),
        Plot.dot([calculated], {x: (p) => p[0], y: (p) => p[1], r: 4.2, fill: "var(--card)", stroke: "var(--muted)", strokeWidth: 1.6, clip: true}),
        Plot.dot([end], {x: (p) => p[0], y: (p) => p[1], r: 4.2, fill: c, stroke: "var(--card)", strokeWidth: 1, clip: true}),
        Plot.tip(truth, Plot.pointer({x: (p) => p[0], y: (p) => p[1], title: (_, i) => words(i), ...tip})),
      ],
      x: {domain: view.x ?? domain(b[0], b[1]), label: "x (m)", labelAnchor: "center"}, y: {domain: view.y ?? domain(b[2], b[3]), label: "y (m)"},
    },
  };
}

function legendOf(data: RunData, all: string[]): Html {
  const dot = (css: string) => html`<svg width="12" height="12" aria-hidden="true"><circle class="${css}" cx="6" cy="6" r="4.2"/></svg>`;
  const items: [Html, unknown][] = all.map((d) => [lineIcon(colour(d)), `truth, ${d}`]);
  items.push([lineIcon(colour(all[0]), "", 1), "repeats"], [lineIcon("var(--muted)", "6 4"), "odometry"],
             [html`<svg width="18" height="14" aria-hidden="true"><path class="robot-icon" d="M15 7L3 12V2Z"/></svg>`, "start"],
             [dot("end-icon"), "true end"], [dot("calculated-icon"), "calculated end"]);
  if (data.bumps.length) items.push([lineIcon("var(--bump)", "3 4", 8), "cable"]);
  if (data.runs.some((r) => r.ellipses?.length)) {
    items.push([html`<svg width="24" height="14" aria-hidden="true"><ellipse class="spread-icon" cx="12" cy="7" rx="11" ry="6"/></svg>`, "95 % ellipse"]);
  }
  if (data.runs.some((r) => r.fixes?.length)) {
    items.push([html`<svg width="16" height="16" aria-hidden="true"><path class="calculated-icon" d="M8 1L15 8L8 15L1 8Z"/></svg>`, "absolute fix"]);
  }
  return legend(items);
}
