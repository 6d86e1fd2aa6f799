// Figure 2: driven paths, truth against odometry, with the error enlarged; repeats of the chosen run stand behind it.

import * as Plot from "@observablehq/plot";
import {type Drawing, type Range} from "../lib/chart";
import {capital, colour, DEG, degUnit, directionName, fixed, isNumber, mmUnit, plural, stageName} from "../lib/format";
import {html, type Html} from "../lib/html";
import {heading, icon, legend, lineIcon, SPREAD, type Section} from "../lib/page";
import {axesAbout, boundsOf, setupRoutes, spanOf} from "../lib/routes";
import {CAPTIONS} from "./captions";
import {directions, repeats, type Choice} from "./choice";
import {hasError, hasTrack, type Pose, type RunData, type Tracked} from "./data";
import {errorSeries, poseAt, samplesOf} from "./series";
import {outline} from "./statistics";

/// Truth as shown: odometry + k (truth - odometry).
export function enlarged(run: Tracked, k: number): Pose[] {
  return run.odometry.slice(0, samplesOf(run)).map((o, i) => o.map((v, c) => v + k * (run.truth[i][c] - v)) as Pose);
}

const largestError = (run: Tracked): number => Math.max(0, ...errorSeries(run).map((s) => s.position)) / 1000;
const largest = (run: Tracked): number => Math.max(largestError(run), ...(run.ellipses ?? []).map((e) => e[2]));

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
  const all = directions(choice);
  if (!all.length) return null;
  const chosen = Object.values(choice.runs.value);
  const uncertain = data.runs.some((r) => r.ellipses?.length);
  return {id: "figure-2", setup: (section) => choice.stretch.on(setupRoutes(section, {
    id: "path", title: heading("figure-2", "Figure 2. Driven paths"), runs: data.runs.filter(hasTrack), chosen: choice.runs, moment: choice.moment,
    name: (r) => `${r.id}, ${stageName(r.stage)}`, about: returnError, difference: "Error shown",
    largest_m: Math.max(...chosen.map(largest)), size_m: Math.max(...chosen.map((r) => spanOf(boundsOf(r.odometry)))), path: enlarged, draw: (run, k) => drawing(data, choice, run, k),
    foot: html`${legendOf(data, all)}<figcaption>${CAPTIONS.paths}${uncertain && CAPTIONS.ellipses}</figcaption>`}))};
}

function returnError(run: Tracked): Html {
  const e = run.error;
  return html`${capital(directionName(run.direction))}<span class="muted">${
      hasError(run) ? `: return error ${mmUnit(Math.hypot(e!.x_m, e!.y_m))}, ${degUnit(e!.theta_rad)}` : ""}</span>`;
}

const DASH = {draw: (path: {moveTo: (x: number, y: number) => void; lineTo: (x: number, y: number) => void}, l: number) => {
  path.moveTo(0, -l / 2);
  path.lineTo(0, l / 2);
}};

function drawing(data: RunData, choice: Choice, run: Tracked, k: number): Drawing {
  const extent = (r: Tracked) => boundsOf([...r.odometry, ...enlarged(r, k), ...cablesShown(data, r, k), ...ellipsesShown(r, k).flat()]);
  const span = Math.max(...Object.values(choice.runs.value).map((r) => spanOf(extent(r))), 0.01) * 1.1;
  const truth = enlarged(run, k);
  const cables = cablesShown(data, run, k);
  const [end, calculated] = [truth[truth.length - 1], run.odometry[truth.length - 1]];
  const [from, to] = choice.stretch.value ?? [1, 0] as Range;
  const stretch = errorSeries(run).filter((s) => s.distance >= from && s.distance <= to);
  const c = colour(run.direction);
  return {
    label: `Path of run ${run.id}, truth solid against odometry dashed, in metres, error shown ${k} times` +
        (cables.length ? `, ${plural(cables.length, "cable")} marked` : ""),
    ...axesAbout(extent(run), span), every: 8,
    points: errorSeries(run).map((s, i) => ({x: truth[i][0], y: truth[i][1], words: `${fixed(s.distance, 2)} m driven\n` +
        `x ${fixed(run.truth[i][0], 3)} m, y ${fixed(run.truth[i][1], 3)} m\nposition error ${fixed(s.position, 1)} mm\nheading error ${fixed(s.heading, 3)}°`})),
    marks: [
      ...ellipsesShown(run, k).map((e) => Plot.line(e, {stroke: c, strokeOpacity: 0.7, fill: c, fillOpacity: 0.1, strokeWidth: 1, className: "ellipse"})),
      ...repeats(data, run).filter((r) => r !== run).map((r) => Plot.line(enlarged(r, k), {stroke: c, strokeOpacity: 0.3, strokeWidth: 1, className: "repeat"})),
      Plot.line(stretch.map((s) => truth[s.index]), {stroke: "var(--bump)", strokeWidth: 9, strokeOpacity: 0.45, strokeLinecap: "round", className: "stretch"}),
      Plot.line(run.odometry.slice(0, truth.length), {stroke: "var(--muted)", strokeDasharray: "6 4", strokeWidth: 1.6, className: "odometry"}),
      Plot.line(truth, {stroke: c, strokeWidth: 2.2, className: "truth"}),
      Plot.vector(cables, {rotate: (p) => -p[2] * DEG, length: 10, shape: DASH, stroke: "var(--bump)", strokeWidth: 3, className: "cable"}),
      Plot.dot((run.fixes ?? []).map((i) => truth[i]), {symbol: "diamond", r: 7, fill: "var(--card)", stroke: "var(--ink)", strokeWidth: 1.8, className: "fix"}),
      Plot.line([calculated, end], {stroke: "var(--ink)", strokeWidth: 1.4}),
      Plot.dot([run.odometry[0]], {symbol: "triangle", r: 7, rotate: (p) => 90 - p[2] * DEG, fill: "var(--ink)"}),
      Plot.dot([calculated], {r: 4.2, fill: "var(--card)", stroke: "var(--muted)", strokeWidth: 1.6}), Plot.dot([end], {r: 4.2, fill: c, stroke: "var(--card)"})],
  };
}

function legendOf(data: RunData, all: string[]): Html {
  const items: [Html, unknown][] = [
    ...all.map((d): [Html, unknown] => [lineIcon(colour(d)), `truth, ${d}`]), [lineIcon(colour(all[0]), "", 1), "repeats"], [lineIcon("var(--muted)", "6 4"), "odometry"],
    [icon("robot-icon", "M15 7L3 12V2Z"), "start"], [icon("end-icon"), "true end"], [icon("calculated-icon"), "calculated end"]];
  if (data.bumps.length) items.push([lineIcon("var(--bump)", "3 4", 8), "cable"]);
  if (data.runs.some((r) => r.ellipses?.length)) items.push([icon("spread-icon", SPREAD), "95 % ellipse"]);
  if (data.runs.some((r) => r.fixes?.length)) items.push([icon("calculated-icon", "M8 1L15 8L8 15L1 8Z"), "absolute fix"]);
  return legend(items);
}
