// The page of a gap diagnosis: the gap, where, which, how far, what next.

import {Chart} from "../lib/chart";
import {DEG, fixed, plural} from "../lib/format";
import {fill, find, html, raw, type Html} from "../lib/html";
import {build, legend, markerIcon} from "../lib/page";
import {Shared} from "../lib/shared";
import {axesTo, endMarks, together, type End} from "../run/scatter";
import {provenance} from "../run/tables";
import {gapReplay} from "../replay/section";
import {closure, next, tiles, whereText, which} from "./causes";
import type {GapData} from "./data";
import {setupStrip} from "./strip";
import {setupTracks, type GapMoment} from "./tracks";

function setupEnds(data: GapData, place: HTMLElement): void {
  const ends = data.runs.flatMap((run) => (["before", "after"] as const).filter((s) => run.end?.[s]).map((stage): End => {
    const {x_m, y_m, theta_rad} = run.end[stage];
    return {x: x_m * 1000, y: y_m * 1000, direction: run.direction, stage, words: `${run.id}, ${stage === "before" ? "scenario" : "twin"}\n` +
        `ahead ${fixed(x_m * 1000, 1)} mm\nleft ${fixed(y_m * 1000, 1)} mm\nheading ${fixed(theta_rad * DEG, 3)}°`};
  }));
  const reach = 1.15 * Math.max(1, ...ends.flatMap((e) => [Math.abs(e.x), Math.abs(e.y)]));
  fill(place, html`<div id="gap-ends"></div>${legend([[markerIcon("cw", "before"), "clockwise, scenario"], [markerIcon("ccw", "before"), "counter-clockwise, scenario"],
    ...(ends.some((e) => e.stage === "after") ? [[markerIcon("cw", "after"), "with the twin (filled)"] as [Html, string]] : [])])}`);
  new Chart(find(place, "#gap-ends"), {
    name: "end-errors", zoom: "square", most: 480, draw: () => ({
      label: `End-point errors of ${plural(data.runs.length, "run")}, before and after the effect is added, in millimetres`, points: together(ends, reach),
      ...axesTo(reach, "recorded minus predicted end, ahead (mm)", "to the left (mm)"), marks: endMarks(ends)})});
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
