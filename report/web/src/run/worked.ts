// The calculation from end points to E_d and E_b, line by line in the lecture's notation, with this run's numbers.

import {html, type Html, raw} from "../lib/html";
import {DEG, fixed, isNumber, E_MAX} from "../lib/format";
import type {Section} from "../lib/page";
import type {RunData} from "./data";

interface Step {
  name: unknown;       // left of the first "="
  formula: unknown;
  numbers: unknown;
  result: string;
  why?: unknown;
  key?: string;        // of the summary's figure, for the tests
}

const step = ({name, formula, numbers, result, why, key}: Step): Html => html`<li><div class="equation"><span>${name}</span>
  <span>= ${formula}</span><span>= ${numbers}</span><span>= <b ${key ? html`data-result="${key}"` : ""}>${result}</b></span></div>${
    why && html`<p class="muted">${why}</p>`}</li>`;

const mm1 = (v: number): string => fixed(v * 1000, 2);
const bracket = (text: string): string => (text.startsWith("\u2212") ? `(${text})` : text);
const radDeg = (v: number): string => `${fixed(v, 6)} rad = ${fixed(v * DEG, 4)}°`;

/// Right over left diameter: both wheels roll on circles about one centre, `base` apart.
function diameters(form: string, radius: number, base: number, baseName: unknown): Step {
  const bent = Number.isFinite(radius);
  return {
    name: html`E<sub>d</sub>`, formula: html`(R + ${baseName}/2) / (R \u2212 ${baseName}/2)`,
    numbers: bent ? html`(${fixed(radius, 3)} + ${fixed(base / 2, 4)}) / (${fixed(radius, 3)} \u2212 ${fixed(base / 2, 4)})` : "1",
    result: fixed(bent ? (radius + base / 2) / (radius - base / 2) : 1, 5), key: `${form}.e_d`,
    why: "Right over left wheel diameter: both wheels roll on circles about one centre."};
}

function wheelbase(form: string, alpha: number, b: number): Step[] {
  const eB = 90 / (90 - alpha * DEG);
  return [
    {name: html`E<sub>b</sub>`, formula: html`90° / (90° \u2212 \u03b1)`, numbers: html`90° / (90° \u2212 ${bracket(fixed(alpha * DEG, 4))}°)`,
     result: fixed(eB, 5), key: `${form}.e_b`, why: "Actual over nominal wheelbase: what was told 90° turned by 90° less α."},
    {name: html`b<sub>actual</sub>`, formula: html`E<sub>b</sub> b<sub>nominal</sub>`, numbers: html`${fixed(eB, 5)} \u00b7 ${mm1(b)} mm`,
     result: `${mm1(eB * b)} mm`}];
}

function corrections(radius: number, base: number): Step[] {
  const eD = Number.isFinite(radius) ? (radius + base / 2) / (radius - base / 2) : 1;
  return [
    {name: html`c<sub>L</sub>`, formula: html`2 / (E<sub>d</sub> + 1)`, numbers: html`2 / (${fixed(eD, 5)} + 1)`, result: fixed(2 / (eD + 1), 5),
     why: html`The left wheel's distances are multiplied by it, those of the right one by c<sub>R</sub>; the mean diameter stays as it was.`},
    {name: html`c<sub>R</sub>`, formula: html`2 / (1/E<sub>d</sub> + 1)`, numbers: html`2 / (1/${fixed(eD, 5)} + 1)`, result: fixed(2 / (1 / eD + 1), 5)}];
}

const curved = (radius: number): string => (Number.isFinite(radius) ? `${fixed(radius, 2)} m` : "\u221e, straight");

/// A leg as a chord of its arc, the nominal wheelbase: Borenstein and Feng.
function byEnds(alpha: number, beta: number, side: number, b: number): Step[] {
  const radius = side / 2 / Math.sin(beta / 2);
  return [
    {name: "R", formula: html`(L/2) / sin(\u03b2/2)`, numbers: html`${fixed(side / 2, 3)} m / sin(${fixed(beta * DEG / 2, 4)}°)`, result: curved(radius),
     why: "A leg is an arc when the wheels differ; this is its radius."},
    diameters("endpoint", radius, b, "b"), ...wheelbase("endpoint", alpha, b), ...corrections(radius, b)];
}

/// A leg as the arc itself, and the actual wheelbase: exact for errors of any size.
function byHeadings(alpha: number, beta: number, side: number, b: number): Step[] {
  const radius = side / beta;
  const actual = b * 90 / (90 - alpha * DEG);
  return [
    ...wheelbase("heading", alpha, b),
    {name: "R", formula: html`L / \u03b2`, numbers: html`${fixed(side, 3)} m / ${bracket(fixed(beta, 6))}`, result: curved(radius), why: "The arc of a leg is as long as the side."},
    diameters("heading", radius, actual, html`b<sub>actual</sub>`), ...corrections(radius, actual)];
}

function centres(u: RunData["summary"]): Step[] {
  const radius = (d: "cw" | "ccw"): Step => ({
    name: html`r<sub>cg,${d}</sub>`, formula: html`\u221a(x<sub>cg</sub>\u00b2 + y<sub>cg</sub>\u00b2)`,
    numbers: html`\u221a(${bracket(mm1(u[d].centroid_x_m))}\u00b2 + ${bracket(mm1(u[d].centroid_y_m))}\u00b2) mm`, result: `${mm1(u[d].r_cg_m)} mm`, key: `${d}.r_cg_m`,
    why: `Mean of ${u[d].runs} return errors: x ${mm1(u[d].centroid_x_m)} mm, y ${mm1(u[d].centroid_y_m)} mm.`});
  return [radius("cw"), radius("ccw"), {
    name: E_MAX, formula: html`max(r<sub>cg,cw</sub>, r<sub>cg,ccw</sub>)`, numbers: html`max(${mm1(u.cw.r_cg_m)}, ${mm1(u.ccw.r_cg_m)}) mm`,
    result: `${mm1(u.e_max_syst_m)} mm`, key: "e_max_syst_m"}];
}

const list = (title: unknown, note: unknown, steps: Step[]): Html => html`<h3>${title}</h3><p class="muted">${note}</p><ol class="worked">${steps.map(step)}</ol>`;

export function workedSection(data: RunData): Section | null {
  const u = data.summary.umbmark;
  const [side, b] = [data.side_m, data.wheelbase_m];
  if (!u?.cw || !u.ccw || !isNumber(side) || !isNumber(b) || side <= 0) return null;
  const [xCw, xCcw] = [u.cw.centroid_x_m, u.ccw.centroid_x_m];
  const laps = u.cw.laps ?? 1;
  if (laps !== (u.ccw.laps ?? 1)) return null;
  const [times, ofLaps] = laps === 1 ? ["", ""] : [`${fixed(laps, 0)} \u00b7 `, " n"];
  const fromEnds = (sign: 1 | -1) => (xCw + sign * xCcw) / (-4 * laps * side);
  const ends = (sign: string, value: number, name: string): Step => ({
    name, formula: html`(x<sub>cg,cw</sub> ${sign} x<sub>cg,ccw</sub>) / (\u22124${ofLaps} L)`,
    numbers: html`(${mm1(xCw)} ${sign} ${bracket(mm1(xCcw))}) mm / (\u22124 \u00b7 ${times}${fixed(side * 1000, 0)} mm)`, result: radDeg(value),
    key: `endpoint.${name === "\u03b1" ? "alpha" : "beta"}_rad`});
  const turned = (sign: string, value: number, name: string): Step => ({
    name, formula: html`(\u03b8<sub>cw</sub> ${sign} \u03b8<sub>ccw</sub>) / ${laps === 1 ? "8" : "(8 n)"}`,
    numbers: html`(${fixed(u.cw.heading_rad * DEG, 4)}° ${sign} ${bracket(fixed(u.ccw.heading_rad * DEG, 4))}°) / ${laps === 1 ? "8" : `(8 \u00b7 ${fixed(laps, 0)})`}`, result: radDeg(value),
    key: `heading.${name === "\u03b1" ? "alpha" : "beta"}_rad`});
  const headings = isNumber(u.cw.heading_rad) && isNumber(u.ccw.heading_rad);
  const [alpha, beta] = [fromEnds(1), fromEnds(-1)];
  const [alphaH, betaH] = [(u.cw.heading_rad - u.ccw.heading_rad) / (8 * laps), (u.cw.heading_rad + u.ccw.heading_rad) / (8 * laps)];
  return {
    id: "worked", title: "The calculation, line by line", content: html`
      <p>From the end points to the two errors and the corrections, with the numbers of this result. L = ${fixed(side, 3)} m is the side of the square,
        b = ${mm1(b)} mm the nominal wheelbase${laps === 1 ? "" : `, n = ${fixed(laps, 0)} the squares of a run`}; lengths are rounded for display only.</p>
      ${list("How far off", "The centres of the two clusters of figure 1, and the worse of them.", centres(u))}
      ${list("Endpoint form (Borenstein & Feng)", "α changes the total turn alike in both directions (type A), β bends the legs (type B). Small angles are taken for granted.", [
        ends("+", alpha, "\u03b1"), ends("\u2212", beta, "\u03b2"), ...byEnds(alpha, beta, side, b)])}
      ${headings ? list("Heading form", "The same from the return headings: four turns and four legs a square, exact at any angle.", [
        turned("\u2212", alphaH, "\u03b1"), turned("+", betaH, "\u03b2"), ...byHeadings(alphaH, betaH, side, b)]) : raw("")}`,
  };
}
