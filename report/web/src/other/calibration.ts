// The page of a calibration: what each method says, whom to trust, how well it predicts what it has not seen.

import {deg, fixed, isNumber, millimetres, mm, NONE, words} from "../lib/format";
import {find, html, type Html, join, raw} from "../lib/html";
import {build, legend, markerIcon, type Section, type Tile} from "../lib/page";
import {bar, table} from "../lib/table";
import type {Figures} from "../run/data";
import {provenance, umbmark} from "../run/tables";
import {calibrationTable} from "../run/forms";
import {intervals} from "./bars";

const withInterval = (e: Figures | undefined, show: (v: number) => string): string =>
    (!e ? NONE : e.ci95 ? `${show(e.value)} (${show(e.ci95[0])} to ${show(e.ci95[1])})` : show(e.value));

function methodsTable(c: Figures, winner: string): Html {
  const answered = c.methods.filter((m: Figures) => !m.no_answer);
  const most = Math.max(1e-9, ...answered.map((m: Figures) => m.held_out_mm ?? 0));
  return table({
    caption: "Methods beside each other; errors of runs that a method has not seen", stack: true, text: [2, 3], keepEmpty: true,
    head: ["method", "", html`E<sub>d</sub> (95 %)`, html`E<sub>b</sub> (95 %)`, "mean radius (mm)", html`E<sub>max,syst</sub>`, "held out"],
    rows: answered.map((m: Figures) => [
      m.name === winner ? html`<b>${m.name}</b>` : m.name, isNumber(m.held_out_mm) ? bar(m.held_out_mm / most, m.name === winner ? "tied" : "rest") : "",
      withInterval(m.e_d, (v) => fixed(v, 5)), withInterval(m.e_b, (v) => fixed(v, 5)), m.mean_radius_m ? mm(m.mean_radius_m.value, 3) : NONE,
      isNumber(m.e_max_syst_m) ? millimetres(m.e_max_syst_m * 1000) : NONE, millimetres(m.held_out_mm)])});
}

const refused = (c: Figures): Html => table({
  caption: "Methods without an answer", head: ["method", "why"], text: [1],
  rows: c.methods.filter((m: Figures) => m.no_answer).map((m: Figures) => [m.name, m.no_answer])});

const about = (c: Figures): Html => table({
  caption: "What each method takes for exact, and what it cannot see", head: ["method", "takes for exact", "cannot see", "source"], text: [1, 2, 3], stack: true,
  rows: c.methods.filter((m: Figures) => m.source).map((m: Figures) => [m.name, m.takes_for_exact, m.cannot_see, m.source])});

function errors(c: Figures, kind: "train" | "test"): Html {
  const methods = c.methods.filter((m: Figures) => m[kind]);
  if (!methods.length) return raw("");
  const names = Object.keys(methods[0][kind]);
  return table({
    caption: kind === "train" ? "Mean final error on the recordings that were calibrated on (start and frame fitted)" : "Mean final error on the test recordings (start and frame fitted)",
    head: ["method", ...names], stack: true, rows: methods.map((m: Figures) => [m.name, ...names.map((n) => millimetres(m[kind][n]?.final_mm))])});
}

const parts = (p: Figures): Html => html`${table({
  caption: "What parts of the course say", head: ["recording", "part", "pieces", html`E<sub>d</sub> (95 %)`, html`E<sub>b</sub> (95 %)`], text: [1, 3, 4], stack: true,
  rows: (p?.fits ?? []).map((f: Figures) => [f.recording, words(f.part), f.pieces, withInterval(f.e_d, (v) => fixed(v, 5)), withInterval(f.e_b, (v) => fixed(v, 5))])})}
  ${table({caption: "Start headings", head: ["recording", "run", "off (°)", "usual (°)"], text: [1],
    rows: (p?.starts ?? []).map((s: Figures) => [s.recording, s.run, deg(s.off_rad), deg(s.usual_rad)])})}`;

function charts(c: Figures): Section {
  const error = (key: "e_d" | "e_b") => c.methods.filter((m: Figures) => m[key]).map((m: Figures) => ({
    name: m.name, value: m[key].value, low: m[key].ci95?.[0], high: m[key].ci95?.[1], best: m.name === c.winner.name,
    words: `${m.name}\n${key.replace("e", "E")} ${withInterval(m[key], (v) => fixed(v, 5))}`}));
  const held = c.methods.filter((m: Figures) => !m.no_answer && isNumber(m.held_out_mm)).map((m: Figures) => ({
    name: m.name, value: m.held_out_mm, best: m.name === c.winner.name, words: `${m.name}\nheld out: ${millimetres(m.held_out_mm)}`}));
  return {
    id: "figure-1", title: "Figure 1. What the methods say",
    content: html`<figure><div class="panels"><div class="panel"><p class="panel-title">E<sub>d</sub>, right over left wheel</p><div id="methods-e_d"></div></div>
      <div class="panel"><p class="panel-title">E<sub>b</sub>, wheelbase over nominal</p><div id="methods-e_b"></div></div></div>
      <p class="panel-title">Mean final error of runs that were left out</p><div id="methods-held-out"></div>
      ${legend([[markerIcon("cw", "after"), "a method's value; the line is its 95 % interval"]])}
      <figcaption>${c.held_out}. The large mark is the method that is trusted.</figcaption></figure>`,
    setup: (section) => {
      for (const key of ["e_d", "e_b"] as const) if (error(key).length) intervals(find(section, `#methods-${key}`), `methods-${key}`, key.replace("e", "E"), error(key), 1);
      if (held.length) intervals(find(section, "#methods-held-out"), "held-out", "held-out error (mm)", held);
    },
  };
}

export function showCalibration(data: Figures): Promise<void> {
  const j = data.calibration;
  const c = j.comparison;
  const o = j.odometry ?? {};
  const winner = c?.methods.find((m: Figures) => m.name === j.method) ?? {};
  const tiles: Tile[] = [
    {name: "Method", value: j.method, more: j.method === c?.winner.name ? "predicts best what it has not seen" : "as asked for"},
    {name: html`E<sub>d</sub>, wheel diameters`, value: fixed(winner.e_d?.value, 5), more: winner.e_d?.ci95 ? `95 %: ${fixed(winner.e_d.ci95[0], 5)} to ${fixed(winner.e_d.ci95[1], 5)}` : ""},
    {name: html`E<sub>b</sub>, wheelbase`, value: fixed(winner.e_b?.value, 5), more: winner.e_b?.ci95 ? `95 %: ${fixed(winner.e_b.ci95[0], 5)} to ${fixed(winner.e_b.ci95[1], 5)}` : ""},
    {name: "Held-out error", value: millimetres(winner.held_out_mm), more: "runs that it has not seen"}].filter((t) => t.value !== NONE);
  const squares = {...data, summary: {umbmark: j.umbmark, calibration: j.calibration}, runs: [], bumps: []} as never;
  return build({
    title: data.title, headline: c ? html`${c.winner.name} is the method to trust: ${c.winner.why}` : raw(""), description: data.description, tiles,
    warnings: [...(j.limits ?? []), ...(c?.warnings ?? []), ...(c?.parts?.warnings ?? [])], footer: `umbsim ${data.version}`,
    sections: [
      c && charts(c),
      c && {id: "methods", title: "Methods", content: html`${methodsTable(c, j.method)}${refused(c)}${about(c)}`},
      c && {id: "errors", title: "Errors by recording", content: html`${errors(c, "train")}${errors(c, "test")}`},
      c && {id: "parts", title: "Parts of the course", content: parts(c.parts)},
      {id: "squares", title: "Squares (UMBmark)", content: j.umbmark ? html`${umbmark(squares)}${calibrationTable(squares)}` : raw("")},
      {id: "odometry", title: "Calibrated odometry", content: html`${table({caption: "calibration.yaml", head: ["", "value"], rows: [
        ["left radius (mm)", mm(o.left_radius_m, 4)], ["right radius (mm)", mm(o.right_radius_m, 4)], ["wheelbase (mm)", mm(o.wheelbase_m, 3)]]})}`},
      {id: "provenance", title: "Provenance", content: join([provenance(data)], raw(""))},
    ],
  });
}
