"use strict";

// A figure over one axis, a curve for each value of another.

const kCurveColours = ["#0067a5", "#c2500a", "#0b6e5f", "#a0387c", "#7a6a00", "#4a4ab8", "#b02030", "#3a7d1a"];

function curveOf(data, rows, view) {
  const xAxis = axisOf(data, view.x);
  const position = xAxis.numeric ? positionOn(xAxis) : (v) => xAxis.values.indexOf(v);
  const groups = [...groupBy(rows, (row) => valueOf(data, row, view.x))];
  const points = groups.map(([x, list]) => ({x, at: position(x), cell: cellOf(data, list, view.figure)}));
  return points.sort((a, b) => a.at - b.at);
}

// The ticks of an axis of names.
const nameTicks = (axis) => axis.values.map((v, i) => ({value: i, text: escapeHtml(short(v))}));

function curvesSvg(data, rows, view, width) {
  const xAxis = axisOf(data, view.x);
  const series = [...groupBy(rows, (row) => (view.y ? valueOf(data, row, view.y) : ""))];
  const size = (v) => (view.log ? Math.log10(Math.abs(v)) : v);
  const drawable = (v) => isNumber(v) && (!view.log || v !== 0);
  const curves = series.map(([, list]) => curveOf(data, list, view));
  const values = curves.flat().map((p) => p.cell.value).filter(drawable).map(size);
  const span = values.length ? [Math.min(...values), Math.max(...values)] : [0, 1];
  const pad = (span[1] - span[0] || Math.abs(span[0]) || 1) * 0.07;
  const y = [span[0] - pad, span[1] + pad];
  const x = xAxis.numeric ? rangeOf(xAxis) : [-0.5, xAxis.values.length - 0.5];
  const plot = new Plot({
    width, height: Math.max(260, width * 0.55), x, y,
    xTicks: xAxis.numeric ? ticksOf(xAxis, x) : nameTicks(xAxis),
    yTicks: view.log ? logTicks(y) : undefined,
    xLabel: escapeHtml(view.x),
    yLabel: escapeHtml(view.log ? `|${withUnit(view.figure)}|` : withUnit(view.figure)),
  });
  curves.forEach((curve, i) => {
    const colour = kCurveColours[i % kCurveColours.length];
    const shown = curve.filter((p) => drawable(p.cell.value));
    const path = shown.map((p, k) => `${k ? "L" : "M"}${px(plot.px(p.at))} ${px(plot.py(size(p.cell.value)))}`).join("");
    if (shown.length > 1) plot.add(`<path class="curve" style="stroke:${colour}" d="${path}"/>`);
    for (const p of curve) plot.add(curvePoint(data, view, plot, p, size, drawable, colour));
  });
  return plot.svg(`${view.figure} over ${view.x}${view.y ? `, a curve for each ${view.y}` : ""}`);
}

function curvePoint(data, view, plot, p, size, drawable, colour) {
  const at = plot.px(p.at);
  if (!drawable(p.cell.value)) return p.cell.failed ? faultMark(at, plot.bottom - 9, 12, p.cell) : "";
  const faults = p.cell.rows.map((row) => faultOf(data, row)).filter(Boolean);
  const text = `${describeRow(data, p.cell.rows[0])}: ${short(p.cell.value)} ${unitOf(view.figure).unit} ${faults[0] || ""}`;
  const y = plot.py(size(p.cell.value));
  const dot = `<circle cx="${px(at)}" cy="${px(y)}" r="3.6" style="fill:${colour}"><title>${escapeHtml(text)}</title></circle>`;
  const ring = p.cell.unmet ? `<circle class="unmet-ring" cx="${px(at)}" cy="${px(y)}" r="6.5"/>` : "";
  return dot + ring + (p.cell.failed ? faultMark(at, y, 14, p.cell) : "");
}

function curvesLegend(data, rows, view) {
  if (!view.y) return "";
  const series = [...groupBy(rows, (row) => valueOf(data, row, view.y)).keys()];
  return legendHtml(series.map((v, i) => {
    const line = `<line x1="1" y1="6" x2="29" y2="6" stroke-width="2.2" style="stroke:${kCurveColours[i % kCurveColours.length]}"/>`;
    return [`<svg width="30" height="12" aria-hidden="true">${line}</svg>`, `${escapeHtml(view.y)} = ${escapeHtml(short(v))}`];
  }));
}
