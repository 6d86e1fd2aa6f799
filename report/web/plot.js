"use strict";

// A plot is a string of SVG: linear axes with grid, ticks and labels around `body`.

function niceStep(span, count) {
  const raw = span / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const unit = [1, 2, 5, 10].find((u) => u * power >= raw * 0.999);
  return unit * power;
}

function niceTicks([low, high], count) {
  const step = niceStep(high - low, count);
  const decimals = Math.min(20, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) {
    ticks.push({value: i * step, text: minus((i * step).toFixed(decimals))});
  }
  return ticks;
}

const px = (v) => (Math.round(v * 100) / 100).toString();

let plotCount = 0;

class Plot {
  // options: width, height, x: [low, high], y: [low, high], xLabel, yLabel; xTicks, yTicks where round numbers do not do
  constructor(options) {
    Object.assign(this, options);
    const ticks = options.yTicks || niceTicks(this.y, Math.max(4, Math.round(this.height / 70)));
    const digits = Math.max(1, ...ticks.map((t) => t.text.length));
    this.yTicks = ticks;
    this.left = 30 + 7 * digits;
    this.right = this.width - 14;
    this.top = 10;
    this.bottom = this.height - 42;
    this.body = "";
  }

  // Equal scale on both axes: the plot area is as wide as high; ranges of equal span are asked for.
  static square(options) {
    const plot = new Plot({...options, height: options.width});
    plot.height = plot.right - plot.left + plot.top + 42;
    plot.bottom = plot.height - 42;
    return plot;
  }

  px(x) {
    return this.left + ((x - this.x[0]) / (this.x[1] - this.x[0])) * (this.right - this.left);
  }

  py(y) {
    return this.bottom - ((y - this.y[0]) / (this.y[1] - this.y[0])) * (this.bottom - this.top);
  }

  // Pixels per unit of x.
  get scale() {
    return (this.right - this.left) / (this.x[1] - this.x[0]);
  }

  add(svg) {
    this.body += svg;
  }

  line(a, b, cssClass) {
    this.add(
        `<line class="${cssClass}" x1="${px(this.px(a[0]))}" y1="${px(this.py(a[1]))}" ` +
        `x2="${px(this.px(b[0]))}" y2="${px(this.py(b[1]))}"/>`);
  }

  path(points, cssClass) {
    if (points.length < 2) return;
    const d = points.map((p, i) => `${i ? "L" : "M"}${px(this.px(p[0]))} ${px(this.py(p[1]))}`).join("");
    this.add(`<path class="${cssClass}" d="${d}"/>`);
  }

  circle(centre, radius, cssClass) {
    this.add(
        `<circle class="${cssClass}" cx="${px(this.px(centre[0]))}" cy="${px(this.py(centre[1]))}" ` +
        `r="${px(radius * this.scale)}"/>`);
  }

  ellipse(centre, ellipse, cssClass) {
    const x = px(this.px(centre[0]));
    const y = px(this.py(centre[1]));
    this.add(
        `<ellipse class="${cssClass}" cx="${x}" cy="${y}" rx="${px(ellipse.a * this.scale)}" ` +
        `ry="${px(ellipse.b * this.scale)}" transform="rotate(${px(-ellipse.angle_rad * DEG)} ${x} ${y})"/>`);
  }

  marker(point, direction, stage, title) {
    this.add(markerSvg(this.px(point[0]), this.py(point[1]), direction, stage, title));
  }

  cross(point) {
    const x = this.px(point[0]);
    const y = this.py(point[1]);
    const d = `M${px(x - 7)} ${px(y)}H${px(x + 7)}M${px(x)} ${px(y - 7)}V${px(y + 7)}`;
    this.add(`<path class="centroid-halo" d="${d}"/><path class="centroid" d="${d}"/>`);
  }

  // SVG text at a point, moved so that it stays inside the axes; `length` characters wide.
  label(point, text, length) {
    const half = length * 3.4;
    const x = Math.min(this.right - half - 4, Math.max(this.left + half + 4, this.px(point[0])));
    const y = Math.min(this.bottom - 6, Math.max(this.top + 14, this.py(point[1]) + 4));
    this.add(`<text class="note-label" text-anchor="middle" x="${px(x)}" y="${px(y)}">${text}</text>`);
  }

  axes() {
    let svg = "";
    const css = (tick) => (tick.value === 0 ? "zero" : "grid");
    const area = {left: px(this.left), right: px(this.right), top: px(this.top), bottom: px(this.bottom)};
    for (const tick of this.xTicks || niceTicks(this.x, Math.max(4, Math.round((this.right - this.left) / 70)))) {
      const x = px(this.px(tick.value));
      svg += `<line class="${css(tick)}" x1="${x}" x2="${x}" y1="${area.top}" y2="${area.bottom}"/>`;
      svg += `<text text-anchor="middle" x="${x}" y="${px(this.bottom + 16)}">${tick.text}</text>`;
    }
    for (const tick of this.yTicks) {
      const y = this.py(tick.value);
      svg += `<line class="${css(tick)}" x1="${area.left}" x2="${area.right}" y1="${px(y)}" y2="${px(y)}"/>`;
      svg += `<text text-anchor="end" x="${px(this.left - 6)}" y="${px(y + 4)}">${tick.text}</text>`;
    }
    const x = px((this.left + this.right) / 2);
    const y = px((this.top + this.bottom) / 2);
    const label = 'class="axis-label" text-anchor="middle"';
    svg += `<text ${label} x="${x}" y="${px(this.height - 6)}">${this.xLabel}</text>`;
    svg += `<text ${label} transform="translate(13 ${y}) rotate(-90)">${this.yLabel}</text>`;
    return svg;
  }

  svg(description) {
    const clip = `clip-${++plotCount}`;
    const area =
        `x="${this.left}" y="${this.top}" width="${px(this.right - this.left)}" height="${px(this.bottom - this.top)}"`;
    return (
        `<svg role="img" aria-label="${escapeHtml(description)}" viewBox="0 0 ${px(this.width)} ${px(this.height)}" ` +
        `width="${px(this.width)}"><clipPath id="${clip}"><rect ${area}/></clipPath>${this.axes()}` +
        `<rect class="frame" ${area}/><g clip-path="url(#${clip})">${this.body}</g></svg>`);
  }
}

// cw: circle, ccw: triangle, others: square. Hollow before, filled after calibration.
function markerSvg(x, y, direction, stage, title = "") {
  const cssClass = `class="pt ${colourClass(direction)} ${escapeHtml(stage)}"`;
  const inner = title ? `<title>${escapeHtml(title)}</title>` : "";
  if (direction === "cw") return `<circle ${cssClass} cx="${px(x)}" cy="${px(y)}" r="4.6">${inner}</circle>`;
  if (direction === "ccw") {
    const d = `M${px(x)} ${px(y - 5.8)}L${px(x + 5.4)} ${px(y + 4)}H${px(x - 5.4)}Z`;
    return `<path ${cssClass} d="${d}">${inner}</path>`;
  }
  return `<rect ${cssClass} x="${px(x - 4)}" y="${px(y - 4)}" width="8" height="8">${inner}</rect>`;
}

const markerIcon = (direction, stage) =>
    `<svg class="swatch" width="14" height="14" aria-hidden="true">${markerSvg(7, 7, direction, stage)}</svg>`.replace(
        'class="pt ', 'class="icon pt ');

const lineIcon = (cssClass) =>
    `<svg width="30" height="12" aria-hidden="true"><line class="${cssClass}" x1="1" y1="6" x2="29" y2="6"/></svg>`;

const legendHtml = (items) =>
    `<ul class="legend">${items.map(([icon, text]) => `<li>${icon}<span>${text}</span></li>`).join("")}</ul>`;

const panelWidth = (element) => Math.max(260, Math.min(640, element.clientWidth || 480));
