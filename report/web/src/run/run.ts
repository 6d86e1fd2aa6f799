// The page of a run, and of a recording.

import {degUnit, directionName, E_MAX, factor, fixed, isNumber, mm, mmUnit, NONE, plural} from "../lib/format";
import {html, type Html, join, raw} from "../lib/html";
import {build, type Section, type Tile} from "../lib/page";
import {replaySection} from "../replay/section";
import {choiceOf} from "./choice";
import {normal, type RunData} from "./data";
import {extendedSection} from "./extended";
import {calibrationTable, formsOf, recoveryTable} from "./forms";
import {growthSection} from "./growth";
import {pathsSection} from "./paths";
import {scatterSection} from "./scatter";
import {worst} from "./statistics";
import * as tables from "./tables";
import {workedSection} from "./worked";

function headline({summary: {umbmark = {}, recovery, one_way: oneWay}, runs, page}: RunData): Html {
  const counts = ["cw", "ccw"].map((d) => (umbmark[d] ?? {}).runs).filter(isNumber);
  if (isNumber(umbmark.e_max_syst_m)) {
    const driven = counts.length === 2 ? `Over ${counts[0]} clockwise and ${plural(counts[1], "counter-clockwise square")}` : "Over squares driven both ways";
    const before = html`${driven} the largest systematic return error, ${E_MAX}, is <b>${mmUnit(umbmark.e_max_syst_m)}</b>`;
    if (!recovery || !isNumber(recovery.e_max_after_m)) return html`${before}.`;
    const after = html`${before}. Calibrated and driven again, it is <b>${mmUnit(recovery.e_max_after_m)}</b>`;
    return isNumber(recovery.improvement) ? html`${after}: <b>${factor(recovery.improvement)} times</b> smaller.` : html`${after}.`;
  }
  if (oneWay) return html`Driven ${directionName(oneWay.direction)} only, the mean return error is <b>${mmUnit(oneWay.r_cg_m)}</b>.`;
  return page === "recording" ? html`A recording of ${plural(runs.length, "run")}.` : raw("");
}

function tiles(data: RunData): Tile[] {
  const {umbmark = {}, recovery = {}, injected = {}, extended = {}} = data.summary;
  const form = formsOf(data)[0];
  const measured = (v: unknown) => `${form.label}${isNumber(v) ? `; injected ${fixed(v, 5)}` : ""}`;
  const all: Tile[] = [
    {name: html`${E_MAX} before`, value: mm(umbmark.e_max_syst_m), unit: "\u00a0mm", more: worst(umbmark) ? `set by the ${worst(umbmark)} runs` : ""},
    {name: html`${E_MAX} after`, value: mm(recovery.e_max_after_m), unit: "\u00a0mm", more: "driven again"},
    {name: "Improvement", value: factor(recovery.improvement), unit: "\u00a0\u00d7", more: isNumber(recovery.passes) ? `in ${plural(recovery.passes, "pass").replace("passs", "passes")}` : ""},
    {name: html`E<sub>d</sub>, wheel diameters`, value: fixed(form.e_d, 5), more: measured(injected.e_d)},
    {name: html`E<sub>b</sub>, wheelbase`, value: fixed(form.e_b, 5), more: measured(injected.e_b)},
    {name: "Extended figure", value: degUnit(extended.mean_abs_heading_error_rad),
     more: isNumber(extended.per_bump_heading_error_rad) ? `${degUnit(extended.per_bump_heading_error_rad)} per cable` : ""}];
  return all.filter((t) => t.value !== NONE);
}

const plain = (id: string, title: string, content: Html): Section => ({id, title, content});

export function showRun(given: RunData): Promise<void> {
  const data = normal(given);
  const choice = choiceOf(data);
  return build({
    title: data.title, headline: headline(data), description: data.description, warnings: data.summary.warnings, tiles: tiles(data),
    footer: join([data.scenario && `scenario ${data.scenario}`, data.seed !== undefined && `seed ${data.seed}`, `umbsim ${data.version}`], raw(" · ")),
    sections: [
      scatterSection(data), pathsSection(data, choice), growthSection(data, choice), replaySection(data, choice),
      plain("one-way", "One-way test", tables.oneWay(data)), plain("two-way", "Two-way test (UMBmark)", tables.umbmark(data)), workedSection(data),
      plain("shares", "Systematic and non-systematic error", tables.shares(data)), plain("uncertainty", "Pose uncertainty", tables.uncertainty(data)),
      extendedSection(data), plain("calibration", "Calibration", html`${calibrationTable(data)}${recoveryTable(data)}`),
      plain("runs", "All runs", tables.returnErrors(data)), plain("cost", "Cost", tables.cost(data)),
      plain("provenance", "Provenance", tables.provenance(data)),
    ],
  });
}
