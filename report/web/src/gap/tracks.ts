// Figure 1 of a diagnosis: runs as recorded and as predicted, with the differences enlarged; runs that repeat each other
// share a panel.

import * as Plot from "@observablehq/plot";
import {Chart, grid, square, tip, type Drawing, type Range, type View} from "../lib/chart";
import {factorAt, factorFor, sayFactor, slider} from "../lib/enlarge";
import {capital, colour, directionName, fixed, mmUnit, plural} from "../lib/format";
import {fill, find, html, type Html} from "../lib/html";
import {legend, lineIcon} from "../lib/page";
import {Shared} from "../lib/shared";
import type {Pose} from "../run/data";
import {boundsOf, line, spanOf} from "../run/paths";
import {outline} from "../run/statistics";
import type {GapData, GapRun} from "./data";

/// A prediction as shown: recorded + k (predicted - recorded).
const shown = (run: GapRun, track: Pose[], k: number): [number, number][] => track.map((p, i) => {
  const r = run.recorded[Math.min(i, run.recorded.length - 1)];
  return [r[0] + k * (p[0] - r[0]), r[1] + k * (p[1] - r[1])];
});

const errorOf = (run: GapRun): number =>
    Math.max(0, ...run.before.map((p, i) => Math.hypot(p[0] - (run.recorded[i] ?? p)[0], p[1] - (run.recorded[i] ?? p)[1])));

export interface GapMoment {
  run: GapRun;
  index: number;
}

export function setupTracks(data: GapData, place: HTMLElement, moment: Shared<GapMoment | null>): void {
  const runs = data.runs.filter((r) => r.recorded.length > 1);
  const groups = [...new Set(runs.map((r) => r.direction))];
  const chosen = new Map(groups.map((g) => [g, runs.find((r) => r.direction === g)!]));
  const size = Math.max(...runs.map((r) => spanOf(boundsOf(r.recorded))));
  let k = factorFor(size, Math.max(...runs.map(errorOf)));
  const panel = (group: string, i: number) => {
    const own = runs.filter((r) => r.direction === group);
    return html`<div class="panel${groups.length === 1 ? " alone" : ""}"><label>Run <select data-group="${group}" aria-label="${directionName(group)} run">${
      own.map((r) => html`<option value="${runs.indexOf(r)}">${r.id}</option>`)}</select></label>
      <p class="panel-title">${capital(directionName(group))}<span class="muted">: ${plural(own.length, "run")}, off by ${
        mmUnit(Math.min(...own.map(errorOf)))} to ${mmUnit(Math.max(...own.map(errorOf)))} at most</span></p><div id="gap-path-${i}"></div></div>`;
  };
  fill(place, html`<figure><div class="controls">${slider("Differences shown", k)}</div><div class="panels">${groups.map(panel)}</div>
    ${legendOf(data, groups)}<figcaption>The runs as the tracker recorded them and as the simulator drives them from the recorded ticks; the
      chosen run is drawn bold, its repeats thin. Start pose and frame are fitted to each run. <b>Broad bands</b> mark the parts of the run in which
      the scenario errs; the darker, the more evidence.</figcaption></figure>`);
  const charts = groups.map((group, i) => new Chart(find(place, `#gap-path-${i}`), {
    name: `gap-path-${group}`, zoom: "square", draw: (width, view) => drawing(data, runs, chosen.get(group)!, k, width, view)}));
  const cursor = () => charts.forEach((chart, i) => {
    const m = moment.value;
    const run = chosen.get(groups[i])!;
    const at = m && run.recorded[Math.min(Math.round(m.index), run.recorded.length - 1)];
    chart.cursor(m?.run === run && at ? [{x: at[0], y: at[1], colour: "var(--accent)"}] : []);
  });
  sayFactor(place, k);
  place.addEventListener("input", (event) => {
    const input = event.target as HTMLInputElement;
    if (input.type === "range") k = factorAt(input);
    else chosen.set(input.dataset.group!, runs[Number(input.value)]);
    sayFactor(place, k);
    charts.forEach((chart) => chart.redraw());
    cursor();
  });
  moment.on(cursor);
}

function drawing(data: GapData, runs: GapRun[], run: GapRun, k: number, width: number, view: View): Drawing {
  const others = runs.filter((r) => r.direction === run.direction && r !== run);
  const before = shown(run, run.before, k);
  const after = run.after ? shown(run, run.after, k) : [];
  const place: number[] | undefined = data.diagnosis.where?.place_m;
  const b = boundsOf([...run.recorded, ...before, ...after, ...others.flatMap((r) => shown(r, r.before, k)), ...(place ? [place] : [])]);
  const half = Math.max(spanOf(b), 0.01) * 0.56;
  const domain = (low: number, high: number): Range => [(low + high) / 2 - half, (low + high) / 2 + half];
  const most = Math.max(1e-9, ...runs.flatMap((r) => r.parts.map((p) => p.score)));
  const c = colour(run.direction);
  const end = run.recorded[run.recorded.length - 1];
  const words = (i: number) => `${run.id}, ${run.time_s ? `after ${fixed(run.time_s[i], 1)} s\n` : "\n"}x ${fixed(run.recorded[i][0], 3)} m, y ${
    fixed(run.recorded[i][1], 3)} m\nscenario off by ${mmUnit(Math.hypot(run.before[i][0] - run.recorded[i][0], run.before[i][1] - run.recorded[i][1]))}` +
    (run.after ? `\ntwin off by ${mmUnit(Math.hypot(run.after[i][0] - run.recorded[i][0], run.after[i][1] - run.recorded[i][1]))}` : "");
  return {
    label: `Run ${run.id}: recorded path solid, scenario dashed${after.length ? ", twin dotted" : ""}, differences shown ${k} times` +
        (run.parts.length ? `, ${plural(run.parts.length, "part")} marked that score` : ""),
    stops: run.recorded.filter((_, i) => i % 8 === 0).map((p) => [p[0], p[1]]),
    plot: {
      ...square(width), x: {domain: view.x ?? domain(b[0], b[1]), label: "x (m)", labelAnchor: "center"},
      y: {domain: view.y ?? domain(b[2], b[3]), label: "y (m)"},
      marks: [...grid(),
        ...run.parts.map((p) => line(run.recorded.slice(p.from, p.to + 1), {stroke: "var(--bump)", strokeWidth: 9, strokeLinecap: "round",
          strokeOpacity: 0.2 + 0.6 * p.score / most, title: () => `leg ${p.leg}, ${p.part}: score ${fixed(p.score, 1)}`, className: "scored"})),
        ...others.map((r) => line(shown(r, r.before, k), {stroke: "var(--muted)", strokeOpacity: 0.35, strokeWidth: 1, className: "repeat"})),
        ...others.map((r) => line(r.recorded, {stroke: c, strokeOpacity: 0.3, strokeWidth: 1, className: "repeat"})),
        line(before, {stroke: "var(--muted)", strokeWidth: 1.8, strokeDasharray: "6 4", className: "odometry"}),
        line(run.recorded, {stroke: c, strokeWidth: 2.2, className: "truth"}),
        after.length ? line(after, {stroke: "var(--accent)", strokeWidth: 2, strokeDasharray: "2 3", className: "twin"}) : null,
        place ? Plot.dot([place], {x: (p) => p[0], y: (p) => p[1], r: 11, stroke: "var(--bump)", strokeWidth: 2.4, className: "place"}) : null,
        ...floorMarks(data),
        Plot.dot([run.recorded[0]], {x: (p) => p[0], y: (p) => p[1], r: 3.6, fill: "var(--card)", stroke: "var(--ink)", strokeWidth: 1.8, clip: true}),
        Plot.dot([end], {x: (p) => p[0], y: (p) => p[1], r: 4.2, fill: c, stroke: "var(--card)", clip: true}),
        Plot.tip(run.recorded.slice(0, run.before.length), Plot.pointer({x: (p) => p[0], y: (p) => p[1], title: (_, i) => words(i), ...tip}))],
    },
  };
}

/// Patches that the twin has.
const floorMarks = (data: GapData): Plot.Markish[] => (data.floor?.patches ?? []).map((p: {x_m: number; y_m: number; radius_m: number}) =>
    line(outline([p.x_m, p.y_m], p.radius_m, p.radius_m, 0), {stroke: "var(--bump)", strokeDasharray: "3 3", fill: "var(--bump)", fillOpacity: 0.06}));

function legendOf(data: GapData, groups: string[]): Html {
  const items: [Html, unknown][] = groups.map((g) => [lineIcon(colour(g)), `recorded, ${directionName(g)}`]);
  items.push([lineIcon("var(--muted)", "6 4"), "predicted by the scenario"]);
  if (data.runs.some((r) => r.after)) items.push([lineIcon("var(--accent)", "2 3"), "predicted by the twin"]);
  items.push([lineIcon(colour(groups[0]), "", 1), "repeats"], [lineIcon("var(--bump)", "", 8), "parts that score"]);
  if (data.diagnosis.where?.place_m) items.push([html`<svg width="18" height="18" aria-hidden="true"><circle class="place-icon" cx="9" cy="9" r="7"/></svg>`, "the place"]);
  return legend(items);
}
