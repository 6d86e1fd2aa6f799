// The page of an explanation: how much of the return error each effect causes.

import * as Plot from "@observablehq/plot";
import {Chart} from "../lib/chart";
import {deg, directionName, mm, mmUnit, NONE, words} from "../lib/format";
import {find, html, type Html} from "../lib/html";
import {build, legend, lineIcon, type Section} from "../lib/page";
import {table} from "../lib/table";
import type {Figures, RunData} from "../run/data";
import {choiceOf} from "../run/choice";
import {axesTo, together} from "../run/scatter";
import {provenance} from "../run/tables";
import {replaySection} from "../replay/section";
import {COLOURS} from "./bars";

interface Arrow {
  name: string;
  colour: string;
  from: [number, number];
  to: [number, number];
  share: Figures;
}

/// Each effect's own error as an arrow, one after the other, from the origin to the sum; then what their interaction adds.
function arrows(e: Figures, direction: string): Arrow[] {
  let at: [number, number] = [0, 0];
  const step = (name: string, share: Figures, i: number): Arrow => {
    const from = at;
    at = [at[0] + 1000 * share.x_m, at[1] + 1000 * share.y_m];
    return {name, colour: COLOURS[i % COLOURS.length], from, to: at, share};
  };
  return [
    ...(e.without_effects?.[direction]?.distance_m > 1e-6 ? [step("without any effect", e.without_effects[direction], 4)] : []),
    ...e.effects.filter((f: Figures) => f.alone?.[direction]).map((f: Figures, i: number) => step(words(f.name), f.alone[direction], i % 4)),
    ...(e.interaction?.[direction] ? [step("interaction", e.interaction[direction], 5)] : [])];
}

function chart(e: Figures, direction: string, place: HTMLElement): void {
  const steps = arrows(e, direction);
  const reach = 1.12 * Math.max(1e-3, ...steps.flatMap((s) => [...s.from, ...s.to]).map(Math.abs));
  const ends = steps.map((s) => ({x: s.to[0], y: s.to[1], words: `${s.name}\nx ${mmUnit(s.share.x_m)}\ny ${mmUnit(s.share.y_m)}\nheading ${deg(s.share.heading_rad)}°`}));
  new Chart(place, {
    name: `explained-${direction}`, zoom: "square", draw: () => ({
      label: `What makes the ${directionName(direction)} return error: ${steps.map((s) => `${s.name} ${mmUnit(Math.hypot(s.share.x_m, s.share.y_m))}`).join(", ")}`,
      points: together(ends, reach), ...axesTo(reach, "x error (mm)", "y error (mm)"), plot: {color: {type: "identity"}},
      marks: [Plot.arrow(steps, {x1: (s) => s.from[0], y1: (s) => s.from[1], x2: (s) => s.to[0], y2: (s) => s.to[1], stroke: "colour", strokeWidth: 2.4, headLength: 7, className: "share"}),
        Plot.dot(steps, {x: (s) => s.to[0], y: (s) => s.to[1], r: 4, fill: "colour"})]})});
}

function shares(e: Figures, direction: string): Html {
  const row = (name: string, f?: Figures) => [name, ...(f ? [mm(f.x_m), mm(f.y_m), mm(f.distance_m), deg(f.heading_rad)] : [NONE, NONE, NONE, NONE])];
  const of = (words: string, rows: unknown[][]) => table({
    caption: `Driven ${directionName(direction)}, ${words}`, stack: true, head: ["effect", "x (mm)", "y (mm)", "distance (mm)", "heading (°)"], rows});
  const each = (key: "alone" | "missed") => e.effects.map((f: Figures) => row(words(f.name), f[key]?.[direction]));
  return html`<div class="pair">${of("alone: what each effect adds to a robot without any", [...each("alone"), row("sum of all alone", e.sum_alone?.[direction]),
    row("interaction", e.interaction?.[direction]), row("without any effect", e.without_effects?.[direction]), row("whole scenario", e.whole?.[direction])])}
    ${of("missed: what the scenario loses without it", each("missed"))}</div>`;
}

export function showExplanation(data: Figures): Promise<void> {
  const e = data.explanation;
  const directions = ["cw", "ccw"].filter((d) => e.whole?.[d]);
  const names = arrows(e, directions[0]);
  const figure: Section = {
    id: "figure-1", title: "Figure 1. From effect to effect", content: html`<figure><div class="panels">${directions.map((d) => html`<div class="panel"><p class="panel-title">Driven ${directionName(d)}</p>
      <div id="explained-${d}"></div></div>`)}</div>${legend(names.map((s) => [lineIcon(s.colour), s.name]))}<figcaption>Each arrow is what one effect alone adds to the mean
      return error; together they lead from a robot without effects to the scenario's own error. What is left over is their interaction.</figcaption></figure>`,
    setup: (section) => directions.forEach((d) => chart(e, d, find(section, `#explained-${d}`)))};
  const runs = data.runs ? {...data, summary: {}, bumps: []} as unknown as RunData : null;
  return build({
    title: data.title, description: data.description, footer: `umbsim ${data.version}`,
    headline: html`The return error of <b>${e.scenario}</b> is ${directions.map((d, i) => html`${i ? " and " : ""}<b>${mmUnit(e.whole[d].distance_m)}</b> ${directionName(d)}`)}.`,
    sections: [figure, runs && replaySection(runs, choiceOf(runs)), {id: "shares", title: "Shares", content: html`${directions.map((d) => shares(e, d))}
      <p class="muted">Where both differ, effects act on each other.</p>`},
      {id: "provenance", title: "Provenance", content: provenance(data)}],
  });
}
