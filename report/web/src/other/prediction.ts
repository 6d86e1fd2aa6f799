// The page of a prediction: how far from the truth each contestant ends, run by run.

import {fixed, millimetres, words} from "../lib/format";
import {find, html} from "../lib/html";
import {build, legend, lineIcon} from "../lib/page";
import {table} from "../lib/table";
import type {Figures} from "../run/data";
import {provenance} from "../run/tables";
import {COLOURS, intervals} from "./bars";

const NAMES: Record<string, string> = {before: "simulator, no effects", after: "simulator with the effects", odometry: "odometry, nominal", umbmark: "odometry, UMBmark", heading: "odometry, heading form"};

export function showPrediction(data: Figures): Promise<void> {
  const all: [string, Figures][] = Object.entries(data.prediction.predictions);
  const name = (n: string) => NAMES[n] ?? words(n);
  const runs = Object.keys(all[0][1].runs);
  const points = all.flatMap(([n, p]) => [...runs.map((r) => [r, p.runs[r]]), ["mean", p.mean]].map(([r, e]) => ({
    name: r, group: name(n), value: e.final_mm, best: r === "mean", words: `${r}, ${name(n)}\nends ${millimetres(e.final_mm)} off\nalong the way ${millimetres(e.along_mm)} (r.m.s.)`})));
  const rows = (key: string) => [...runs, "mean"].map((r) => [r === "mean" ? html`<b>mean</b>` : r, ...all.map(([, p]) => fixed((r === "mean" ? p.mean : p.runs[r])[key], 1))]);
  const tableOf = (caption: string, key: string) => table({caption, head: ["run", ...all.map(([n]) => name(n))], rows: rows(key), stack: true});
  return build({
    title: data.title, description: data.description, footer: `umbsim ${data.version}`,
    tiles: all.map(([n, p]) => ({name: name(n), value: millimetres(p.mean.final_mm), more: "mean final error"})),
    sections: [
      {id: "figure-1", title: "Figure 1. Final position error of each run", content: html`<figure><div id="prediction"></div>${legend(all.map(([n], i) => [lineIcon(COLOURS[i], "", 6), name(n)]))}
        <figcaption>Start pose and frame are fitted to each run, alike for every contestant.</figcaption></figure>`,
       setup: (section) => intervals(find(section, "#prediction"), "prediction", "final error (mm)", points)},
      {id: "errors", title: "Errors", content: html`${tableOf("Final position error (mm), start and frame fitted", "final_mm")}${tableOf("Final position error (mm), recorded start as exact", "raw_final_mm")}
        ${tableOf("Along the way (mm, r.m.s.), start and frame fitted", "along_mm")}`},
      {id: "provenance", title: "Provenance", content: provenance(data)},
    ],
  });
}
