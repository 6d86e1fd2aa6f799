"use strict";

// The rows of a sweep by column; which values an axis takes; names and units.

// A figure's unit is in its name. The page shows mm and degrees.
function unitOf(name) {
  if (/_m$/.test(name)) return {scale: 1000, unit: "mm"};
  if (/_rad$/.test(name)) return {scale: DEG, unit: "°"};
  return {scale: 1, unit: ""};
}

const withUnit = (name) => (unitOf(name).unit ? `${name} (${unitOf(name).unit})` : name);

// Four digits that say something.
function short(v) {
  if (!isNumber(v)) return typeof v === "string" ? v : "\u2013";
  if (v === 0) return "0";
  const size = Math.abs(v);
  const text = size >= 1e5 || size < 1e-3 ? v.toExponential(2) : Number(v.toPrecision(4)).toString();
  return minus(text);
}

function loadSweep() {
  const data = JSON.parse(document.getElementById("report-data").textContent);
  const names = [...data.axes.map((a) => a.key), ...data.figures];
  data.place = new Map(names.map((name, i) => [name, i]));
  data.axes.forEach((axis) => Object.assign(axis, axisValues(data, axis.key)));
  return data;
}

const has = (data, name) => data.place.has(name);
const valueOf = (data, row, name) => row.v[data.place.get(name)];
const axisOf = (data, key) => data.axes.find((a) => a.key === key);

// Distinct values in order: numbers by size, others as they come.
function axisValues(data, key) {
  const values = [...new Set(data.rows.map((row) => valueOf(data, row, key)))];
  const numeric = values.every(isNumber);
  if (numeric) values.sort((a, b) => a - b);
  return {values, numeric};
}

// A sampled axis has a value of its own in nearly every row: it is drawn to scale, not in cells.
const isScattered = (data, axis) => axis.numeric && axis.values.length > 60 && axis.values.length > data.rows.length / 3;

function describeRow(data, row) {
  return data.axes.map((a) => `${a.key} = ${short(valueOf(data, row, a.key))}`).join(", ");
}

// What is wrong with a point: it could not be driven, or it does not meet an expectation.
function faultOf(data, row) {
  if (row.failed) return "could not be driven";
  return row.unmet ? `not met: ${row.unmet.map((i) => data.checks[i].expectation).join("; ")}` : "";
}

const mean = (values) => values.reduce((sum, v) => sum + v, 0) / values.length;

// The rows that share x and y: their mean, and what is wrong with any of them.
function cellOf(data, rows, figure) {
  const {scale} = unitOf(figure);
  const values = rows.map((row) => valueOf(data, row, figure)).filter(isNumber).map((v) => v * scale);
  return {
    rows,
    value: values.length ? mean(values) : undefined,
    failed: rows.some((row) => row.failed),
    unmet: rows.some((row) => row.unmet),
  };
}

function groupBy(rows, keyOf) {
  const groups = new Map();
  for (const row of rows) {
    const key = keyOf(row);
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(row);
  }
  return groups;
}
