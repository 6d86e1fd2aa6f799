// The page of a gap diagnosis: the gap, where, which, how far, what next.

import * as Plot from "@observablehq/plot";
import {Chart, grid, square, tip} from "../lib/chart";
import {colour, DEG, fixed, plural} from "../lib/format";
import {fill, find, html, raw, type Html} from "../lib/html";
import {build, legend, markerIcon} from "../lib/page";
import {Shared} from "../lib/shared";
import {provenance} from "../run/tables";
import {gapReplay} from "../replay/section";
import {closure, next, tiles, whereText, which} from "./causes";
import type {GapData} from "./data";
import {setupStrip} from "./strip";
import {setupTracks, type GapMoment} from "./tracks";

function setupEnds(data: GapData, place: HTMLElement): void {
  const points = data.runs.flatMap((run) => (["before", "after"] as const).filter((s) => run.end?.[s]).map((stage) => ({run, stage, ...run.end[stage]})));
  const reach = 1.15 * Math.max(0.001, ...points.map((p) => Math.max(Math.abs(p.x_m), Math.abs(p.y_m)))) * 1000;
  const dots = (direction: string, stage: string) => Plot.dot(points.filter((p) => p.run.direction === direction && p.stage === stage), {
    x: (p) => p.x_m * 1000, y: (p) => p.y_m * 1000, r: 4.6, symbol: direction === "cw" ? "circle" : direction === "ccw" ? "triangle" : "square", clip: true,
    stroke: stage === "after" ? "var(--card)" : colour(direction), fill: stage === "after" ? colour(direction) : "var(--card)", strokeWidth: 1.6, tip,
    title: (p) => `${p.run.id}, ${stage === "before" ? "scenario" : "twin"}\nahead ${fixed(p.x_m * 1000, 1)} mm\nleft ${fixed(p.y_m * 1000, 1)} mm\nheading ${fixed(p.theta_rad * DEG, 3)}°`,
    className: `end-point ${stage}`});
  const directions = [...new Set(data.runs.map((r) => r.direction))];
  fill(place, html`<div id="gap-ends"></div>${legend([[markerIcon("cw", "before"), "clockwise, scenario"], [markerIcon("ccw", "before"), "counter-clockwise, scenario"],
    ...(points.some((p) => p.stage === "after") ? [[markerIcon("cw", "after"), "with the twin (filled)"] as [Html, string]] : [])])}`);
  new Chart(find(place, "#gap-ends"), {
    name: "end-errors", zoom: "square", most: 480,
    draw: (width, view) => ({
      label: `End-point errors of ${plural(data.runs.length, "run")}, before and after the effect is added, in millimetres`,
      stops: points.map((p) => [p.x_m * 1000, p.y_m * 1000]),
      plot: {...square(width), x: {domain: view.x ?? [-reach, reach], label: "recorded minus predicted end, ahead (mm)", labelAnchor: "center"},
             y: {domain: view.y ?? [-reach, reach], label: "to the left (mm)"},
             marks: [...grid(), ...directions.flatMap((d) => [dots(d, "before"), dots(d, "after")])]},
    })});
}

export function showGap(data: GapData): Promise<void> {
  data.runs ??= [];
  const d = data.diagnosis;
  const moment = new Shared<GapMoment | null>(null);
  return build({
    title: data.title, headline: html`${d.verdict}`, tiles: tiles(d), footer: `umbsim ${data.version}`,
    sections: [
      {id: "where", title: "Where", content: html`${whereText(d)}<div class="tracks"></div><div class="strip"></div>`,
       setup: (section) => {
         if (data.runs.some((r) => r.recorded.length > 1)) setupTracks(data, find(section, ".tracks"), moment);
         setupStrip(data, find(section, ".strip"));
       }},
      gapReplay(data, moment),
      {id: "which", title: "Which", content: which(d)},
      {id: "how-far", title: "How far", content: html`<div class="beside"><div id="ends"></div><div>${closure(d)}</div></div>`,
       setup: (section) => setupEnds(data, find(section, "#ends"))},
      {id: "what-next", title: "What next", content: next(data)},
      {id: "provenance", title: "Provenance", content: data.provenance ? provenance(data) : raw("")},
    ],
  });
}
