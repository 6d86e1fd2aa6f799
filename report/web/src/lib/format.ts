// Numbers and words. The data is SI; the page shows mm and degrees.

import {html, Html} from "./html";

export const DEG = 180 / Math.PI;
export const NONE = "\u2013";

export type Num = number | null | undefined;

export const isNumber = (v: unknown): v is number => typeof v === "number" && Number.isFinite(v);

export const minus = (text: string): string => (/^-0(\.0*)?$/.test(text) ? text.slice(1) : text.replace("-", "\u2212"));

export const fixed = (v: Num, decimals: number): string => (isNumber(v) ? minus(v.toFixed(decimals)) : NONE);

const largest = (values: Num[]): number => Math.max(0, ...values.filter(isNumber).map(Math.abs));

/// As many decimals as say something: 311.0, 8.21, 0.0312.
export function mmDecimals(values_m: Num[]): number {
  const mm = largest(values_m) * 1000;
  return mm >= 10 || mm === 0 ? 1 : mm >= 1 ? 2 : mm >= 0.1 ? 3 : 4;
}

function degDecimals(v_rad: Num): number {
  const deg = largest([v_rad]) * DEG;
  return deg >= 0.01 || deg === 0 ? 3 : 5;
}

export const mm = (v_m: Num, decimals = mmDecimals([v_m])): string => (isNumber(v_m) ? fixed(v_m * 1000, decimals) : NONE);
export const deg = (v_rad: Num, decimals = degDecimals(v_rad)): string =>
    (isNumber(v_rad) ? fixed(v_rad * DEG, decimals) : NONE);
export const mmUnit = (v_m: Num): string => `${mm(v_m)}\u00a0mm`;
export const degUnit = (v_rad: Num): string => (isNumber(v_rad) ? `${deg(v_rad)}°` : NONE);

/// What is given in mm already.
export const millimetres = (v_mm: Num): string => (isNumber(v_mm) ? `${fixed(v_mm, v_mm >= 10 ? 1 : 2)}\u00a0mm` : NONE);
export const degrees = (v_deg: Num): string => (isNumber(v_deg) ? `${fixed(v_deg, 3)}°` : NONE);

export const thousands = (v: Num): string =>
    (isNumber(v) ? Math.round(v).toLocaleString("en").replace(/,/g, "\u202f") : NONE);

export const factor = (v: Num): string => (isNumber(v) ? (v >= 100 ? thousands(v) : fixed(v, 1)) : NONE);

export function signedSmall(v: Num): string {
  if (!isNumber(v)) return NONE;
  if (v === 0) return "0";
  return Math.abs(v) < 1e-4 ? minus(v.toExponential(1)) : fixed(v, 5);
}

/// Shares near all or nothing get another digit.
export function percent(v: Num): string {
  if (!isNumber(v)) return NONE;
  return `${fixed(v * 100, v === 0 || v === 1 ? 0 : Math.min(v, 1 - v) < 0.005 ? 2 : 1)}\u00a0%`;
}

/// Four digits that say something, of a number of any size.
export function short(v: unknown): string {
  if (!isNumber(v)) return typeof v === "string" ? v : NONE;
  if (v === 0) return "0";
  const size = Math.abs(v);
  return minus(size >= 1e5 || size < 1e-3 ? v.toExponential(2) : Number(v.toPrecision(4)).toString());
}

export const plural = (n: number, one: string): string => `${n} ${one}${n === 1 ? "" : "s"}`;
export const words = (name: unknown): string => String(name).replace(/_/g, " ");
export const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

const DIRECTIONS: Record<string, string> = {cw: "clockwise", ccw: "counter-clockwise"};
const STAGES: Record<string, string> = {before: "before calibration", after: "after calibration", bumped: "with cables"};
export const directionName = (d: string): string => DIRECTIONS[d] ?? (d || "run");
export const stageName = (s: string): string => STAGES[s] ?? s;
export const colourClass = (d: string): string => (d === "cw" || d === "ccw" ? d : "other");
export const colour = (d: string): string => `var(--${colourClass(d)})`;

export const E_MAX: Html = html`E<sub>max,syst</sub>`;
