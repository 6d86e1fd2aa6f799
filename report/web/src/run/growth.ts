// Figure 3: how the error grows along the way. A stretch that is marked here is marked in the paths, too.

import * as Plot from "@observablehq/plot";
import {Chart, type Drawing, type Range} from "../lib/chart";
import {colour, directionName, fixed, stageName} from "../lib/format";
import {fill, find, html} from "../lib/html";
import {heading, legend, lineIcon, type Section} from "../lib/page";
import {between} from "../lib/routes";
import {CAPTIONS} from "./captions";
import {directions, repeats, type Choice} from "./choice";
import type {RunData, Tracked} from "./data";
import {errorSeries, legs, turnDistances} from "./series";

type Key = "position" | "heading";
const UNITS = {position: "mm", heading: "°"};

export function growthSection(data: RunData, choice: Choice): Section | null {
  if (!directions(choice).length) return null;
  return {id: "figure-3", setup: (section) => setup(data, choice, section)};
}

function setup(data: RunData, choice: Choice, section: HTMLElement): void {
  const first = () => Object.values(choice.runs.value)[0];
  const stretches = legs(errorSeries(first()));
  fill(section, html`${heading("figure-3", "Figure 3. The error along the way")}<figure>
    <div class="controls"><label>Mark in the paths <select aria-label="Stretch that is marked"><option value="">nothing</option>${
      stretches.length < 40 && stretches.map((r, i) => html`<option value="${i}">leg ${i + 1}, ${fixed(r[0], 1)} to ${fixed(r[1], 1)} m</option>`)}
      <option value="own" hidden>own stretch</option></select></label><span class="muted">or drag along a curve</span></div>
    <div class="panels"><div class="panel"><p class="panel-title">Position error</p><div id="growth-position"></div></div>
      <div class="panel"><p class="panel-title">Heading error</p><div id="growth-heading"></div></div></div>
    <div class="legend-slot"></div><figcaption>${CAPTIONS.growth}</figcaption></figure>`);
  const select = find<HTMLSelectElement>(section, "select");
  const charts = (["position", "heading"] as const).map((key) => new Chart(find(section, `#growth-${key}`), {
    name: `${key}-error`, draw: (width) => drawing(data, choice, key, width),
    brush: (range) => {
      select.value = range ? "own" : "";
      choice.stretch.set(range);
    },
    click: (x) => {
      const run = choice.moment.value?.run ?? first();
      const series = errorSeries(run);
      choice.moment.set({run, clicked: true, index: series.reduce((best, s) => (Math.abs(s.distance - x) < Math.abs(series[best].distance - x) ? s.index : best), 0)});
    }}));
  const words = () => fill(find(section, ".legend-slot"), legend(Object.values(choice.runs.value).map((run) => [
    lineIcon(colour(run.direction), run.direction === "ccw" ? "7 3" : ""), `${run.id}, ${stageName(run.stage)}`])));
  words();
  select.addEventListener("change", () => choice.stretch.set(stretches[Number(select.value || NaN)] ?? null));
  choice.runs.on(() => {
    charts.forEach((chart) => chart.redraw());
    words();
  });
  choice.moment.on((moment) => charts.forEach((chart) => {
    if (!moment) return chart.cursor([]);
    const {x} = between(errorSeries(moment.run).map((s) => [s.distance, 0]), moment.index);
    chart.cursor([{x, colour: "var(--accent)"}]);
  }));
}

function padded(values: number[]): Range {
  const [low, high] = [Math.min(0, ...values), Math.max(0, ...values)];
  const pad = Math.max(high - low, 1e-3) * 0.06;
  return [low < 0 ? low - pad : 0, Math.max(high, low + 1e-3) + pad];
}

function drawing(data: RunData, choice: Choice, key: Key, width: number): Drawing {
  const chosen = Object.values(choice.runs.value);
  const others = chosen.flatMap((run) => repeats(data, run)).filter((run) => !chosen.includes(run));
  const all = [...chosen, ...others].map(errorSeries);
  const curve = (run: Tracked, faint: boolean) => Plot.line(errorSeries(run), {
    x: "distance", y: key, stroke: colour(run.direction), strokeWidth: faint ? 1 : 2, strokeOpacity: faint ? 0.35 : 1,
    strokeDasharray: run.direction === "ccw" ? "7 3" : undefined, className: faint ? "repeat" : "series"});
  const ends = chosen.map((run) => `${directionName(run.direction)} run ${run.id} ends at ${fixed(errorSeries(run).at(-1)![key], 2)} ${UNITS[key]}`);
  return {
    label: `${key === "position" ? "Position" : "Heading"} error over the distance driven: ${ends.join(", ")}`, height: Math.max(250, width * 0.62),
    points: chosen.flatMap((run) => errorSeries(run).map((s) => ({x: s.distance, y: s[key], words: `${run.id}, ${stageName(run.stage)}\n` +
        `${fixed(s.distance, 2)} m driven\nposition error ${fixed(s.position, 1)} mm\nheading error ${fixed(s.heading, 3)}°`}))), every: 8,
    x: {domain: [0, 1.02 * Math.max(0.01, ...all.map((s) => s.at(-1)!.distance))], label: "distance driven (m)"},
    y: {domain: padded(all.flat().map((s) => s[key])), label: `${key} error (${UNITS[key]})`},
    marks: [Plot.ruleX(turnDistances(errorSeries(chosen[0])), {stroke: "var(--axis)", strokeDasharray: "1 4"}),
      ...others.map((run) => curve(run, true)), ...chosen.map((run) => curve(run, false))],
  };
}
