// The page of a trial's or the proving ground's score: what was named for what, from which size on, and whether stated
// probabilities come true.

import * as Plot from "@observablehq/plot";
import {group} from "d3";
import {Chart, grid, sized, tip} from "../lib/chart";
import {fixed, isNumber, NONE, plural, short, words} from "../lib/format";
import {find, html, type Html, raw} from "../lib/html";
import {build, type Section} from "../lib/page";
import {table} from "../lib/table";
import type {Figures} from "../run/data";
import {provenance} from "../run/tables";
import {matrix} from "./bars";

const per = (v: number): string => `${fixed(100 * v, 0)}\u00a0%`;
const truthOf = (v: Figures): string => (typeof v.truth === "string" ? v.truth : Object.keys(v.effects ?? {}).sort().join("+") || "none");
const slug = (text: string): string => text.replace(/[^a-z0-9]+/gi, "-");

function confusion(verdicts: Figures[]): Section | null {
  if (!verdicts.length) return null;
  const cells = [...group(verdicts, truthOf)].flatMap(([truth, own]) => [...group(own, (v) => v.named)].map(([named, some]) => ({
    row: words(truth), column: words(named), value: some.length / own.length, text: String(some.length), link: `#cases-${slug(truth)}`,
    words: `${words(truth)} named\n${words(named)}\n${some.length} of ${plural(own.length, "case")}`})));
  const rows = [...new Set(cells.map((c) => c.row))].sort();
  const columns = [...new Set([...rows.filter((r) => cells.some((c) => c.column === r)), ...cells.map((c) => c.column).sort()])];
  return {id: "confusion", title: "Figure 1. What was named for what", content: html`<figure><div id="confusion-matrix"></div><figcaption>A row for each truth, a column for each first cause; the number of cases,
    darker for a larger share of the row. Framed cells are right. Each cell leads to its cases.</figcaption></figure>`,
    setup: (section) => matrix(find(section, "#confusion-matrix"), "confusion", rows, columns, cells, ["truth", "named"])};
}

interface Bin {
  x: number;
  value: number;
  low: number;
  high: number;
  words: string;
}

function curve(place: HTMLElement, name: string, xLabel: string, yLabel: string, bins: Bin[], diagonal: boolean): void {
  new Chart(place, {
    name, draw: (width, view) => ({
      label: `${yLabel} over ${xLabel}: ${bins.map((b) => b.words.replace(/\n/g, ", ")).join("; ")}`, stops: bins.map((b) => [b.x, b.value]),
      plot: {...sized(width, Math.max(260, width * 0.66)), x: {label: xLabel, labelAnchor: "center", ...(diagonal ? {domain: [0, 1], percent: false} : {}), ...(view.x && {domain: view.x})},
             y: {label: yLabel, domain: view.y ?? [0, 1], tickFormat: ".0%"},
             marks: [...grid(), diagonal ? Plot.line([[0, 0], [1, 1]], {stroke: "var(--axis)", strokeDasharray: "5 4"}) : null,
               Plot.ruleX(bins, {x: "x", y1: "low", y2: "high", stroke: "var(--cw)", strokeWidth: 1.6}), Plot.line(bins, {x: "x", y: "value", stroke: "var(--cw)", strokeWidth: 2}),
               Plot.dot(bins, {x: "x", y: "value", r: 4.5, fill: "var(--cw)", stroke: "var(--card)", title: "words", tip, className: "bin"})]},
    })});
}

function curves(s: Figures): Section | null {
  const detection: Bin[] = (s.by_severity ?? []).filter((b: Figures) => b.detected_share && b.cases).map((b: Figures) => ({
    x: isNumber(b.to) ? (b.from + b.to) / 2 : b.from * 1.25, value: b.detected_share.value, low: b.detected_share.ci95[0], high: b.detected_share.ci95[1],
    words: `${short(b.from)} to ${isNumber(b.to) ? short(b.to) : "\u221e"} noise floors\ndetected ${per(b.detected_share.value)} of ${plural(b.cases, "case")}`}));
  const calibration: Bin[] = (s.calibration ?? []).filter((b: Figures) => b.cases).map((b: Figures) => ({
    x: b.mean_probability, value: b.right_share.value, low: b.right_share.ci95[0], high: b.right_share.ci95[1],
    words: `said ${per(b.mean_probability)}\nright ${per(b.right_share.value)} of ${plural(b.cases, "case")}`}));
  if (!detection.length && !calibration.length) return null;
  return {
    id: "curves", title: "Figure 2. Detection and calibration", content: html`<figure><div class="panels">${detection.length && html`<div class="panel"><p class="panel-title">Detected, over the size of the effect</p><div id="detection"></div></div>`}
      ${calibration.length && html`<div class="panel"><p class="panel-title">Right, over the probability that was stated</p><div id="probability"></div></div>`}</div>
      <figcaption>Bars are 95 % intervals. On the dashed line a stated probability comes true as often as it says.</figcaption></figure>`,
    setup: (section) => {
      if (detection.length) curve(find(section, "#detection"), "detection", "size (noise floors)", "detected", detection, false);
      if (calibration.length) curve(find(section, "#probability"), "calibration", "stated probability", "right", calibration, true);
    },
  };
}

function figures(s: Figures): Html {
  const list: Figures[] = Array.isArray(s.figures) ? s.figures : Object.values(s.figures ?? {});
  const shown = (f: Figures, v: number) => (f.unit === "%" || f.unit === "share" || f.unit === "1" ? per(v) : `${short(v)}${f.unit ? `\u00a0${f.unit}` : ""}`);
  return table({caption: "Figures with 95 % intervals", head: ["figure", "value", "95 %", "cases"], text: [2], stack: true, rows: list.filter((f) => f && f.text).map((f) => [
    f.text, isNumber(f.value) ? shown(f, f.value) : NONE, f.ci95 ? `${shown(f, f.ci95[0])} to ${shown(f, f.ci95[1])}` : NONE, f.cases ?? NONE])});
}

function tallies(caption: string, by: Figures | undefined): Html {
  const rows: [string, Figures][] = Array.isArray(by) ? by.map((t: Figures) => [t.name ?? t.effect ?? t.tier ?? "", t]) : Object.entries(by ?? {});
  return table({caption, head: ["", "cases", "right", "right or tied", "in the set", "detected", "called unknown"], stack: true, rows: rows.filter(([, t]) => isNumber(t?.cases)).map(([name, t]) => [
    words(name), t.cases, ...["right", "right_or_tied", "in_set", "detected", "called_unknown"].map((k) => (isNumber(t[k]) && t.cases ? `${t[k]} (${per(t[k] / t.cases)})` : NONE))])});
}

function cases(verdicts: Figures[]): Html {
  return html`${[...group(verdicts, truthOf)].sort((a, b) => (a[0] < b[0] ? -1 : 1)).map(([truth, own]) => html`<details id="cases-${slug(truth)}"><summary>${words(truth)}: ${
    plural(own.filter((v) => v.right).length, "case")} right of ${own.length}</summary>${table({caption: `Cases with ${words(truth)}`, head: ["case", "size (noise floors)", "named", "probability", "", "engine"], text: [2, 4, 5], stack: true,
      keepEmpty: true, rows: own.map((v) => [v.page ? html`<a href="${v.page}">${v.name}</a>` : v.name, isNumber(v.severity) ? fixed(v.severity, 2) : NONE, words(v.named), isNumber(v.probability) ? per(v.probability) : NONE,
        v.right ? html`<b class="good">right</b>` : html`<b class="bad">wrong</b>`, v.engine ?? ""])})}</details>`)}`;
}

export function showScore(data: Figures): Promise<void> {
  const s = data.score;
  const verdicts: Figures[] = s.verdicts ?? [];
  const engines = [...new Set(verdicts.map((v) => v.engine).filter(Boolean))] as string[];
  const byEngine: Figures | undefined = engines.length ? Object.fromEntries(engines.map((e) => {
    const own = verdicts.filter((v) => v.engine === e);
    const n = (key: string) => own.filter((v) => v[key]).length;
    return [e, {cases: own.length, right: n("right"), right_or_tied: n("right_or_tied"), in_set: n("in_set")}];
  })) : s.by_engine;
  return build({
    title: data.title, description: data.description, footer: `umbsim ${data.version}`,
    headline: html`${plural(verdicts.length || s.cases || 0, "case")}${verdicts.length ? html`, the first cause right in <b>${verdicts.filter((v) => v.right).length}</b>` : ""}.`,
    warnings: s.sealed_before_diagnosis === false ? ["The answers are not those that were sealed before the diagnoses."] : [],
    sections: [confusion(verdicts), curves(s), {id: "figures", title: "Figures", content: figures(s)},
      {id: "by", title: "By kind of case", content: html`${tallies("By tier", s.by_tier)}${tallies("By engine", byEngine)}${tallies("By effect", s.by_effect)}`},
      {id: "cases", title: "Cases", content: verdicts.length ? cases(verdicts) : raw(""), setup: (section) => {
        const show = () => {
          const at = document.getElementById(decodeURIComponent(location.hash.slice(1)));
          if (at instanceof HTMLDetailsElement && section.contains(at)) at.open = true;
        };
        show();
        window.addEventListener("hashchange", show);
      }},
      {id: "provenance", title: "Provenance", content: provenance(data)}],
  });
}
