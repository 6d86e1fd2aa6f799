// Points with their intervals, bars with names: the charts of the smaller pages.

import * as Plot from "@observablehq/plot";
import {Chart} from "../lib/chart";

export interface Interval {
  name: string;
  value: number;
  low?: number;
  high?: number;
  group?: string;
  best?: boolean;
  words: string;
}

export const SYMBOLS = ["circle", "triangle", "square", "diamond", "star", "wye"] as const;
export const COLOURS = ["var(--cw)", "var(--ccw)", "var(--accent)", "var(--bump)", "var(--muted)", "var(--ink)"];

/// A row for each name: a mark at the value, a line over its interval. Groups differ by shape and colour.
export function intervals(place: HTMLElement, name: string, label: string, all: Interval[], line?: number): Chart {
  const names = [...new Set(all.map((d) => d.name))];
  const groups = [...new Set(all.map((d) => d.group ?? ""))];
  const ofGroup = (d: Interval) => COLOURS[groups.indexOf(d.group ?? "")];
  return new Chart(place, {
    name, most: 1000, zoom: "none", draw: (width) => ({
      label: `${label}: ${all.map((d) => d.words.replace(/\n/g, ", ")).join("; ")}`.slice(0, 900), points: all.map((d) => ({x: d.value, y: d.name, words: d.words})),
      height: 70 + 26 * names.length, grid: "x", x: {label, nice: true, zero: line === undefined}, y: {domain: names, label: null, type: "point", padding: 0.6},
      plot: {marginLeft: Math.min(width * 0.42, 16 + 7 * Math.max(...names.map((n) => n.length))), marginTop: 10, marginBottom: 42,
             symbol: {domain: groups, range: SYMBOLS.slice(0, groups.length)}, r: {type: "identity"}, color: {type: "identity"}},
      marks: [
        line === undefined ? null : Plot.ruleX([line], {stroke: "var(--axis)", strokeDasharray: "4 3"}),
        Plot.ruleY(all.filter((d) => d.low !== undefined), {y: "name", x1: "low", x2: "high", stroke: ofGroup, strokeWidth: 2, className: "interval"}),
        Plot.dot(all, {x: "value", y: "name", symbol: (d: Interval) => d.group ?? "", r: (d: Interval) => (d.best ? 7 : 5), fill: ofGroup, stroke: "var(--card)", clip: false, className: "value"})],
    })});
}

export interface Cell {
  row: string;
  column: string;
  value: number;
  right: boolean;
  text: string;
  words: string;
  link?: string;
}

/// A matrix of shares; zero is left white, what is right is framed. On a narrow screen it is wider than its frame, which scrolls.
export function matrix(place: HTMLElement, name: string, rows: string[], columns: string[], cells: Cell[], [rowLabel, columnLabel]: [string, string]): Chart {
  const longest = (names: string[]) => Math.max(...names.map((n) => n.length));
  const slanted = columns.map((c, i) => 4.4 * c.length - 20 * i);  // how far the name of a column reaches beyond the first
  const [left, bottom] = [Math.max(40 + 6.6 * longest(rows), ...slanted), 34 + 5 * longest(columns)];
  return new Chart(place, {
    name, most: Math.min(1060, left + 34 * columns.length), least: Math.min(1060, left + 20 * columns.length), zoom: "none", draw: () => ({
      label: `${columnLabel} for each ${rowLabel}: ${cells.filter((c) => c.right).length} of ${cells.length} cells are right`, grid: "none",
      points: cells.map((c) => ({x: c.column, y: c.row, words: c.words})), height: 34 + bottom + 22 * rows.length,
      x: {domain: columns, label: columnLabel, tickRotate: -50, labelOffset: bottom - 4}, y: {domain: rows, label: rowLabel},
      plot: {marginLeft: left, marginBottom: bottom, marginTop: 28},
      marks: [
        Plot.cell(cells, {x: "column", y: "row", fill: "var(--cw)", fillOpacity: (c: Cell) => Math.max(0.06, c.value), href: "link", className: "cell"}),
        Plot.cell(cells.filter((c) => c.right), {x: "column", y: "row", stroke: "var(--ink)", strokeWidth: 1.5, fill: "none", inset: 0.5, className: "right"}),
        Plot.text(cells, {x: "column", y: "row", text: "text", fill: "var(--ink)", stroke: "var(--card)", strokeWidth: 3, fontSize: 10.5, pointerEvents: "none", className: "counts"}),
        Plot.frame({stroke: "var(--line)"})],
    })});
}
