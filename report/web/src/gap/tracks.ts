// Figure 1 of a diagnosis: runs as recorded and as predicted, with the differences enlarged; runs that repeat each other
// share a panel.

import * as Plot from "@observablehq/plot";
import {type Drawing} from "../lib/chart";
import {capital, colour, directionName, fixed, mmUnit, plural} from "../lib/format";
import {html, type Html} from "../lib/html";
import {icon, legend, lineIcon} from "../lib/page";
import {axesAbout, boundsOf, setupRoutes, spanOf} from "../lib/routes";
import {Shared} from "../lib/shared";
import type {Pose} from "../run/data";
import {outline} from "../run/statistics";
import type {GapData, GapRun} from "./data";

/// A prediction as shown: recorded + k (predicted - recorded).
const shown = (run: GapRun, track: Pose[], k: number): [number, number][] => track.map((p, i) => {
  const r = run.recorded[Math.min(i, run.recorded.length - 1)];
  return [r[0] + k * (p[0] - r[0]), r[1] + k * (p[1] - r[1])];
});

const off = (run: GapRun, track: Pose[], i: number): number => Math.hypot(track[i][0] - run.recorded[i][0], track[i][1] - run.recorded[i][1]);
const errorOf = (run: GapRun): number => Math.max(0, ...run.before.map((_, i) => (run.recorded[i] ? off(run, run.before, i) : 0)));

export interface GapMoment {
  run: GapRun;
  index: number;
}

export function setupTracks(data: GapData, place: HTMLElement, moment: Shared<GapMoment | null>): void {
  const runs = data.runs.filter((r) => r.recorded.length > 1);
  const groups = [...new Set(runs.map((r) => r.direction))];
  const chosen = new Shared<Record<string, GapRun>>(Object.fromEntries(groups.map((g) => [g, runs.find((r) => r.direction === g)!])));
  const about = ({direction}: GapRun) => {
    const own = runs.filter((r) => r.direction === direction).map(errorOf);
    return html`${capital(directionName(direction))}<span class="muted">: ${plural(own.length, "run")}, off by ${mmUnit(Math.min(...own))} to ${mmUnit(Math.max(...own))} at most</span>`;
  };
  setupRoutes(place, {
    id: "gap-path", runs, chosen, moment, name: (r) => r.id, about, difference: "Differences shown",
    largest_m: Math.max(...runs.map(errorOf)), size_m: Math.max(...runs.map((r) => spanOf(boundsOf(r.recorded)))), path: (r) => r.recorded, draw: (run, k) => drawing(data, runs, run, k),
    foot: html`${legendOf(data, groups)}<figcaption>The runs as the tracker recorded them and as the simulator drives them from the recorded ticks; the
      chosen run is drawn bold, the others of its direction thin. Start pose and frame are fitted to each run. <b>Broad bands</b> mark the parts of the run in which
      the scenario errs; the darker, the more evidence.</figcaption>`});
}

function drawing(data: GapData, runs: GapRun[], run: GapRun, k: number): Drawing {
  const others = runs.filter((r) => r.direction === run.direction && r !== run);
  const before = shown(run, run.before, k);
  const after = run.after ? shown(run, run.after, k) : [];
  const place: [number, number] | undefined = data.diagnosis.where?.place_m;
  const bounds = boundsOf([...run.recorded, ...before, ...after, ...others.flatMap((r) => shown(r, r.before, k)), ...(place ? [place] : [])]);
  const most = Math.max(1e-9, ...runs.flatMap((r) => r.parts.map((p) => p.score)));
  const c = colour(run.direction);
  const patches: {x_m: number; y_m: number; radius_m: number}[] = data.floor?.patches ?? [];  // that the twin has
  return {
    label: `Run ${run.id}: recorded path solid, scenario dashed${after.length ? ", twin dotted" : ""}, differences shown ${k} times` +
        (run.parts.length ? `, ${plural(run.parts.length, "part")} marked that score` : ""),
    ...axesAbout(bounds, 1.12 * Math.max(spanOf(bounds), 0.01)), every: 8,
    points: run.recorded.slice(0, run.before.length).map((p, i) => ({x: p[0], y: p[1], words: `${run.id}${run.time_s ? `, after ${fixed(run.time_s[i], 1)} s` : ""}\n` +
        `x ${fixed(p[0], 3)} m, y ${fixed(p[1], 3)} m\nscenario off by ${mmUnit(off(run, run.before, i))}${run.after ? `\ntwin off by ${mmUnit(off(run, run.after, i))}` : ""}`})),
    marks: [
      ...run.parts.map((p) => Plot.line(run.recorded.slice(p.from, p.to + 1), {stroke: "var(--bump)", strokeWidth: 9, strokeLinecap: "round",
        strokeOpacity: 0.2 + 0.6 * p.score / most, className: "scored"})),
      ...others.map((r) => Plot.line(shown(r, r.before, k), {stroke: "var(--muted)", strokeOpacity: 0.35, strokeWidth: 1, className: "repeat"})),
      ...others.map((r) => Plot.line(r.recorded, {stroke: c, strokeOpacity: 0.3, strokeWidth: 1, className: "repeat"})),
      Plot.line(before, {stroke: "var(--muted)", strokeWidth: 1.8, strokeDasharray: "6 4", className: "odometry"}),
      Plot.line(run.recorded, {stroke: c, strokeWidth: 2.2, className: "truth"}),
      after.length ? Plot.line(after, {stroke: "var(--accent)", strokeWidth: 2, strokeDasharray: "2 3", className: "twin"}) : null,
      place ? Plot.dot([place], {r: 11, stroke: "var(--bump)", strokeWidth: 2.4, className: "place"}) : null,
      ...patches.map((p) => Plot.line(outline([p.x_m, p.y_m], p.radius_m, p.radius_m, 0), {stroke: "var(--bump)", strokeDasharray: "3 3", fill: "var(--bump)", fillOpacity: 0.06})),
      Plot.dot(run.recorded.slice(0, 1), {r: 3.6, fill: "var(--card)", stroke: "var(--ink)", strokeWidth: 1.8}),
      Plot.dot(run.recorded.slice(-1), {r: 4.2, fill: c, stroke: "var(--card)"})],
  };
}

function legendOf(data: GapData, groups: string[]): Html {
  const items: [Html, unknown][] = [...groups.map((g): [Html, unknown] => [lineIcon(colour(g)), `recorded, ${directionName(g)}`]),
    [lineIcon("var(--muted)", "6 4"), "predicted by the scenario"]];
  if (data.runs.some((r) => r.after)) items.push([lineIcon("var(--accent)", "2 3"), "predicted by the twin"]);
  items.push([lineIcon(colour(groups[0]), "", 1), "other runs"], [lineIcon("var(--bump)", "", 8), "parts that score"]);
  if (data.diagnosis.where?.place_m) items.push([icon("place-icon"), "the place"]);
  return legend(items);
}
