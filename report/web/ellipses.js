"use strict";

// The 95 % ellipses in figure 2. They are moved and enlarged with the error that is shown there, so that the truth lies
// inside an ellipse at any exaggeration or at none.

const ellipsesOf = (run) => (Array.isArray(run.ellipses) ? run.ellipses : []);

const hasEllipses = (data) => data.runs.some((run) => ellipsesOf(run).length > 0);

const hasFixes = (data) => data.runs.some((run) => Array.isArray(run.fixes) && run.fixes.length > 0);

const largestEllipse = (run) => Math.max(0, ...ellipsesOf(run).map((e) => e[2]));

// run.ellipses: [[x, y, a, b, angle, index of the pose in the path], ...]
function ellipsesShown(run, k) {
  return ellipsesOf(run).map(([x, y, a, b, angle_rad, index]) => {
    const o = run.odometry[index];
    return {centre: [o[0] + k * (x - o[0]), o[1] + k * (y - o[1])], a: k * a, b: k * b, angle_rad};
  });
}

// Points that the view must hold.
const ellipseCorners = (run, k) => ellipsesShown(run, k).flatMap(
    ({centre: [x, y], a}) => [[x - a, y - a], [x + a, y + a]]);

function drawEllipses(plot, run, k) {
  for (const e of ellipsesShown(run, k)) plot.ellipse(e.centre, e, `ellipse ${colourClass(run.direction)}`);
}

const fixSvg = (x, y) => `<path class="fix" d="M${px(x)} ${px(y - 7)}L${px(x + 7)} ${px(y)}L${px(x)} ${px(y + 7)}L${
    px(x - 7)} ${px(y)}Z"><title>absolute fix</title></path>`;

// truth: the path as shown
function drawFixes(plot, run, truth) {
  for (const index of run.fixes || []) plot.add(fixSvg(plot.px(truth[index][0]), plot.py(truth[index][1])));
}

function ellipseLegend(data, direction) {
  const icon = (width, height, svg) => `<svg width="${width}" height="${height}" aria-hidden="true">${svg}</svg>`;
  const ellipse = `<ellipse class="ellipse ${colourClass(direction)}" cx="12" cy="7" rx="11" ry="6"/>`;
  const items = [];
  if (hasEllipses(data)) items.push([icon(24, 14, ellipse), "95 % ellipse"]);
  if (hasFixes(data)) items.push([icon(16, 16, fixSvg(8, 8)), "absolute fix"]);
  return items;
}
