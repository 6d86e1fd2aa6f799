"use strict";

// The tables, in the lecture's order. Each function returns HTML, or "" if the data lacks its part.

// rows: [[heading, cell, ...]]; rows without any value are left out.
function table(caption, head, rows, textColumns = 0) {
  const kept = rows.filter((row) => row.slice(1).some((cell) => cell !== "\u2013"));
  if (!kept.length) return "";
  const css = (i) => (i <= textColumns ? ' class="text"' : "");
  const thead = head.map((h, i) => `<th scope="col"${css(i)}>${h}</th>`).join("");
  const body = kept.map(
      (row) => `<tr><th scope="row">${row[0]}</th>` +
          row.slice(1).map((c, i) => `<td${css(i + 1)}>${c}</td>`).join("") + "</tr>");
  const region = `class="table-wrap" tabindex="0" role="region" aria-label="${escapeHtml(caption)}"`;
  return `<div ${region}><table><caption>${caption}</caption><thead><tr>${thead}</tr></thead>` +
      `<tbody>${body.join("")}</tbody></table></div>`;
}

// The explanation stands beside its table where there is room.
const beside = (tableHtml, note) =>
    (tableHtml ? `<div class="beside">${tableHtml}<div class="note muted">${note}</div></div>` : "");

const section = (heading, html) => (html ? `<section><h2>${heading}</h2>${html}</section>` : "");

function oneWayHtml(data) {
  const one = data.summary.one_way;
  if (!one) return "";
  const warning = one.warning || CAPTIONS.oneWayWarning;
  const columns = [["cw alone", one.cw], ["ccw alone", one.ccw]].filter(([, c]) => c);
  const both = (cell) => (columns.length > 1 ? [cell] : []);
  const row = (name, value, twoWay) => [name, ...columns.map(([, c]) => value(c)), ...both(twoWay)];
  const eMax = (data.summary.umbmark || {}).e_max_syst_m;
  const head = ["Quantity", ...columns.map(([name]) => name), ...both("two-way")];
  const html = table("What each direction alone would report, against both", head, [
    row(`r<sub>cg</sub>, two-way ${E_MAX} (mm)`, (c) => mm(c.r_cg_m), mm(eMax)),
    row("mean heading error (°)", (c) => deg(c.e_theta_rad), "\u2013"),
    row("rms of the return error (mm)", (c) => mm(c.rms_m), "\u2013"),
  ]);
  return `<p class="notice"><b>Read with care.</b> ${escapeHtml(warning)}</p>` + beside(html, CAPTIONS.oneWay);
}

function umbmarkHtml(data) {
  const before = data.summary.umbmark || {};
  const after = clustersOf(data, "after");
  const suffix = after.cw || after.ccw ? " before" : "";
  const columns = [
    [`cw${suffix}`, before.cw],
    [`ccw${suffix}`, before.ccw],
    ["cw after", after.cw],
    ["ccw after", after.ccw],
  ].filter(([, c]) => c && isNumber(c.centroid_x_m));
  if (!columns.length) return "";
  const lengths = ["centroid_x_m", "centroid_y_m", "r_cg_m", "sd_x_m", "sd_y_m", "sd_m", "standard_error_m"];
  const length = (key) => columns.map(([, c]) => mm(c[key], mmDecimals(lengths.map((l) => c[l]))));
  const angle = (key) => columns.map(([, c]) => deg(c[key]));
  const spread = (cells) => cells.map((cell, i) => (columns[i][1].runs === 1 ? "\u2013" : cell));  // one run has none
  const eMax = columns.map(([name, c]) => {
    const value = name === `${worst(before)}${suffix}` ? before.e_max_syst_m :
        name === `${worst(after)} after` ? eMaxOf(after) :
                                           undefined;
    return isNumber(value) ? `<b>${mm(value, mmDecimals(lengths.map((l) => c[l])))}</b>` : "\u2013";
  });
  const html =
      table("Centres of gravity and spread of the end points", ["Quantity", ...columns.map(([name]) => name)], [
        ["runs", ...columns.map(([, c]) => (isNumber(c.runs) ? String(c.runs) : "\u2013"))],
        ["x<sub>cg</sub> (mm)", ...length("centroid_x_m")],
        ["y<sub>cg</sub> (mm)", ...length("centroid_y_m")],
        ["r<sub>cg</sub> (mm)", ...length("r_cg_m")],
        [`${E_MAX}, the larger (mm)`, ...eMax],
        ["sd x (mm)", ...spread(length("sd_x_m"))],
        ["sd y (mm)", ...spread(length("sd_y_m"))],
        ["sd along one axis (mm)", ...spread(length("sd_m"))],
        ["standard error of the centre (mm)", ...spread(length("standard_error_m"))],
        ["mean heading error (°)", ...angle("heading_rad")],
        ["sd heading (°)", ...spread(angle("sd_heading_rad"))],
      ]);
  return beside(html, CAPTIONS.twoWay);
}

function worst(clusters) {
  if (!clusters.cw || !clusters.ccw) return undefined;
  return clusters.cw.r_cg_m >= clusters.ccw.r_cg_m ? "cw" : "ccw";
}

function returnErrorsHtml(data) {
  const runs = data.runs.filter(hasError);
  const decimals = {};
  for (const run of runs) {
    const stage = runs.filter((r) => r.stage === run.stage);
    decimals[run.stage] ??= mmDecimals(stage.flatMap((r) => [r.error.x_m, r.error.y_m]));
  }
  return table(
      "Return error of every run: absolute \u2212 calculated",
      ["Run", "Stage", "e<sub>x</sub> (mm)", "e<sub>y</sub> (mm)", "distance (mm)", "e<sub>\u03b8</sub> (°)"],
      runs.map((r) => {
        const d = decimals[r.stage];
        const {x_m, y_m, theta_rad} = r.error;
        return [
          `${markerIcon(r.direction, r.stage)}${escapeHtml(r.id)}`, escapeHtml(stageName(r.stage)), mm(x_m, d),
          mm(y_m, d), mm(Math.hypot(x_m, y_m), d), deg(theta_rad, 3)
        ];
      }),
      1);
}

function extendedHtml(data) {
  const e = data.summary.extended;
  if (!e) return "";
  const html = table("Mean absolute heading error", ["Quantity", "Value (°)"], [
    ["cw runs", deg(e.cw_mean_abs_heading_error_rad)],
    ["ccw runs", deg(e.ccw_mean_abs_heading_error_rad)],
    ["extended UMBmark figure (sum of both)", `<b>${deg(e.mean_abs_heading_error_rad)}</b>`],
    ["per bump", deg(e.per_bump_heading_error_rad)],
  ]);
  return beside(html, CAPTIONS.extended);
}

// Both forms of E_d and E_b, the applied one first; without one the exact one.
function formsOf({summary: {umbmark = {}, calibration = {}}}) {
  const forms = ["heading", "endpoint"].map((name) => {
    const applied = calibration.applied === name;
    return {name, applied, label: `${name} form${applied ? ", applied" : ""}`, ...umbmark[name], ...calibration[name]};
  });
  return forms.sort((a, b) => b.applied - a.applied);
}

function calibrationHtml(data) {
  const {umbmark = {}, injected = {}} = data.summary;
  const forms = formsOf(data);
  const columns = [
    ...forms.map((form) => [form.label, form]),
    ["injected", {...anglesOf(injected, data), ...injected}],
  ].filter(([, c]) => Object.values(c).some(isNumber));
  const row = (name, value) => [name, ...columns.map(([, c]) => value(c))];
  const b = data.wheelbase_m;
  const html = table("The two dominant systematic errors", ["Quantity", ...columns.map(([name]) => name)], [
    row("\u03b1, type A, per turn (°)", (c) => deg(c.alpha_rad, 4)),
    row("\u03b2, type B, per leg (°)", (c) => deg(c.beta_rad, 4)),
    row("R, radius of curvature of a leg (m)", (c) => curvature(c.beta_rad, data.side_m)),
    row("E<sub>d</sub> = D<sub>R</sub> / D<sub>L</sub>", (c) => fixed(c.e_d, 5)),
    row("E<sub>b</sub> = b<sub>actual</sub> / b<sub>nominal</sub>", (c) => fixed(c.e_b, 5)),
    row("b<sub>actual</sub> (mm)", (c) => (isNumber(b) && isNumber(c.e_b) ? mm(c.e_b * b, 2) : "\u2013")),
    row("c<sub>L</sub> = 2 / (E<sub>d</sub> + 1)", (c) => (isNumber(c.e_d) ? fixed(2 / (c.e_d + 1), 5) : "\u2013")),
    row("c<sub>R</sub> = 2 / (1/E<sub>d</sub> + 1)",
        (c) => (isNumber(c.e_d) ? fixed(2 / (1 / c.e_d + 1), 5) : "\u2013")),
  ]);
  const trust = forms.filter((f) => f.trust).map((f) => `<p><b>${f.name} form</b>: ${escapeHtml(f.trust)}.</p>`);
  return beside(html, sharesHtml(umbmark) + trust.join("") + CAPTIONS.types);
}

// Alpha and beta that belong to known E_d and E_b: the equations of the lecture solved for them.
function anglesOf({e_d: eD, e_b: eB}, {side_m: side, wheelbase_m: b}) {
  const angles = {};
  if (isNumber(eB)) angles.alpha_rad = (Math.PI / 2) * (1 - 1 / eB);
  if (isNumber(eD) && isNumber(side) && isNumber(b))
    angles.beta_rad = 2 * Math.asin(((side / b) * (eD - 1)) / (eD + 1));
  return angles;
}

function curvature(beta, side) {
  if (!isNumber(beta) || !isNumber(side)) return "\u2013";
  const radius = side / 2 / Math.sin(beta / 2);
  return Math.abs(radius) < 1e6 ? fixed(radius, 1) : "straight";
}

function sharesHtml({type_a_share: a, type_b_share: b}) {
  return isNumber(a) && isNumber(b) ?
      `<p>Here type A makes ${fixed(a * 100, 0)}&nbsp;% and type B ${fixed(b * 100, 0)}&nbsp;% of the error.</p>` :
      "";
}

function recoveryHtml(data) {
  const r = data.summary.recovery;
  if (!r) return "";
  const before = (data.summary.umbmark || {}).e_max_syst_m;
  const html = table("What was recovered", ["Quantity", "Value"], [
    [`${E_MAX} before (mm)`, mm(before)],
    [`${E_MAX} after (mm)`, mm(r.e_max_after_m)],
    ["improvement, factor", factor(r.improvement)],
    ["E<sub>d</sub>, recovered \u2212 injected", signedSmall(r.e_d_error)],
    ["E<sub>b</sub>, recovered \u2212 injected", signedSmall(r.e_b_error)],
    ["calibration passes", isNumber(r.passes) ? String(r.passes) : "\u2013"],
  ]);
  return html && "<h3>Driven again with the calibrated odometry</h3>" + beside(html, CAPTIONS.recovery);
}

function costHtml(data) {
  const c = data.summary.cost;
  if (!c) return "";
  const speed = isNumber(c.simulated_s) && c.wall_s > 0 ? factor(c.simulated_s / c.wall_s) : "\u2013";
  const count = (v) => (isNumber(v) ? v.toLocaleString("en").replace(/,/g, "\u202f") : "\u2013");
  return table("What the run took", ["Quantity", "Value"], [
    ["simulated time (s)", fixed(c.simulated_s, 1)],
    ["computing time (s)", fixed(c.wall_s, 2)],
    ["times faster than real time", speed],
    ["physics steps", count(c.steps)],
    ["solver fallbacks", count(c.solver_fallbacks)],
  ]);
}
