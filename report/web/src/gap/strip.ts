// Legs and turns as a strip, a row for each run, coloured by how much the scenario errs there.

import * as Plot from "@observablehq/plot";
import {Chart} from "../lib/chart";
import {fixed, plural} from "../lib/format";
import {fill, find, html} from "../lib/html";
import type {Figures} from "../run/data";
import type {GapData} from "./data";

const PARTS = ["start", "cruise", "stop", "turn"];

export function setupStrip(data: GapData, place: HTMLElement): void {
  const segments: Figures[] = (data.diagnosis.where?.segments ?? []).filter((s: Figures) => s.score > 0);
  if (!segments.length) return;
  const key = (s: Figures) => `${s.leg} ${s.part}`;
  const order = (s: Figures) => s.leg * 10 + PARTS.indexOf(s.part);
  const columns = [...new Map(segments.map((s) => [key(s), order(s)]))].sort((a, b) => a[1] - b[1]).map(([k]) => k);
  const rows = data.runs.map((r) => r.id);
  fill(place, html`<h3>Legs and turns</h3><figure><div id="gap-strip"></div><div id="gap-strip-scale"></div>
    <figcaption>A row for each run, a column for each part of the course (leg and part of it): the darker, the more the recorded run
      departs there from the scenario, beyond the noise.</figcaption></figure>`);
  const scale: Plot.ScaleOptions = {type: "sqrt", domain: [0, Math.max(...segments.map((s) => s.score))], scheme: "oranges", label: "score"};
  new Chart(find(place, "#gap-strip"), {
    name: "legs-and-turns", zoom: "none", most: 1060, draw: (width) => {
      const slanted = columns.length * 52 > width;
      return {
        label: `Score of ${plural(columns.length, "part")} of the course in ${plural(rows.length, "run")}`, grid: "none",
        points: segments.map((s) => ({x: key(s), y: s.run, words: `${s.run}, leg ${s.leg}, ${s.part}\nscore ${fixed(s.score, 1)}`})),
        height: 34 + 22 * rows.length + (slanted ? 28 : 0), x: {domain: columns, label: null, tickRotate: slanted ? -60 : 0}, y: {domain: rows, label: null},
        plot: {marginLeft: Math.min(140, 20 + 7 * Math.max(...rows.map((r) => r.length))), marginBottom: slanted ? 54 : 26, marginTop: 8, color: scale},
        marks: [Plot.cell(segments, {x: key, y: "run", fill: "score", inset: 0.5, className: "segment"}), Plot.frame({stroke: "var(--line)"})]};
    }});
  find(place, "#gap-strip-scale").append(Plot.legend({color: scale, width: 260, style: {color: "var(--muted)"}} as Plot.LegendOptions));
}
