"use strict";

// Clusters of return errors, computed here only where the summary does not hold them (after calibration).

const mean = (values) => values.reduce((a, b) => a + b, 0) / values.length;

function covariance(a, b) {
  const ma = mean(a);
  const mb = mean(b);
  return a.reduce((sum, v, i) => sum + (v - ma) * (b[i] - mb), 0) / (a.length - 1);
}

const hasError = (run) => run.error && isNumber(run.error.x_m) && isNumber(run.error.y_m);

// Same definitions as the summary: sample standard deviations, sd_m the spread along any one axis.
function clusterOf(runs) {
  if (runs.length === 0) return null;
  const x = runs.map((r) => r.error.x_m);
  const y = runs.map((r) => r.error.y_m);
  const theta = runs.map((r) => r.error.theta_rad).filter(isNumber);
  const cluster = {runs: runs.length, centroid_x_m: mean(x), centroid_y_m: mean(y)};
  cluster.r_cg_m = Math.hypot(cluster.centroid_x_m, cluster.centroid_y_m);
  if (theta.length === runs.length) cluster.heading_rad = mean(theta);
  if (runs.length > 1) {
    const xx = covariance(x, x);
    const yy = covariance(y, y);
    cluster.sd_x_m = Math.sqrt(xx);
    cluster.sd_y_m = Math.sqrt(yy);
    cluster.sd_m = Math.sqrt((xx + yy) / 2);
    cluster.standard_error_m = cluster.sd_m / Math.sqrt(runs.length);
    if (isNumber(cluster.heading_rad)) cluster.sd_heading_rad = Math.sqrt(covariance(theta, theta));
    cluster.ellipse = ellipseOf(xx, covariance(x, y), yy);
  }
  return cluster;
}

// One-sigma ellipse of a 2 x 2 covariance: semi-axes and the angle of the first.
function ellipseOf(xx, xy, yy) {
  const half = (xx + yy) / 2;
  const root = Math.hypot((xx - yy) / 2, xy);
  return {
    a_m: Math.sqrt(Math.max(0, half + root)),
    b_m: Math.sqrt(Math.max(0, half - root)),
    angle_rad: Math.atan2(2 * xy, xx - yy) / 2,
  };
}

const runsOf = (data, stage, direction) =>
    data.runs.filter((r) => hasError(r) && r.stage === stage && (!direction || r.direction === direction));

function clustersOf(data, stage) {
  const clusters = {};
  for (const direction of ["cw", "ccw"]) {
    const cluster = clusterOf(runsOf(data, stage, direction));
    if (cluster) clusters[direction] = cluster;
  }
  return clusters;
}

function eMaxOf(clusters) {
  const radii = Object.values(clusters).map((c) => c.r_cg_m).filter(isNumber);
  return radii.length === 2 ? Math.max(...radii) : undefined;
}
