"use strict";

// The lecture's comparisons: systematic against non-systematic error, predicted uncertainty against what happened.

// Shares near all or nothing get another digit.
function percent(v) {
  if (!isNumber(v)) return "\u2013";
  return `${fixed(v * 100, v === 0 || v === 1 ? 0 : Math.min(v, 1 - v) < 0.005 ? 2 : 1)}\u00a0%`;
}

function sharesTableHtml(data) {
  const shares = data.summary.shares;
  if (!shares) return "";
  const columns = [["cw", shares.cw], ["ccw", shares.ccw]].filter(([, s]) => s);
  if (columns.length === 2) columns.push(["both", shares]);
  const decimals = mmDecimals(columns.map(([, s]) => s.rms_m));
  const row = (name, value) => [name, ...columns.map(([, s]) => value(s))];
  const head = ["Quantity", ...columns.map(([name]) => name)];
  const html = table("Shares of the mean square return error, before calibration", head, [
    row("rms of the return error (mm)", (s) => mm(s.rms_m, decimals)),
    row("systematic: r<sub>cg</sub> (mm)", (s) => mm(s.systematic_m, decimals)),
    row("non-systematic: rms distance from the centre (mm)", (s) => mm(s.non_systematic_m, decimals)),
    row("systematic share", (s) => percent(s.systematic)),
    row("non-systematic share", (s) => percent(s.non_systematic)),
  ]);
  return beside(html, CAPTIONS.shares);
}

function uncertaintyHtml(data) {
  const u = data.summary.uncertainty;
  if (!u) return "";
  const suffix = u.after ? " before" : "";
  const after = u.after || {};
  const columns = [
    [`cw${suffix}`, u.cw],
    [`ccw${suffix}`, u.ccw],
    ["cw after", after.cw],
    ["ccw after", after.ccw],
  ].filter(([, f]) => f);
  const row = (name, value) => [name, ...columns.map(([, f]) => value(f))];
  const axis = (i) => (f) => mm((f.ellipse_95_semi_axes_m || [])[i]);
  const html = table("The ellipse at the end of the run", ["Quantity", ...columns.map(([name]) => name)], [
    row("longer semi-axis of the 95\u00a0% ellipse (mm)", axis(0)),
    row("shorter semi-axis (mm)", axis(1)),
    row("standard deviation of the heading (°)", (f) => deg(f.heading_sd_rad)),
    row("runs", (f) => String(f.runs)),
    row("true end inside the ellipse", (f) => percent(f.inside_95_share)),
    row("true position inside, on the way", (f) => percent(f.inside_95_share_on_the_way)),
  ]);
  return beside(html, CAPTIONS.uncertainty);
}
