// Both forms of E_d and E_b and what belongs to them.

import {html, type Html, raw} from "../lib/html";
import {isNumber, signedSmall, deg, fixed, factor, mm, NONE, E_MAX, type Num} from "../lib/format";
import {beside, table} from "../lib/table";
import {CAPTIONS} from "./captions";
import type {Figures, RunData} from "./data";

/// The applied one first; without one the exact one.
export function formsOf({summary: {umbmark = {}, calibration = {}}}: {summary: Figures}): Figures[] {
  const forms = ["heading", "endpoint"].map((name) => {
    const applied = calibration.applied === name;
    return {name, applied, label: `${name} form${applied ? ", applied" : ""}`, ...umbmark[name], ...calibration[name]};
  });
  return forms.sort((a, b) => Number(b.applied) - Number(a.applied));
}

/// Alpha and beta that belong to known E_d and E_b: the equations of the lecture solved for them.
function anglesOf({e_d: eD, e_b: eB}: Figures, {side_m: side, wheelbase_m: b}: RunData): Figures {
  const angles: Figures = {};
  if (isNumber(eB)) angles.alpha_rad = (Math.PI / 2) * (1 - 1 / eB);
  if (isNumber(eD) && isNumber(side) && isNumber(b)) angles.beta_rad = 2 * Math.asin(((side / b) * (eD - 1)) / (eD + 1));
  return angles;
}

function curvature(beta: Num, side: Num): string {
  if (!isNumber(beta) || !isNumber(side)) return NONE;
  const radius = side / 2 / Math.sin(beta / 2);
  return Math.abs(radius) < 1e6 ? fixed(radius, 1) : "straight";
}

export function calibrationTable(data: RunData): Html {
  const {umbmark = {}, injected = {}} = data.summary;
  const forms = formsOf(data);
  const columns: [string, Figures][] = [...forms.map((form): [string, Figures] => [form.label, form]),
    ["injected", {...anglesOf(injected, data), ...injected}] as [string, Figures]].filter(([, c]) => Object.values(c).some(isNumber)) as [string, Figures][];
  const row = (name: unknown, value: (c: Figures) => unknown) => [name, ...columns.map(([, c]) => value(c))];
  const b = data.wheelbase_m;
  const left = table({caption: "The two dominant systematic errors", head: ["Quantity", ...columns.map(([name]) => name)], rows: [
    row("\u03b1, type A, per turn (°)", (c) => deg(c.alpha_rad, 4)),
    row("\u03b2, type B, per leg (°)", (c) => deg(c.beta_rad, 4)),
    row("R, radius of curvature of a leg (m)", (c) => curvature(c.beta_rad, data.side_m)),
    row(html`E<sub>d</sub> = D<sub>R</sub> / D<sub>L</sub>`, (c) => fixed(c.e_d, 5)),
    row(html`E<sub>b</sub> = b<sub>actual</sub> / b<sub>nominal</sub>`, (c) => fixed(c.e_b, 5)),
    row(html`b<sub>actual</sub> (mm)`, (c) => (isNumber(b) && isNumber(c.e_b) ? mm(c.e_b * b, 2) : NONE)),
    row(html`c<sub>L</sub> = 2 / (E<sub>d</sub> + 1)`, (c) => (isNumber(c.e_d) ? fixed(2 / (c.e_d + 1), 5) : NONE)),
    row(html`c<sub>R</sub> = 2 / (1/E<sub>d</sub> + 1)`, (c) => (isNumber(c.e_d) ? fixed(2 / (1 / c.e_d + 1), 5) : NONE))]});
  const {type_a_share: a, type_b_share: share} = umbmark;
  const shares = isNumber(a) && isNumber(share) ?
      html`<p>Here type A makes ${fixed(a * 100, 0)}\u00a0% and type B ${fixed(share * 100, 0)}\u00a0% of the error.</p>` : raw("");
  const trust = forms.filter((f) => f.trust).map((f) => html`<p><b>${f.name} form</b>: ${f.trust}.</p>`);
  return beside(left, html`${shares}${trust}${CAPTIONS.types}`);
}

export function recoveryTable(data: RunData): Html {
  const r = data.summary.recovery;
  if (!r) return raw("");
  const left = table({caption: "What was recovered", head: ["Quantity", "Value"], rows: [
    [html`${E_MAX} before (mm)`, mm((data.summary.umbmark ?? {}).e_max_syst_m)], [html`${E_MAX} after (mm)`, mm(r.e_max_after_m)],
    ["improvement, factor", factor(r.improvement)], [html`E<sub>d</sub>, recovered \u2212 injected`, signedSmall(r.e_d_error)],
    [html`E<sub>b</sub>, recovered \u2212 injected`, signedSmall(r.e_b_error)],
    ["calibration passes", isNumber(r.passes) ? String(r.passes) : NONE]]});
  return left.text ? html`<h3>Driven again with the calibrated odometry</h3>${beside(left, CAPTIONS.recovery)}` : left;
}
