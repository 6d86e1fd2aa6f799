"use strict";

// A figure over two axes: coloured cells on a grid, coloured points of a sampled design.

// Viridis (Smith & van der Walt 2015), and for two signs blue - pale - orange.
const SEQUENTIAL = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
const DIVERGING = [[5, 80, 140], [110, 170, 210], [240, 240, 235], [240, 160, 100], [170, 60, 5]];

function ramp(stops, share) {
  const place = Math.min(1, Math.max(0, share)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(place));
  const mix = stops[i].map((c, k) => Math.round(c + (place - i) * (stops[i + 1][k] - c)));
  return `rgb(${mix.join(",")})`;
}

// Colours of the values: of their sizes on a logarithmic scale, or evenly; symmetric about 0 where both signs occur.
function colourScale(values, logarithmic) {
  if (logarithmic) {
    const sizes = values.map(Math.abs).filter((v) => v > 0);
    const high = Math.max(...sizes, 1e-300);
    const low = Math.max(Math.min(...sizes, high), high * 1e-9);
    const span = Math.log(high / low) || 1;
    const share = (v) => (Math.abs(v) <= low ? 0 : Math.log(Math.abs(v) / low) / span);
    return {low, high, colour: (v) => ramp(SEQUENTIAL, share(v)), at: (s) => low * Math.exp(s * span)};
  }
  let [low, high] = [Math.min(...values), Math.max(...values)];
  const both = low < 0 && high > 0;
  if (both) [low, high] = [-Math.max(-low, high), Math.max(-low, high)];
  const span = high - low || 1;
  const stops = both ? DIVERGING : SEQUENTIAL;
  return {low, high, colour: (v) => ramp(stops, (v - low) / span), at: (s) => low + s * span};
}

function colourBar(scale, x, top, height) {
  const steps = 48;
  let svg = "";
  for (let i = 0; i < steps; ++i) {
    const y = top + height * (1 - (i + 1) / steps);
    svg += `<rect x="${px(x)}" y="${px(y)}" width="14" height="${px(height / steps + 0.6)}" ` +
        `fill="${scale.colour(scale.at((i + 0.5) / steps))}"/>`;
  }
  for (const share of [0, 0.25, 0.5, 0.75, 1]) {
    svg += `<text x="${px(x + 19)}" y="${px(top + height * (1 - share) + 4)}">${short(scale.at(share))}</text>`;
  }
  return svg;
}

const faultMark = (x, y, size, cell) => {
  if (cell.failed) {
    const h = Math.min(size / 2, 7);
    const d = `M${px(x - h)} ${px(y - h)}L${px(x + h)} ${px(y + h)}M${px(x - h)} ${px(y + h)}L${px(x + h)} ${px(y - h)}`;
    return `<path class="fault-halo" d="${d}"/><path class="fault" d="${d}"/>`;
  }
  if (!cell.unmet) return "";
  const r = Math.max(1.6, Math.min(size / 5, 5));
  return `<circle class="unmet" cx="${px(x)}" cy="${px(y)}" r="${px(r)}"/>`;
};

// Every k-th label, so that they do not touch.
function thinLabels(values, length, room) {
  const stride = Math.max(1, Math.ceil(room / (length / values.length)));
  return values.map((v, i) => (i % stride === 0 ? short(v) : ""));
}

const longest = (texts) => Math.max(...texts.map((t) => t.length));

function cellMapSvg(data, rows, view, width) {
  const [xAxis, yAxis] = [axisOf(data, view.x), axisOf(data, view.y)];
  const groups = groupBy(rows, (row) => JSON.stringify([valueOf(data, row, view.x), valueOf(data, row, view.y)]));
  const cells = new Map([...groups].map(([key, list]) => [key, cellOf(data, list, view.figure)]));
  const values = [...cells.values()].map((c) => c.value).filter(isNumber);
  const scale = colourScale(values.length ? values : [0], view.log);
  const yTexts = yAxis.values.map(short);
  const left = 34 + 7 * longest(yTexts);
  const right = width - 104;
  const height = Math.max(180, Math.min(520, (right - left) * Math.min(1.1, Math.max(0.25, yAxis.values.length / xAxis.values.length))));
  const [w, h] = [(right - left) / xAxis.values.length, height / yAxis.values.length];
  const top = 10;
  let body = "";
  let marks = "";
  xAxis.values.forEach((x, i) => yAxis.values.forEach((y, j) => {
    const cell = cells.get(JSON.stringify([x, y]));
    if (!cell) return;
    const [cx, cy] = [left + i * w, top + height - (j + 1) * h];
    const fill = isNumber(cell.value) ? scale.colour(cell.value) : "none";
    const faults = cell.rows.map((row) => faultOf(data, row)).filter(Boolean);
    const text = `${view.x} = ${short(x)}, ${view.y} = ${short(y)}: ${short(cell.value)} ${unitOf(view.figure).unit}` +
        `${cell.rows.length > 1 ? `, mean of ${cell.rows.length} points` : `, point ${cell.rows[0].point}`}` +
        `${faults.length ? `; ${faults[0]}` : ""}`;
    body += `<rect class="cell" x="${px(cx)}" y="${px(cy)}" width="${px(w + 0.4)}" height="${px(h + 0.4)}" ` +
        `fill="${fill}"><title>${escapeHtml(text)}</title></rect>`;
    marks += faultMark(cx + w / 2, cy + h / 2, Math.min(w, h), cell);
  }));
  const xLabels = thinLabels(xAxis.values, right - left, 7.2 * longest(xAxis.values.map(short)) + 8);
  const yLabels = thinLabels(yAxis.values, height, 16);
  xLabels.forEach((t, i) => {
    body += `<text text-anchor="middle" x="${px(left + (i + 0.5) * w)}" y="${px(top + height + 17)}">${escapeHtml(t)}</text>`;
  });
  yLabels.forEach((t, j) => {
    body += `<text text-anchor="end" x="${px(left - 6)}" y="${px(top + height - (j + 0.5) * h + 4)}">${escapeHtml(t)}</text>`;
  });
  const label = 'class="axis-label" text-anchor="middle"';
  body += `<text ${label} x="${px((left + right) / 2)}" y="${px(top + height + 36)}">${escapeHtml(view.x)}</text>`;
  body += `<text ${label} transform="translate(13 ${px(top + height / 2)}) rotate(-90)">${escapeHtml(view.y)}</text>`;
  const aria = escapeHtml(`${view.figure} over ${view.x} and ${view.y}, from ${short(scale.low)} to ${short(scale.high)}`);
  const bar = colourBar(scale, right + 16, top, height);
  return `<svg role="img" aria-label="${aria}" viewBox="0 0 ${px(width)} ${px(top + height + 44)}" width="${px(width)}">` +
      `${body}<rect class="frame" x="${px(left)}" y="${top}" width="${px(right - left)}" height="${px(height)}"/>` +
      `${marks}${bar}</svg>`;
}

const positionOn = (axis) => (v) => (axis.log ? Math.log10(v) : v);

// An axis to scale: its range with a margin, and ticks at round values where it is logarithmic.
function rangeOf(axis) {
  const position = positionOn(axis);
  const [low, high] = [position(axis.values[0]), position(axis.values[axis.values.length - 1])];
  const pad = (high - low || Math.abs(low) || 1) * 0.04;
  return [low - pad, high + pad];
}

function logTicks([low, high]) {
  const ticks = [];
  const units = high - low > 3 ? [1] : high - low > 1.2 ? [1, 3] : [1, 2, 5];
  for (let power = Math.floor(low); power <= high; ++power) {
    for (const unit of units) {
      const value = power + Math.log10(unit);
      if (value >= low && value <= high) ticks.push({value, text: short(unit * 10 ** power)});
    }
  }
  return ticks;
}

const ticksOf = (axis, range) => (axis.log ? logTicks(range) : undefined);

function scatterMapSvg(data, rows, view, width) {
  const [xAxis, yAxis] = [axisOf(data, view.x), axisOf(data, view.y)];
  const cells = rows.map((row) => cellOf(data, [row], view.figure));
  const values = cells.map((c) => c.value).filter(isNumber);
  const scale = colourScale(values.length ? values : [0], view.log);
  const [x, y] = [rangeOf(xAxis), rangeOf(yAxis)];
  const plot = new Plot({
    width: width - 90, height: Math.max(260, width * 0.6), x, y, xTicks: ticksOf(xAxis, x), yTicks: ticksOf(yAxis, y),
    xLabel: escapeHtml(view.x), yLabel: escapeHtml(view.y),
  });
  for (const cell of cells) {
    const row = cell.rows[0];
    const [cx, cy] = [plot.px(positionOn(xAxis)(valueOf(data, row, view.x))),
                      plot.py(positionOn(yAxis)(valueOf(data, row, view.y)))];
    const text = `${describeRow(data, row)}: ${short(cell.value)} ${unitOf(view.figure).unit} ${faultOf(data, row)}`;
    const fill = isNumber(cell.value) ? scale.colour(cell.value) : "none";
    plot.add(`<circle class="sample" cx="${px(cx)}" cy="${px(cy)}" r="5" fill="${fill}"><title>${escapeHtml(text)}</title>` +
             `</circle>${faultMark(cx, cy, 10, cell)}`);
  }
  const svg = plot.svg(`${view.figure} over ${view.x} and ${view.y}`);
  const bar = colourBar(scale, width - 84, plot.top, plot.bottom - plot.top);
  return svg.replace(/width="[\d.]+">/, `width="${px(width)}">`)
      .replace(/viewBox="0 0 [\d.]+ /, `viewBox="0 0 ${px(width)} `)
      .replace(/<\/svg>$/, `${bar}</svg>`);
}
