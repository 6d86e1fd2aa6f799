// The page of a trial's or the proving ground's score: what was named for what, from which size on, and whether stated
// probabilities come true; by engine where there are several.

import * as Plot from "@observablehq/plot";
import {group} from "d3";
import {Chart} from "../lib/chart";
import {capital, fixed, isNumber, NONE, percent, plural, short, words} from "../lib/format";
import {fill, find, html, type Html, raw} from "../lib/html";
import {build, legend, lineIcon, type Section} from "../lib/page";
import {table} from "../lib/table";
import type {Figures} from "../run/data";
import {together} from "../run/scatter";
import {provenance} from "../run/tables";
import {COLOURS, matrix, SYMBOLS, type Cell} from "./bars";

const per = (v: number): string => `${fixed(100 * v, 0)}\u00a0%`;

interface Case {
  name: string;
  kind: string;        // no_effect, single, pairs, outside ...
  truth: string;
  named: string;
  right: boolean;
  probability?: number;
  severity?: number;
  engine: string;
  link?: string;       // to the diagnosis
}

const UNKNOWN = ["outside", "excluded"];  // effects that the diagnosis cannot know
const KINDS: Record<string, string> = {no_effect: "no effect", none: "no effect", single: "one effect", pair: "two effects", pairs: "two effects", triple: "three effects",
  outside: "an effect outside the catalogue", excluded: "an effect left out of the catalogue", end_points: "end points only", poor_runs: "a poor set of runs"};
const kindName = (kind: string): string => KINDS[kind] ?? words(kind);

/// A trial lists its verdicts, the proving ground has them by name.
function casesOf(s: Figures, links: Record<string, string>): Case[] {
  const all: [string, Figures][] = Array.isArray(s.verdicts) ? s.verdicts.map((v: Figures) => [v.name, v]) : Object.entries(s.verdicts ?? {});
  return all.map(([name, v]) => {
    const kind = v.kind ?? v.tier;
    const truth = v.truth ?? (Object.keys(v.effects ?? {}).sort().join("+") || "none");
    return {...v, name, kind, link: links[name], engine: v.engine ?? "", named: words(v.named).replace(/\+/g, " + "),
            truth: words(truth).replace(/\+/g, " + ") + (UNKNOWN.includes(kind) ? " (not in catalogue)" : "")} as Case;
  });
}

const anchor = (c: {truth: string; named: string}): string => `cases ${c.truth} named ${c.named}`.replace(/[^a-z0-9]+/gi, "-");

const select = (name: string, label: string, values: [string, string][]): Html => (values.length < 2 ? raw("") : html`<label>${label} <select data-control="${name}">${
    values.map(([value, text]) => html`<option value="${value}">${text}</option>`)}</select></label>`);

function confusion(cases: Case[]): Section {
  const kinds = [...new Set(cases.map((c) => c.kind))];
  const plain = (c: Case) => ["no_effect", "none", "single"].includes(c.kind);
  const engines = [...new Set(cases.map((c) => c.engine))];
  const shown = {kind: kinds.some((k) => plain({kind: k} as Case)) ? "plain" : "all", engine: ""};
  const chosen = () => cases.filter((c) => (shown.kind === "all" || (shown.kind === "plain" ? plain(c) : c.kind === shown.kind)) && (!shown.engine || c.engine === shown.engine));
  const options: [string, string][] = [["plain", "one effect or none"], ...kinds.filter((k) => !plain({kind: k} as Case)).map((k): [string, string] => [k, kindName(k)]), ["all", "all"]];
  return {
    id: "confusion", title: "Figure 1. What was named for what", content: html`<figure><div class="controls">
      ${select("kind", "Cases with", options.filter(([k]) => k !== "plain" || shown.kind === "plain"))}${select("engine", "engine", [["", "all"], ...engines.filter(Boolean).map((e): [string, string] => [e, e])])}
      <output class="counted"></output></div><div id="confusion-matrix"></div><figcaption>A row for each truth, a column for each first cause; the number of cases, darker for a larger share of the row.
      Framed cells are right. Each cell leads to its cases.</figcaption></figure>`,
    setup: (section) => {
      const draw = () => {
        const own = chosen();
        const cells = [...group(own, (c) => c.truth)].flatMap(([truth, some]) => [...group(some, (c) => c.named)].map(([named, here]): Cell => ({
          row: truth, column: named, value: here.length / some.length, right: here.every((c) => c.right), text: String(here.length), link: `#${anchor(here[0])}`,
          words: `${truth}, named\n${named}\n${here.length} of ${plural(some.length, "case")}`})));
        const rows = [...new Set(cells.map((c) => c.row))].sort();
        const columns = [...new Set([...rows.filter((r) => cells.some((c) => c.column === r)), ...cells.map((c) => c.column).sort()])];
        find(section, ".counted").textContent = `first cause right in ${own.filter((c) => c.right).length} of ${own.length}`;
        fill(find(section, "#confusion-matrix"), html`<div></div>`);
        matrix(find(section, "#confusion-matrix > div"), "confusion", rows, columns, cells, ["truth", "named"]);
      };
      section.addEventListener("change", (event) => {
        const input = event.target as HTMLSelectElement;
        shown[input.dataset.control as "kind" | "engine"] = input.value;
        draw();
      });
      draw();
    },
  };
}

interface Bin {
  x: number;
  y: number;
  low: number;
  high: number;
  cases: number;
  series: string;
  words: string;
}

const bin = (series: string, x: number, cases: number, share: Figures, words: string): Bin =>
    ({series, x, cases, y: share.value, low: share.ci95[0], high: share.ci95[1], words: (series ? `${series}\n` : "") + words});

/// Of all cases, or of each engine's.
function binsOf(series: string, f: Figures): {detection: Bin[]; probability: Bin[]} {
  const size = (b: Figures) => (isNumber(b.to) ? `${short(b.from)} to ${short(b.to)}` : `${short(b.from)} and more`);
  return {
    detection: (f.by_severity ?? []).filter((b: Figures) => b.cases).map((b: Figures) => bin(series, isNumber(b.to) ? (b.from + b.to) / 2 : b.from * 1.25, b.cases, b.detected_share,
      `${size(b)} noise floors\ndetected ${per(b.detected_share.value)} of ${plural(b.cases, "case")}`)),
    probability: (f.calibration ?? []).filter((b: Figures) => b.cases).map((b: Figures) => bin(series, b.mean_probability, b.cases, b.right_share,
      `said ${per(b.mean_probability)}\nright ${per(b.right_share.value)} of ${plural(b.cases, "case")}`))};
}

function curve(place: HTMLElement, name: string, xLabel: string, yLabel: string, bins: Bin[], series: string[]): Chart {
  const stated = name === "probability";
  const at = (b: Bin) => series.indexOf(b.series);
  const ofSeries = (b: Bin) => COLOURS[at(b) % COLOURS.length];
  return new Chart(place, {
    name, draw: (width) => ({
      label: `${yLabel} over ${xLabel}: ${bins.map((b) => b.words.replace(/\n/g, ", ")).join("; ")}`, points: together(bins, 1), height: Math.max(260, width * 0.66), grid: "xy",
      x: {label: xLabel, inset: 8, ...(stated ? {domain: [0, 1], tickFormat: ".0%"} : {zero: true})}, y: {label: yLabel, domain: [0, 1], tickFormat: ".0%", inset: 8},
      plot: {color: {type: "identity"}, symbol: {domain: series, range: [...SYMBOLS].slice(0, series.length)}, r: {range: [3, 9], domain: [0, Math.max(...bins.map((b) => b.cases))]}},
      marks: [stated ? Plot.line([[0, 0], [1, 1]], {stroke: "var(--axis)", strokeDasharray: "5 4"}) : Plot.line(bins, {x: "x", y: "y", z: "series", stroke: ofSeries, strokeWidth: 1.6}),
        Plot.ruleX(bins, {x: "x", y1: "low", y2: "high", stroke: ofSeries, strokeWidth: 1.4, strokeOpacity: 0.7}),
        Plot.dot(bins, {x: "x", y: "y", r: "cases", symbol: "series", fill: ofSeries, stroke: "var(--card)", clip: false, className: "bin"})],
    })});
}

function curves(s: Figures): Section | null {
  const engines: [string, Figures][] = Object.entries(s.by?.engine ?? {});
  const all: [string, Figures][] = engines.length > 1 ? engines : [["", s.all ?? s]];
  const series = all.map(([name]) => name);
  const bins = all.map(([name, f]) => binsOf(name, f));
  const [detection, probability] = [bins.flatMap((b) => b.detection), bins.flatMap((b) => b.probability)];
  if (!detection.length && !probability.length) return null;
  const panel = (id: string, title: string, own: Bin[]) => own.length > 0 && html`<div class="panel"><p class="panel-title">${title}</p><div id="${id}"></div></div>`;
  return {
    id: "curves", title: "Figure 2. Detection and calibration", content: html`<figure><div class="panels">
      ${panel("detection", "Detected, over the size of the effect", detection)}${panel("probability", "Right, over the probability that was stated", probability)}</div>
      ${series.length > 1 ? legend(series.map((name, i) => [lineIcon(COLOURS[i % COLOURS.length], "", 6), name])) : ""}
      <figcaption>A larger mark stands for more cases; bars are 95 % intervals. Detected: of single effects. Right: of all cases, those whose effect cannot show included; on the dashed line a stated
        probability comes true as often as it says.</figcaption></figure>`,
    setup: (section) => {
      if (detection.length) curve(find(section, "#detection"), "detection", "size (noise floors)", "detected", detection, series);
      if (probability.length) curve(find(section, "#probability"), "probability", "stated probability", "right", probability, series);
    },
  };
}

const UNITS: Record<string, (v: number) => string> = {share: per, "%": per, "1": per, ratio: (v) => fixed(v, 3), effects: (v) => short(v), s: (v) => `${fixed(v, 1)}\u00a0s`};

function figures(s: Figures): Html {
  const list: Figures[] = Object.values(s.figures ?? {});
  const show = (f: Figures) => UNITS[f.unit] ?? short;
  return table({caption: "Figures with 95 % intervals", head: ["figure", "value", "95 %", "cases", "asked for"], text: [2, 4], stack: true, rows: list.filter((f) => f?.text).map((f) => [
    String(f.text).trim(), isNumber(f.value) ? show(f)(f.value) : NONE, f.ci95 ? `${show(f)(f.ci95[0])} to ${show(f)(f.ci95[1])}` : NONE, f.cases ?? NONE,
    f.bar ? html`${f.bar.replace(/<=/g, "\u2264").replace(/>=/g, "\u2265")}${["met", "missed"].includes(f.met) ? html`: <b class="${f.met === "met" ? "good" : "bad"}">${f.met}</b>` : ""}` : ""])});
}

function tallies(caption: string, by: Figures | undefined): Html {
  return table({caption, head: ["", "cases", "right", "right or tied", "in the set", "detected", "called unknown"], stack: true, rows: Object.entries<Figures>(by ?? {}).filter(([, t]) => isNumber(t?.cases)).map(([name, t]) => [
    capital(KINDS[name] ?? words(name)), t.cases, ...["right", "right_or_tied", "in_set", "detected", "called_unknown"].map((k) => (isNumber(t[k]) && t.cases ? `${t[k]} (${per(t[k] / t.cases)})` : NONE))])});
}

const WORLD_FIGURES: [string, string][] = [["false_alarm", "false alarm"], ["right", "first cause right"], ["plain", "plainly there"], ["both", "both of two"], ["in_set", "truth in the set"], ["not_there", "named, not there"],
  ["closed", "closure \u2265 0.7"], ["unknown_recall", "unknown found"], ["wall_s", "time (s)"]];

/// The proving ground's figures: a row for all and for each engine, driver, tracker ...
function worlds(s: Figures): Html {
  const cell = (f: Figures) => (!f?.cases ? NONE : isNumber(f.hits) ? html`${per(f.value)} <span class="muted">(${per(f.ci95[0])} to ${per(f.ci95[1])}, ${f.hits} of ${f.cases})</span>` : fixed(f.value, 1));
  const rows = (groups: Figures) => Object.entries<Figures>(groups).map(([name, f]) => [words(name), f.cases, ...WORLD_FIGURES.map(([key]) => cell(f[key]))]);
  const one = (caption: string, groups: Figures) => table({caption, head: ["", "cases", ...WORLD_FIGURES.map(([, head]) => head)], rows: rows(groups), stack: true, text: WORLD_FIGURES.map((_, i) => i + 2)});
  return html`${one("All cases", {all: s.all})}${Object.entries<Figures>(s.by ?? {}).map(([by, groups]) => one(`By ${by === "runs" ? "set of runs" : by}`, groups))}`;
}

/// A list for each cell of the matrix.
function caseLists(cases: Case[]): Html {
  const lists = [...group(cases, anchor)].sort((a, b) => (a[0] < b[0] ? -1 : 1));
  const several = new Set(cases.map((c) => c.engine)).size > 1;
  return html`${lists.map(([id, own]) => html`<details id="${id}"><summary>${own[0].truth}, named ${own[0].named}: ${plural(own.length, "case")}, ${
    own[0].right ? html`<b class="good">right</b>` : html`<b class="bad">wrong</b>`}</summary>${table({
    caption: `${own[0].truth}, named ${own[0].named}`, head: ["case", "kind", "size (noise floors)", "probability", ...(several ? ["engine"] : [])], text: [1, 4], stack: true, keepEmpty: true,
    rows: own.map((c) => [c.link ? html`<a href="${c.link}">${c.name}</a>` : c.name, kindName(c.kind), isNumber(c.severity) ? fixed(c.severity, 2) : NONE, isNumber(c.probability) ? percent(c.probability) : NONE,
      ...(several ? [c.engine] : [])])})}</details>`)}<p class="muted"><code>umbsim gap diagnose recordings/CASE</code>, in the folder of the cases, makes a case's own page.</p>`;
}

/// The two figures that say most: of single effects that show, and of cases without any.
function headline(s: Figures, cases: number): Html {
  const [right, alarm] = s.all ? [s.all.right, s.all.false_alarm] : [s.figures?.first_cause_right_all, s.figures?.false_alarm];
  const of = (f: Figures) => html`<b>${f.hits} of ${f.cases}</b>`;
  return html`${plural(cases, "case")}.${right?.cases ? html` Where one effect shows, the first cause is right in ${of(right)}.` : ""}${
    alarm?.cases ? html` Where there is none, one is named in ${of(alarm)}.` : ""}${s.not_diagnosed ? html` ${plural(s.not_diagnosed, "case")} not diagnosed yet.` : ""}`;
}

export function showScore(data: Figures): Promise<void> {
  const s = data.score;
  const cases = casesOf(s, data.links ?? {});
  const isWorlds = !!s.all;
  return build({
    title: data.title, description: data.description, footer: `umbsim ${data.version}`,
    headline: headline(s, cases.length),
    warnings: (s.sealed_before_diagnosis ?? s.sealed) === false ? ["The answers are not those that were sealed before the diagnoses."] : [],
    sections: [cases.length ? confusion(cases) : null, curves(s), {id: "figures", title: "Figures", content: isWorlds ? worlds(s) : figures(s)},
      {id: "by", title: "By kind of case", content: html`${tallies("By what is wrong", s.by_tier)}${tallies("By effect, of single ones", s.by_effect)}`},
      {id: "cases", title: "Cases", content: cases.length ? caseLists(cases) : raw(""), setup: (section) => {
        const show = () => {
          const at = document.getElementById(decodeURIComponent(location.hash.slice(1)));
          if (at instanceof HTMLDetailsElement && section.contains(at)) {
            at.open = true;
            at.scrollIntoView();
          }
        };
        show();
        window.addEventListener("hashchange", show);
      }},
      {id: "provenance", title: "Provenance", content: provenance(data)}],
  });
}
