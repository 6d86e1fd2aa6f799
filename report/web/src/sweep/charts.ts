// A figure over one or two axes: curves with bands of quantiles, coloured cells, coloured points; and all axes side by side.

import * as Plot from "@observablehq/plot";
import {group, quantileSorted} from "d3";
import type {Drawing, Point} from "../lib/chart";
import {isNumber, short} from "../lib/format";
import {axisOf, describe, faultOf, isScattered, labelOf, numberOf, valueOf, type Axis, type Row, type SweepData} from "./data";

export interface Choice {
  x: string;
  y: string;
  figure: string;
  kind: string;
  log: boolean;
}

const CURVES = ["#0067a5", "#c2500a", "#0b6e5f", "#a0387c", "#7a6a00", "#4a4ab8", "#b02030", "#3a7d1a"].map((c, i) => `var(--curve-${i}, ${c})`);
const SYMBOLS = ["circle", "triangle", "square", "diamond", "cross", "star", "wye", "plus"];
const MOST_DOTS = 4000;   // as marks of their own; more are shown in bins
const MOST_LINES = 1200;  // of all axes side by side

const finite = (v: number): boolean => Number.isFinite(v);

/// The rows of one place: middle, quantiles, and what is wrong with any of them.
function place(data: SweepData, rows: Row[], c: Choice) {
  const values = rows.map((r) => numberOf(data, r, c.figure)).filter(finite).map((v) => (c.log ? Math.abs(v) : v)).filter((v) => !c.log || v > 0).sort((a, b) => a - b);
  const q = (p: number) => (values.length ? quantileSorted(values, p)! : NaN);
  return {rows, row: rows[0], middle: q(0.5), low: q(0.1), high: q(0.9), n: values.length, failed: rows.some((r) => r.failed), unmet: rows.some((r) => r.unmet)};
}

type Place = ReturnType<typeof place> & {x: number | string; y?: number | string};

const scaleOf = (data: SweepData, axis: Axis): Plot.ScaleOptions => ({label: labelOf(data, axis.key), inset: 8,
  ...(axis.numeric ? {type: axis.log ? "log" : "linear", ...(axis.log && {tickFormat: (v: number) => (/^[125]/.test(v.toExponential()) ? short(v) : "")})} :
                     {type: "point", domain: axis.values as string[], padding: 0.5})});

const labelled = (data: SweepData, c: Choice): string => (c.log ? `|${labelOf(data, c.figure)}|` : labelOf(data, c.figure));

const words = (data: SweepData, c: Choice, p: Place): string => [
  describe(data, p.row), `${labelOf(data, c.figure)}: ${short(p.middle)}${p.n > 1 ? `, median of ${p.n}, 80 % from ${short(p.low)} to ${short(p.high)}` : ""}`,
  p.rows.map((r) => faultOf(data, r)).find(Boolean)].filter(Boolean).join("\n");

const pointsOf = (data: SweepData, c: Choice, places: Place[], y: (p: Place) => number | string): Point[] =>
    places.map((p) => ({x: p.x, y: y(p), words: words(data, c, p)}));

/// Crosses where a point could not be driven, rings where an expectation is not met.
const faults = (places: Place[], y: (p: Place) => number | string): Plot.Markish[] => [
  Plot.dot(places.filter((p) => p.unmet), {x: "x", y, r: 6.5, stroke: "var(--bad)", strokeWidth: 1.6, className: "unmet"}),
  ...[4.6, 2.2].map((strokeWidth, i) => Plot.dot(places.filter((p) => p.failed), {
    x: "x", y, symbol: "times", r: 5, stroke: i ? "var(--bad)" : "var(--card)", strokeWidth, className: i ? "fault" : "halo"}))];

function curves(data: SweepData, rows: Row[], c: Choice, width: number): Drawing {
  const series = [...group(rows, (r) => (c.y ? valueOf(data, r, c.y) : ""))].map(([, own], i) => ({
    colour: CURVES[i % CURVES.length], symbol: SYMBOLS[i % SYMBOLS.length] as Plot.SymbolType,
    places: [...group(own, (r) => valueOf(data, r, c.x))].map(([x, at]): Place => ({...place(data, at, c), x: x!})).sort((a, b) => (a.x < b.x ? -1 : 1))}));
  const all = series.flatMap((s) => s.places);
  const lowest = Math.min(...all.map((p) => p.middle).filter(finite), Infinity);
  const y = (p: Place) => (finite(p.middle) ? p.middle : lowest);
  return {
    label: `${labelOf(data, c.figure)} over ${labelOf(data, c.x)}${c.y ? `, a curve for each ${labelOf(data, c.y)}` : ""}`, points: pointsOf(data, c, all, y), grid: "xy",
    height: Math.max(280, width * 0.52), x: scaleOf(data, axisOf(data, c.x)!),
    y: {nice: true, label: labelled(data, c), ...(c.log && {type: "log" as const, tickFormat: short})},
    marks: [...series.flatMap(({places, colour, symbol}) => [
      Plot.areaY(places.filter((p) => p.n > 2), {x: "x", y1: "low", y2: "high", fill: colour, fillOpacity: 0.15, className: "band"}),
      Plot.line(places.filter((p) => finite(p.middle)), {x: "x", y: "middle", stroke: colour, strokeWidth: 2, className: "curve"}),
      Plot.dot(places.filter((p) => finite(p.middle)), {x: "x", y: "middle", symbol, r: 3.6, fill: colour, clip: false, className: "place"})]), ...faults(all, y)],
  };
}

export const curveNames = (data: SweepData, rows: Row[], c: Choice): [string, string][] =>
    (c.y ? [...group(rows, (r) => valueOf(data, r, c.y)).keys()].map((v, i) => [CURVES[i % CURVES.length], `${labelOf(data, c.y)}: ${short(v)}`]) : []);

/// Colours of the figure: by size on a logarithmic scale, or evenly; about 0 where both signs occur.
export function colours(data: SweepData, rows: Row[], c: Choice): Plot.ScaleOptions {
  const values = rows.map((r) => numberOf(data, r, c.figure)).filter(finite);
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const label = labelled(data, c);
  if (c.log) {
    const sizes = values.map(Math.abs).filter((v) => v > 0);
    const most = Math.max(...sizes, 1e-12);
    return {type: "log", scheme: "viridis", label, domain: [Math.max(Math.min(...sizes, most), most * 1e-9), most]};
  }
  if (low >= 0 || high <= 0) return {type: "linear", scheme: "viridis", label, domain: [low, high]};
  return {type: "diverging", scheme: "PuOr", reverse: true, label, domain: [-Math.max(-low, high), Math.max(-low, high)]};
}

const fill = (p: Place) => (finite(p.middle) ? p.middle : null);

function cells(data: SweepData, rows: Row[], c: Choice, width: number): Drawing {
  const [xAxis, yAxis] = [axisOf(data, c.x)!, axisOf(data, c.y)!];
  const places = [...group(rows, (r) => valueOf(data, r, c.x), (r) => valueOf(data, r, c.y))].flatMap(([x, at]) =>
    [...at].map(([y, own]): Place => ({...place(data, own, c), x: x!, y: y!})));
  const height = Math.max(200, Math.min(560, width * Math.min(1.1, Math.max(0.3, yAxis.values.length / xAxis.values.length))));
  const axis = (a: Axis, room: number): Plot.ScaleOptions => ({
    domain: a.values as string[], label: labelOf(data, a.key), tickFormat: short, ...(a.values.length > 40 && {padding: 0, round: false}),
    ticks: a.values.filter((_, i) => i % Math.max(1, Math.ceil(a.values.length / room)) === 0) as string[]});
  return {
    label: `${labelOf(data, c.figure)} over ${labelOf(data, c.x)} and ${labelOf(data, c.y)}`, points: pointsOf(data, c, places, (p) => p.y!), grid: "none", height,
    plot: {marginLeft: Math.min(130, 44 + 6 * Math.max(...yAxis.values.map((v) => short(v).length))), marginBottom: 44, marginTop: 28, color: colours(data, rows, c)},
    x: axis(xAxis, width / 56), y: {...axis(yAxis, height / 18), reverse: true},
    marks: [Plot.cell(places, {x: "x", y: "y", fill, inset: 0, shapeRendering: "crispEdges", className: "cell"}), Plot.frame({stroke: "var(--line)"}), ...faults(places, (p) => p.y!)],
  };
}

function dots(data: SweepData, rows: Row[], c: Choice, width: number): Drawing {
  const places = rows.map((r): Place => ({...place(data, [r], c), x: numberOf(data, r, c.x), y: numberOf(data, r, c.y)}));
  const many = places.length > MOST_DOTS;
  return {
    label: `${labelOf(data, c.figure)} over ${labelOf(data, c.x)} and ${labelOf(data, c.y)}${many ? ", medians of small cells" : ""}`,
    points: many ? [] : pointsOf(data, c, places, (p) => p.y!), grid: "xy", height: Math.max(300, width * 0.58), plot: {color: colours(data, rows, c)},
    x: scaleOf(data, axisOf(data, c.x)!), y: scaleOf(data, axisOf(data, c.y)!),
    marks: [
      many ? Plot.dot(places, Plot.hexbin({fill: "median"}, {x: "x", y: "y", fill, binWidth: 11, tip: {clip: false}, className: "cell"})) :
             Plot.dot(places, {x: "x", y: "y", fill, r: 4.6, stroke: "var(--axis)", strokeWidth: 0.5, className: "cell"}),
      ...faults(places.filter((p) => p.failed || p.unmet).slice(0, MOST_DOTS), (p) => p.y!)],
  };
}

/// Every axis and the figure as an upright scale from least to most; a line for each point.
function parallel(data: SweepData, rows: Row[], c: Choice, width: number): Drawing {
  const names = [...data.axes.filter((a) => a.values.length > 1).map((a) => a.key), c.figure];
  const stride = Math.ceil(rows.length / MOST_LINES);
  const shown = rows.filter((r, i) => i % stride === 0 || r.failed);
  const share = new Map(names.map((name) => {
    const axis = axisOf(data, name);
    if (axis && !axis.numeric) return [name, (r: Row) => axis.values.indexOf(valueOf(data, r, name)!) / Math.max(1, axis.values.length - 1)];
    const log = axis?.log || (name === c.figure && c.log);
    const at = (r: Row) => (log ? Math.log10(Math.abs(numberOf(data, r, name))) : numberOf(data, r, name));
    const values = rows.map(at).filter(finite);
    const [low, high] = values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
    return [name, (r: Row) => (at(r) - low) / (high - low || 1)];
  }));
  const corners = shown.flatMap((row) => names.map((name) => ({row, name, at: share.get(name)!(row), value: numberOf(data, row, c.figure)})));
  const ends = names.flatMap((name) => [0, 1].map((end) => {
    const axis = axisOf(data, name);
    const values = rows.map((r) => valueOf(data, r, name)).filter(isNumber);
    const v = axis ? axis.values[end ? axis.values.length - 1 : 0] : values.reduce((a, b) => (end ? Math.max(a, b) : Math.min(a, b)), end ? -Infinity : Infinity);
    return {name, end, text: short(v)};
  }));
  const label = (name: string) => labelOf(data, name);
  return {
    label: `All axes side by side, a line for each of ${shown.length} points, coloured by ${label(c.figure)}`, grid: "none",
    height: Math.max(320, width * 0.45), plot: {marginTop: 30, marginBottom: 60, marginLeft: 50, marginRight: 50, color: colours(data, rows, c)},
    x: {type: "point", domain: names, label: null, tickFormat: label, tickRotate: names.length * 130 > width ? -18 : 0}, y: {axis: null, domain: [0, 1]},
    marks: [
      Plot.line(corners.filter((p) => !p.row.failed), {x: "name", y: "at", z: (p) => p.row.point, stroke: (p) => (c.log ? Math.abs(p.value) : p.value), strokeWidth: 1, strokeOpacity: 0.45, className: "point"}),
      Plot.line(corners.filter((p) => p.row.failed && finite(p.at)), {x: "name", y: "at", z: (p) => p.row.point, stroke: "var(--bad)", strokeDasharray: "3 2", className: "fault"}),
      Plot.ruleX(names, {stroke: "var(--axis)"}),
      Plot.text(ends, {x: "name", y: "end", text: "text", textAnchor: "start", dx: 4, lineAnchor: "middle", fill: "var(--ink)", stroke: "var(--card)", strokeWidth: 4, fontSize: 11.5, clip: false})],
  };
}

/// Which picture serves.
export function drawing(data: SweepData, rows: Row[], c: Choice, width: number): Drawing {
  if (c.kind === "parallel") return parallel(data, rows, c, width);
  if (isCurves(data, c)) return curves(data, rows, c, width);
  return isScattered(data, axisOf(data, c.x)!) && isScattered(data, axisOf(data, c.y)!) ? dots(data, rows, c, width) : cells(data, rows, c, width);
}

export const isCurves = (data: SweepData, c: Choice): boolean =>
    c.kind !== "parallel" && (!axisOf(data, c.y) || (c.kind === "curves" && axisOf(data, c.y)!.values.length <= CURVES.length));
