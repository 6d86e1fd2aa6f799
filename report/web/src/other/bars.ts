// Points with their intervals, bars with names: the charts of the smaller pages.

import * as Plot from "@observablehq/plot";
import {Chart, tip} from "../lib/chart";

export interface Interval {
  name: string;
  value: number;
  low?: number;
  high?: number;
  group?: string;
  best?: boolean;
  words: string;
}

const SYMBOLS = ["circle", "triangle", "square", "diamond", "star", "wye"] as const;
export const COLOURS = ["var(--cw)", "var(--ccw)", "var(--accent)", "var(--bump)", "var(--muted)", "var(--ink)"];

/// A row for each name: a mark at the value, a line over its interval. Groups differ by shape and colour.
export function intervals(place: HTMLElement, name: string, label: string, all: Interval[], line?: number): Chart {
  const names = [...new Set(all.map((d) => d.name))];
  const groups = [...new Set(all.map((d) => d.group ?? ""))];
  const longest = Math.max(...names.map((n) => n.length));
  return new Chart(place, {
    name, most: 1000, zoom: "none",
    draw: (width) => ({
      label: `${label}: ${all.map((d) => d.words.replace(/\n/g, ", ")).join("; ")}`.slice(0, 900), stops: all.map((d) => [d.value, d.name as unknown as number]),
      plot: {
        width, height: 70 + 26 * names.length, marginLeft: Math.min(width * 0.42, 16 + 7 * longest), marginTop: 10, marginBottom: 42,
        x: {label, labelAnchor: "center", nice: true}, y: {domain: names, label: null, type: "point", padding: 0.6},
        symbol: {domain: groups, range: SYMBOLS.slice(0, groups.length)},
        marks: [
          Plot.gridX({stroke: "var(--grid)", strokeOpacity: 1}), line === undefined ? null : Plot.ruleX([line], {stroke: "var(--axis)", strokeDasharray: "4 3"}),
          Plot.ruleY(all.filter((d) => d.low !== undefined), {y: "name", x1: "low", x2: "high", stroke: (d: Interval) => COLOURS[groups.indexOf(d.group ?? "")], strokeWidth: 2, className: "interval"}),
          Plot.dot(all, {x: "value", y: "name", symbol: (d: Interval) => d.group ?? "", r: (d: Interval) => (d.best ? 7 : 5), fill: (d: Interval) => COLOURS[groups.indexOf(d.group ?? "")],
            stroke: "var(--card)", title: "words", tip, className: "value"})],
        r: {type: "identity"}, color: {type: "identity"},
      },
    })});
}

export interface Cell {
  row: string;
  column: string;
  value: number;
  text?: string;
  words: string;
  link?: string;
}

/// A matrix of shares; zero is left white.
export function matrix(place: HTMLElement, name: string, rows: string[], columns: string[], cells: Cell[], [rowLabel, columnLabel]: [string, string]): Chart {
  const left = 22 + 6.4 * Math.max(...rows.map((r) => r.length));
  const bottom = 30 + 4.6 * Math.max(...columns.map((c) => c.length));
  return new Chart(place, {
    name, most: 1060, zoom: "none",
    draw: (width) => ({
      label: `${columnLabel} for each ${rowLabel}: ${cells.filter((c) => c.row === c.column).length} of ${rows.length} rows have a value on the diagonal`, stops: [],
      plot: {
        width, height: 40 + bottom + rows.length * Math.max(15, Math.min(26, (width - left) / columns.length)), marginLeft: Math.min(left, width * 0.4), marginBottom: bottom, marginTop: 28,
        x: {domain: columns, label: columnLabel, tickRotate: -50, labelAnchor: "center", labelOffset: bottom - 6}, y: {domain: rows, label: rowLabel},
        marks: [
          Plot.cell(cells, {x: "column", y: "row", fill: "var(--cw)", fillOpacity: (c: Cell) => Math.max(0.06, c.value), title: "words", tip, href: "link", className: "cell"}),
          Plot.cell(cells.filter((c) => c.row === c.column), {x: "column", y: "row", stroke: "var(--ink)", fill: "none", inset: 0.5}),
          width > 640 && columns.length <= 32 ? Plot.text(cells.filter((c) => c.text), {x: "column", y: "row", text: "text", fill: "var(--ink)", stroke: "var(--card)", strokeWidth: 3, fontSize: 10.5}) : null,
          Plot.frame({stroke: "var(--line)"})],
      },
    })});
}
