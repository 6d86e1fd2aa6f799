"use strict";

// Numbers and text. The data is SI; the page shows mm and degrees.

const DEG = 180 / Math.PI;

const isNumber = (v) => typeof v === "number" && Number.isFinite(v);

const escapeHtml = (text) =>
    String(text).replace(/[&<>"']/g, (c) => ({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&#39;"})[c]);

const minus = (text) => (/^-0(\.0*)?$/.test(text) ? text.slice(1) : text.replace("-", "\u2212"));

const fixed = (v, decimals) => (isNumber(v) ? minus(v.toFixed(decimals)) : "\u2013");

const largest = (values) => Math.max(0, ...values.filter(isNumber).map(Math.abs));

// As many decimals as say something: 311.0, 8.21, 0.0312.
function mmDecimals(values_m) {
  const mm = largest(values_m) * 1000;
  return mm >= 10 || mm === 0 ? 1 : mm >= 1 ? 2 : mm >= 0.1 ? 3 : 4;
}

const degDecimals = (values_rad) => {
  const deg = largest(values_rad) * DEG;
  return deg >= 0.01 || deg === 0 ? 3 : 5;
};

const mm = (v_m, decimals = mmDecimals([v_m])) => fixed(isNumber(v_m) ? v_m * 1000 : v_m, decimals);

const deg = (v_rad, decimals = degDecimals([v_rad])) => fixed(isNumber(v_rad) ? v_rad * DEG : v_rad, decimals);

const mmUnit = (v_m) => `${mm(v_m)}\u00a0mm`;

const degUnit = (v_rad) => (isNumber(v_rad) ? `${deg(v_rad)}°` : "\u2013");

function factor(v) {
  if (!isNumber(v)) return "\u2013";
  return v >= 100 ? Math.round(v).toLocaleString("en").replace(/,/g, "\u202f") : fixed(v, 1);
}

const signedSmall = (v) => !isNumber(v) ? "\u2013" :
    v === 0                             ? "0" :
    Math.abs(v) < 1e-4                  ? minus(v.toExponential(1)) :
                                          fixed(v, 5);

const plural = (n, one) => `${n} ${one}${n === 1 ? "" : "s"}`;

const DIRECTION_NAMES = {
  cw: "clockwise",
  ccw: "counter-clockwise"
};
const STAGE_NAMES = {
  before: "before calibration",
  after: "after calibration",
  bumped: "with bumps"
};
const directionName = (d) => DIRECTION_NAMES[d] || d || "run";
const stageName = (s) => STAGE_NAMES[s] || s || "";
const colourClass = (d) => (d === "cw" || d === "ccw" ? d : "other");

const E_MAX = "E<sub>max,syst</sub>";
