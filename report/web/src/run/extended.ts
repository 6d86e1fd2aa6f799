// The extended test: heading error against distance, each cable marked where the wheel met it.

import * as Plot from "@observablehq/plot";
import {Chart, type Drawing} from "../lib/chart";
import {colour, deg, degUnit, fixed, isNumber} from "../lib/format";
import {find, html, type Html, raw} from "../lib/html";
import {legend, lineIcon, type Section} from "../lib/page";
import {beside, table} from "../lib/table";
import {CAPTIONS} from "./captions";
import {hasTrack, type RunData, type Tracked} from "./data";
import {errorSeries, poseAt, samplesOf, type Sample} from "./series";

function figures(data: RunData): Html {
  const e = data.summary.extended;
  if (!e) return raw("");
  return beside(table({caption: "Mean absolute heading error", head: ["Quantity", "Value (°)"], rows: [
    ["cw runs", deg(e.cw_mean_abs_heading_error_rad)], ["ccw runs", deg(e.ccw_mean_abs_heading_error_rad)],
    ["extended UMBmark figure (sum of both)", html`<b>${deg(e.mean_abs_heading_error_rad)}</b>`],
    ["per cable", deg(e.per_bump_heading_error_rad)]]}), CAPTIONS.extended);
}

interface Crossing {
  run: Tracked;
  sample: Sample;
  number: number;
  height_m: number;
}

function crossings(data: RunData, run: Tracked): Crossing[] {
  const truth = run.truth.slice(0, samplesOf(run));
  return data.bumps.filter((b) => b.run === run.id && isNumber(b.x_m)).map((b, i) => ({
    run, number: i + 1, height_m: b.height_m, sample: errorSeries(run)[poseAt(truth, b.x_m, b.y_m, data.wheelbase_m ?? 0)]}));
}

export function extendedSection(data: RunData): Section | null {
  const bumped = data.runs.filter(hasTrack).filter((r) => r.stage === "bumped");
  if (!data.summary.extended && !bumped.length) return null;
  const plain = data.runs.filter(hasTrack).filter((r) => r.stage === "before");
  const chart = bumped.length ? html`<figure><div id="extended-chart"></div>${legend([
    [lineIcon("var(--cw)"), "cw with cables"], [lineIcon("var(--ccw)", "7 3"), "ccw with cables"],
    [lineIcon("var(--muted)", "", 1), "without cables"], [lineIcon("var(--bump)", "3 4", 8), "a cable"]])}
    <figcaption>Heading error of every run over the distance driven. Each <b>mark</b> is a cable that the inner wheel crossed: the heading
      steps there, by about the same angle each time, towards the wheel that was lifted.</figcaption></figure>` : raw("");
  return {
    id: "extended", title: "Extended UMBmark", content: html`${chart}${figures(data)}`,
    setup: (section) => {
      if (bumped.length) new Chart(find(section, "#extended-chart"), {name: "extended-heading", most: 980, draw: (width) => drawing(data, bumped, plain, width)});
    },
  };
}

function drawing(data: RunData, bumped: Tracked[], plain: Tracked[], width: number): Drawing {
  const cables = bumped.flatMap((run) => crossings(data, run));
  const curve = (run: Tracked, stroke: string, strokeWidth: number) => Plot.line(errorSeries(run), {
    x: "distance", y: "heading", stroke, strokeWidth, strokeDasharray: run.direction === "ccw" ? "7 3" : undefined, className: "series"});
  return {
    label: `Heading error over distance of ${bumped.length} runs with cables; per cable ${degUnit(data.summary.extended?.per_bump_heading_error_rad)}`,
    points: cables.map((c) => ({x: c.sample.distance, y: c.sample.heading, words: `cable ${c.number}, ${c.run.id}\n${fixed(c.height_m * 1000, 1)} mm high\n` +
        `${fixed(c.sample.distance, 2)} m driven\nheading error ${fixed(c.sample.heading, 3)}°`})),
    height: Math.max(260, width * 0.42), x: {label: "distance driven (m)"}, y: {label: "heading error (°)", nice: true},
    marks: [...plain.map((run) => curve(run, "var(--muted)", 0.8)), ...bumped.map((run) => curve(run, colour(run.direction), 1.4)),
      Plot.dot(cables, {x: (c) => c.sample.distance, y: (c) => c.sample.heading, symbol: "diamond", r: 4, fill: "var(--bump)", stroke: "var(--card)", className: "cable"})],
  };
}
