// The rows of a sweep by column; which values an axis takes; names and units as a reader wants them.

import {DEG, isNumber, short} from "../lib/format";
import type {Figures} from "../run/data";

export interface Row {
  point: number;
  failed?: boolean;
  unmet?: number[];
  v: (number | string | null)[];
}

export interface Axis {
  key: string;
  log: boolean;
  values: (number | string)[];
  numeric: boolean;
}

export interface Check {
  expectation: string;
  figure: string;
  met: boolean;
  checked: number;
  unmet: {point?: number; where: string; value: number}[];
}

export interface SweepData {
  title: string;
  description?: string;
  version: string;
  points: number;
  done: number;
  design: string;
  stride: number;
  failed: {point: number; where: string; error: string}[];
  checks: Check[];
  axes: Axis[];
  figures: string[];
  view: {x: string; y: string; figure: string; log: boolean};
  rows: Row[];
  provenance?: Figures;
}

const UNITS: [RegExp, number, string][] = [
  [/_m_per_sqrt_m$/, 1000, "mm/\u221am"], [/_rad_per_m$/, DEG, "°/m"], [/_radps2$/, DEG, "°/s\u00b2"], [/_mps2$/, 1, "m/s\u00b2"], [/_radps$/, DEG, "°/s"],
  [/_mps$/, 1, "m/s"], [/_rad$/, DEG, "°"], [/_mpn$/, 1, "m/N"], [/_mm$/, 1, "mm"], [/_deg$/, 1, "°"], [/_nm$/, 1, "N m"], [/_n$/, 1, "N"], [/_kg$/, 1, "kg"],
  [/_hz$/, 1, "Hz"], [/_s$/, 1, "s"], [/(^|\.)relative$/, 100, "%"], [/_share$/, 100, "%"]];

/// What a column's numbers are multiplied by, and its name with the unit. Lengths of figures are in mm, those of axes in m.
export function shownAs(name: string, axis: boolean): {scale: number; unit: string; label: string} {
  const [, scale, unit, suffix] = UNITS.map(([end, s, u]) => [end.test(name), s, u, end] as const).find(([hit]) => hit) ??
      (/_m$/.test(name) ? [true, axis ? 1 : 1000, axis ? "m" : "mm", /_m$/] as const : [true, 1, "", /$^/] as const);
  const bare = name.replace(suffix.source.startsWith("(^") ? /$^/ : suffix, "").replace(/^(effects|course|umbmark|floor|encoders|noise|truth|runs)\./, "");
  const words = bare.replace("e_max_syst", "E_max,syst").replace(/\be_([db])(?=_|\b)/g, "E_$1").replace(/\./g, ", ").replace(/(?<!E)_(?!max)/g, " ");
  return {scale, unit, label: unit ? `${words} (${unit})` : words};
}

export const has = (data: SweepData, name: string): boolean => placeOf(data).has(name);

const places = new WeakMap<SweepData, Map<string, number>>();

function placeOf(data: SweepData): Map<string, number> {
  let place = places.get(data);
  if (!place) {
    place = new Map([...data.axes.map((a) => a.key), ...data.figures].map((name, i) => [name, i]));
    places.set(data, place);
  }
  return place;
}

/// A value as the page shows it.
export function valueOf(data: SweepData, row: Row, name: string): number | string | undefined {
  const i = placeOf(data).get(name);
  const v = i === undefined ? undefined : row.v[i];
  return isNumber(v) ? v * shownAs(name, i! < data.axes.length).scale : v ?? undefined;
}

export const numberOf = (data: SweepData, row: Row, name: string): number => {
  const v = valueOf(data, row, name);
  return isNumber(v) ? v : NaN;
};

export const axisOf = (data: SweepData, key: string): Axis | undefined => data.axes.find((a) => a.key === key);

export function load(data: SweepData): SweepData {
  for (const axis of data.axes) {
    const values = [...new Set(data.rows.map((row) => valueOf(data, row, axis.key)))].filter((v): v is number | string => v !== undefined);
    axis.numeric = values.every(isNumber);
    axis.values = axis.numeric ? (values as number[]).sort((a, b) => a - b) : values;
    // Values over more than a decade, such as of friction, would crowd at the lower end.
    const [low, high] = [axis.values[0], axis.values[axis.values.length - 1]];
    axis.log ||= isNumber(low) && isNumber(high) && low > 0 && high / low >= 10;
  }
  return data;
}

/// A sampled axis has a value of its own in nearly every row: it is drawn to scale, not in cells.
export const isScattered = (data: SweepData, axis: Axis): boolean =>
    axis.numeric && axis.values.length > 60 && axis.values.length > data.rows.length / 3;

export const labelOf = (data: SweepData, name: string): string => shownAs(name, data.axes.some((a) => a.key === name)).label;

export const describe = (data: SweepData, row: Row): string =>
    data.axes.map((a) => `${labelOf(data, a.key)}: ${short(valueOf(data, row, a.key))}`).join("\n");

/// What is wrong with a point: it could not be driven, or it does not meet an expectation.
export function faultOf(data: SweepData, row: Row): string {
  if (row.failed) return "could not be driven";
  return row.unmet ? `not met: ${row.unmet.map((i) => data.checks[i].expectation).join("; ")}` : "";
}
