// Tables of a run, in the lecture's order. Each is empty where the data lack its part.

import {html, type Html, raw} from "../lib/html";
import {deg, E_MAX, factor, fixed, isNumber, mm, mmDecimals, NONE, percent, stageName, thousands} from "../lib/format";
import {markerIcon} from "../lib/page";
import {beside, table} from "../lib/table";
import {CAPTIONS} from "./captions";
import {hasError, type Figures, type RunData} from "./data";
import {clustersOf, eMaxOf, worst} from "./statistics";

export function oneWay(data: RunData): Html {
  const one = data.summary.one_way;
  if (!one) return raw("");
  const columns = [["cw alone", one.cw], ["ccw alone", one.ccw]].filter(([, c]) => c);
  const both = (cell: unknown) => (columns.length > 1 ? [cell] : []);
  const row = (name: unknown, value: (c: Figures) => string, twoWay: unknown) => [name, ...columns.map(([, c]) => value(c)), ...both(twoWay)];
  const left = table({
    caption: "What each direction alone would report, against both", head: ["Quantity", ...columns.map(([name]) => name), ...both("two-way")],
    rows: [row(html`r<sub>cg</sub>, two-way ${E_MAX} (mm)`, (c) => mm(c.r_cg_m), mm((data.summary.umbmark ?? {}).e_max_syst_m)),
           row("mean heading error (°)", (c) => deg(c.e_theta_rad), NONE), row("rms of the return error (mm)", (c) => mm(c.rms_m), NONE)]});
  return html`<p class="notice"><b>Read with care.</b> ${one.warning ?? CAPTIONS.oneWayWarning}</p>${beside(left, CAPTIONS.oneWay)}`;
}

export function umbmark(data: RunData): Html {
  const before = data.summary.umbmark ?? {};
  const after: Figures = clustersOf(data, "after");
  const suffix = after.cw || after.ccw ? " before" : "";
  const columns: [string, Figures][] = ([[`cw${suffix}`, before.cw], [`ccw${suffix}`, before.ccw], ["cw after", after.cw], ["ccw after", after.ccw]] as
      [string, Figures][]).filter(([, c]) => c && isNumber(c.centroid_x_m));
  if (!columns.length) return raw("");
  const lengths = ["centroid_x_m", "centroid_y_m", "r_cg_m", "sd_x_m", "sd_y_m", "sd_m", "standard_error_m"];
  const decimals = (c: Figures) => mmDecimals(lengths.map((l) => c[l]));
  const length = (key: string) => columns.map(([, c]) => mm(c[key], decimals(c)));
  const angle = (key: string) => columns.map(([, c]) => deg(c[key]));
  const spread = (cells: string[]) => cells.map((cell, i) => (columns[i][1].runs === 1 ? NONE : cell));  // one run has none
  const eMax = columns.map(([name, c]) => {
    const value = name === `${worst(before)}${suffix}` ? before.e_max_syst_m : name === `${worst(after)} after` ? eMaxOf(after) : undefined;
    return isNumber(value) ? html`<b>${mm(value, decimals(c))}</b>` : NONE;
  });
  const left = table({caption: "Centres of gravity and spread of the end points", head: ["Quantity", ...columns.map(([name]) => name)], rows: [
    ["runs", ...columns.map(([, c]) => (isNumber(c.runs) ? String(c.runs) : NONE))],
    [html`x<sub>cg</sub> (mm)`, ...length("centroid_x_m")], [html`y<sub>cg</sub> (mm)`, ...length("centroid_y_m")],
    [html`r<sub>cg</sub> (mm)`, ...length("r_cg_m")], [html`${E_MAX}, the larger (mm)`, ...eMax],
    ["sd x (mm)", ...spread(length("sd_x_m"))], ["sd y (mm)", ...spread(length("sd_y_m"))], ["sd along one axis (mm)", ...spread(length("sd_m"))],
    ["standard error of the centre (mm)", ...spread(length("standard_error_m"))], ["mean heading error (°)", ...angle("heading_rad")],
    ["sd heading (°)", ...spread(angle("sd_heading_rad"))]]});
  return beside(left, CAPTIONS.twoWay);
}

export function returnErrors(data: RunData): Html {
  const runs = data.runs.filter(hasError);
  const decimals = (stage: string) => mmDecimals(runs.filter((r) => r.stage === stage).flatMap((r) => [r.error!.x_m, r.error!.y_m]));
  return table({
    caption: "Return error of every run: absolute \u2212 calculated", text: [1],
    head: ["Run", "Stage", html`e<sub>x</sub> (mm)`, html`e<sub>y</sub> (mm)`, "distance (mm)", html`e<sub>\u03b8</sub> (°)`],
    rows: runs.map((r) => {
      const d = decimals(r.stage);
      const {x_m, y_m, theta_rad} = r.error!;
      return [html`${markerIcon(r.direction, r.stage)}${r.id}`, stageName(r.stage), mm(x_m, d), mm(y_m, d), mm(Math.hypot(x_m, y_m), d), deg(theta_rad, 3)];
    })});
}

export function shares(data: RunData): Html {
  const s = data.summary.shares;
  if (!s) return raw("");
  const columns: [string, Figures][] = ([["cw", s.cw], ["ccw", s.ccw]] as [string, Figures][]).filter(([, c]) => c);
  if (columns.length === 2) columns.push(["both", s]);
  const decimals = mmDecimals(columns.map(([, c]) => c.rms_m));
  const row = (name: unknown, value: (c: Figures) => string) => [name, ...columns.map(([, c]) => value(c))];
  return beside(table({caption: "Shares of the mean square return error, before calibration", head: ["Quantity", ...columns.map(([name]) => name)], rows: [
    row("rms of the return error (mm)", (c) => mm(c.rms_m, decimals)),
    row(html`systematic: r<sub>cg</sub> (mm)`, (c) => mm(c.systematic_m, decimals)),
    row("non-systematic: rms distance from the centre (mm)", (c) => mm(c.non_systematic_m, decimals)),
    row("systematic share", (c) => percent(c.systematic)), row("non-systematic share", (c) => percent(c.non_systematic))]}), CAPTIONS.shares);
}

export function uncertainty(data: RunData): Html {
  const u = data.summary.uncertainty;
  if (!u) return raw("");
  const suffix = u.after ? " before" : "";
  const after = u.after ?? {};
  const columns: [string, Figures][] = ([[`cw${suffix}`, u.cw], [`ccw${suffix}`, u.ccw], ["cw after", after.cw], ["ccw after", after.ccw]] as
      [string, Figures][]).filter(([, f]) => f);
  const row = (name: string, value: (f: Figures) => string) => [name, ...columns.map(([, f]) => value(f))];
  const axis = (i: number) => (f: Figures) => mm((f.ellipse_95_semi_axes_m ?? [])[i]);
  return beside(table({caption: "The ellipse at the end of the run", head: ["Quantity", ...columns.map(([name]) => name)], rows: [
    row("longer semi-axis of the 95\u00a0% ellipse (mm)", axis(0)), row("shorter semi-axis (mm)", axis(1)),
    row("standard deviation of the heading (°)", (f) => deg(f.heading_sd_rad)), row("runs", (f) => String(f.runs)),
    row("true end inside the ellipse", (f) => percent(f.inside_95_share)),
    row("true position inside, on the way", (f) => percent(f.inside_95_share_on_the_way))]}), CAPTIONS.uncertainty);
}

export function cost(data: RunData): Html {
  const c = data.summary.cost;
  if (!c) return raw("");
  return table({caption: "What the run took", head: ["Quantity", "Value"], rows: [
    ["simulated time (s)", fixed(c.simulated_s, 1)], ["computing time (s)", fixed(c.wall_s, 2)],
    ["times faster than real time", isNumber(c.simulated_s) && c.wall_s > 0 ? factor(c.simulated_s / c.wall_s) : NONE],
    ["physics steps", thousands(c.steps)], ["solver fallbacks", thousands(c.solver_fallbacks)]]});
}

/// Where the result comes from: provenance.json as it is.
export function provenance(data: {provenance?: Figures; seed?: number}): Html {
  const rows = Object.entries(data.provenance ?? {}).filter(([key, v]) => key !== "format" && typeof v !== "object" && v !== "");
  return table({caption: "Where this result comes from", head: ["", "Value"], text: [1], rows: rows.map(([key, v]) => [key.replace(/_/g, " "), String(v)])});
}

