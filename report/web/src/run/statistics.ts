// Clusters of return errors, computed here only where the summary does not hold them (after calibration).

import {isNumber} from "../lib/format";
import {ofKind, type Run, type RunData} from "./data";

export interface Ellipse {
  a_m: number;
  b_m: number;
  angle_rad: number;
}

export interface Cluster {
  runs: number;
  centroid_x_m: number;
  centroid_y_m: number;
  r_cg_m: number;
  heading_rad?: number;
  sd_x_m?: number;
  sd_y_m?: number;
  sd_m?: number;
  standard_error_m?: number;
  sd_heading_rad?: number;
  ellipse?: Ellipse;
}

export const mean = (values: number[]): number => values.reduce((a, b) => a + b, 0) / values.length;

function covariance(a: number[], b: number[]): number {
  const [ma, mb] = [mean(a), mean(b)];
  return a.reduce((sum, v, i) => sum + (v - ma) * (b[i] - mb), 0) / (a.length - 1);
}

/// One-sigma ellipse of a 2 x 2 covariance: semi-axes and the angle of the first.
function ellipseOf(xx: number, xy: number, yy: number): Ellipse {
  const half = (xx + yy) / 2;
  const root = Math.hypot((xx - yy) / 2, xy);
  return {a_m: Math.sqrt(Math.max(0, half + root)), b_m: Math.sqrt(Math.max(0, half - root)), angle_rad: Math.atan2(2 * xy, xx - yy) / 2};
}

/// Same definitions as the summary: sample standard deviations, sd_m the spread along any one axis.
export function clusterOf(runs: Run[]): Cluster | null {
  if (!runs.length) return null;
  const [x, y, theta] = (["x_m", "y_m", "theta_rad"] as const).map((key) => runs.map((r) => r.error![key]));
  const [cx, cy] = [mean(x), mean(y)];
  const cluster: Cluster = {runs: runs.length, centroid_x_m: cx, centroid_y_m: cy, r_cg_m: Math.hypot(cx, cy)};
  if (theta.every(isNumber)) cluster.heading_rad = mean(theta);
  if (runs.length > 1) {
    const [xx, yy] = [covariance(x, x), covariance(y, y)];
    Object.assign(cluster, {sd_x_m: Math.sqrt(xx), sd_y_m: Math.sqrt(yy), sd_m: Math.sqrt((xx + yy) / 2)});
    cluster.standard_error_m = cluster.sd_m! / Math.sqrt(runs.length);
    if (isNumber(cluster.heading_rad)) cluster.sd_heading_rad = Math.sqrt(covariance(theta, theta));
    cluster.ellipse = ellipseOf(xx, covariance(x, y), yy);
  }
  return cluster;
}

export function clustersOf(data: RunData, stage: string): Partial<Record<"cw" | "ccw", Cluster>> {
  const clusters: Partial<Record<"cw" | "ccw", Cluster>> = {};
  for (const direction of ["cw", "ccw"] as const) {
    const cluster = clusterOf(ofKind(data, stage, direction));
    if (cluster) clusters[direction] = cluster;
  }
  return clusters;
}

export function eMaxOf(clusters: Partial<Record<string, Cluster>>): number | undefined {
  const radii = Object.values(clusters).map((c) => c?.r_cg_m).filter(isNumber);
  return radii.length === 2 ? Math.max(...radii) : undefined;
}

export function worst(clusters: Partial<Record<string, {r_cg_m?: number}>>): string | undefined {
  if (!clusters?.cw || !clusters.ccw) return undefined;
  return clusters.cw.r_cg_m! >= clusters.ccw.r_cg_m! ? "cw" : "ccw";
}

/// Points of an ellipse about a centre.
export function outline([x, y]: number[], a: number, b: number, angle: number, points = 48): [number, number][] {
  return Array.from({length: points + 1}, (_, i) => {
    const t = (2 * Math.PI * i) / points;
    const [u, v] = [a * Math.cos(t), b * Math.sin(t)];
    return [x + u * Math.cos(angle) - v * Math.sin(angle), y + u * Math.sin(angle) + v * Math.cos(angle)];
  });
}
