// Driven paths side by side, a panel for each direction: a run is chosen in each, differences are enlarged by a slider, and a
// cursor shows the replay's moment.

import {extent} from "d3";
import {Chart, type Drawing, type Range} from "./chart";
import {factorAt, factorFor, sayFactor, slider} from "./enlarge";
import {directionName} from "./format";
import {fill, find, html, type Html} from "./html";
import type {Shared} from "./shared";

export type Box = [number, number, number, number];

export const boundsOf = (points: number[][]): Box => [0, 1].flatMap((i) => extent(points, (p) => p[i]) as Range) as Box;
export const spanOf = (b: Box): number => Math.max(b[1] - b[0], b[3] - b[2]);

/// Axes in metres about a box, with equal scales.
export function axesAbout(b: Box, span: number): Pick<Drawing, "x" | "y"> {
  const domain = (low: number, high: number): Range => [(low + high - span) / 2, (low + high + span) / 2];
  return {x: {domain: domain(b[0], b[1]), label: "x (m)"}, y: {domain: domain(b[2], b[3]), label: "y (m)"}};
}

/// Between two points, at an index with a fraction.
export function between(points: number[][], index: number): {x: number; y: number} {
  const i = Math.max(0, Math.min(Math.floor(index), points.length - 2));
  const [p, q, share] = [points[i], points[i + 1], Math.min(1, index - i)];
  return {x: p[0] + share * (q[0] - p[0]), y: p[1] + share * (q[1] - p[1])};
}

interface Driven {
  id: string;
  direction: string;
}

export interface Routes<R extends Driven> {
  id: string;                              // of the charts
  title?: Html;
  runs: R[];
  chosen: Shared<Record<string, R>>;       // by direction
  name: (run: R) => string;
  about: (run: R) => Html;                 // over the panel
  difference: string;                      // what is enlarged
  size_m: number;                          // of a path
  largest_m: number;                       // difference
  foot: Html;
  path: (run: R, factor: number) => number[][];  // as it is shown
  draw: (run: R, factor: number) => Drawing;
  moment: Shared<{run: R; index: number} | null>;
}

/// Gives back what draws all panels again.
export function setupRoutes<R extends Driven>(place: HTMLElement, r: Routes<R>): () => void {
  const directions = Object.keys(r.chosen.value);
  const run = (i: number) => r.chosen.value[directions[i]];
  let factor = factorFor(r.size_m, r.largest_m);
  fill(place, html`${r.title}<figure><div class="controls">${slider(r.difference, factor)}</div>
    <div class="panels">${directions.map((d, i) => html`<div class="panel${directions.length === 1 ? " alone" : ""}">
      <label>Run <select data-direction="${d}" aria-label="${directionName(d)} run">${r.runs.filter((own) => own.direction === d).map((own) =>
          html`<option value="${r.runs.indexOf(own)}">${r.name(own)}</option>`)}</select></label>
      <p class="panel-title"></p><div id="${r.id}-${i}"></div></div>`)}</div>${r.foot}</figure>`);
  const charts = directions.map((d, i) => new Chart(find(place, `#${r.id}-${i}`), {
    name: `${r.id}-${d}`, zoom: "square", draw: () => r.draw(run(i), factor)}));
  const cursor = () => charts.forEach((chart, i) => {
    const m = r.moment.value;
    chart.cursor(m?.run === run(i) ? [{...between(r.path(run(i), factor), m.index), colour: "var(--accent)"}] : []);
  });
  const redraw = () => {
    sayFactor(place, factor, r.size_m, r.largest_m);
    place.querySelectorAll(".panel-title").forEach((title, i) => fill(title, r.about(run(i))));
    place.querySelectorAll("select").forEach((select, i) => (select.value = String(r.runs.indexOf(run(i)))));
    charts.forEach((chart) => chart.redraw());
    cursor();
  };
  place.addEventListener("input", (event) => {
    const input = event.target as HTMLInputElement;
    if (input.dataset.direction) return r.chosen.set({...r.chosen.value, [input.dataset.direction]: r.runs[Number(input.value)]});
    if (!input.matches("input.enlarge")) return;  // a chart whose tip moves says so, too
    factor = factorAt(input);
    redraw();
  });
  r.chosen.on(redraw);
  r.moment.on(cursor);
  redraw();
  return redraw;
}

