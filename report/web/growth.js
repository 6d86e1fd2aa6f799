"use strict";

// Figure 3: how the error grows along the run.

const wrapAngle = (a) => Math.atan2(Math.sin(a), Math.cos(a));

// Per sample: distance along the true path (m), position error (mm), heading error (deg), total turn calculated (rad).
function errorSeries(run) {
  const series = [];
  let distance = 0;
  let turned = 0;
  for (let i = 0; i < samplesOf(run); ++i) {
    const [t, o] = [run.truth[i], run.odometry[i]];
    if (i > 0) {
      distance += Math.hypot(t[0] - run.truth[i - 1][0], t[1] - run.truth[i - 1][1]);
      turned += wrapAngle(o[2] - run.odometry[i - 1][2]);
    }
    series.push({
      distance,
      turned,
      position: Math.hypot(t[0] - o[0], t[1] - o[1]) * 1000,
      heading: wrapAngle(t[2] - o[2]) * DEG,
    });
  }
  return series;
}

// Distances at which the middle of each 90 degree turn is passed.
function turnDistances(series) {
  const turns = [];
  for (const sample of series) {
    while (Math.abs(sample.turned) > (Math.PI / 2) * (turns.length + 0.5)) turns.push(sample.distance);
  }
  return turns;
}

function setupGrowth(data, section, selection) {
  section.innerHTML = `
    <h2>Figure 3. The error along the way</h2>
    <figure>
      <div class="panels">
        <div class="panel"><p class="panel-title">Position error</p><div class="plot" data-key="position"></div></div>
        <div class="panel"><p class="panel-title">Heading error</p><div class="plot" data-key="heading"></div></div>
      </div>
      <div class="legend-slot"></div>
      <figcaption>${CAPTIONS.growth}</figcaption>
    </figure>`;
  const cache = new Map(data.runs.filter(hasPath).map((run) => [run, errorSeries(run)]));

  function draw() {
    const chosen = Object.values(selection);
    for (const element of section.querySelectorAll(".plot")) {
      element.innerHTML = growthSvg(data, cache, chosen, element.dataset.key, panelWidth(element));
    }
    const name = (run) => `${escapeHtml(run.id)}, ${escapeHtml(stageName(run.stage))}`;
    const items = chosen.map((run) => [lineIcon(`series ${colourClass(run.direction)}`), name(run)]);
    section.querySelector(".legend-slot").innerHTML = legendHtml(items);
  }
  return draw;
}

function growthSvg(data, cache, chosen, key, width) {
  const kind = (run) => `${run.direction}/${run.stage}`;
  const kinds = new Set(chosen.map(kind));
  const shown = [...cache.keys()].filter((run) => kinds.has(kind(run)));
  const values = shown.flatMap((run) => cache.get(run).map((s) => s[key]));
  const plot = new Plot({
    width,
    height: Math.max(240, width * 0.62),
    x: [0, 1.02 * Math.max(0.01, ...shown.map((run) => cache.get(run).at(-1).distance))],
    y: paddedRange(values),
    xLabel: "distance driven (m)",
    yLabel: key === "position" ? "position error (mm)" : "heading error (°)",
  });
  for (const distance of turnDistances(cache.get(chosen[0])))
    plot.line([distance, plot.y[0]], [distance, plot.y[1]], "turn");
  const curve = (run, extra) =>
      plot.path(cache.get(run).map((s) => [s.distance, s[key]]), `series ${colourClass(run.direction)} ${extra}`);
  shown.filter((run) => !chosen.includes(run)).forEach((run) => curve(run, "faint"));
  chosen.forEach((run) => curve(run, ""));
  const ends = chosen.map(
      (run) => `${run.id} ends at ${fixed(cache.get(run).at(-1)[key], 2)} ${key === "position" ? "mm" : "degrees"}`);
  return plot.svg(`${key === "position" ? "Position" : "Heading"} error over the distance driven: ${ends.join(", ")}`);
}

function paddedRange(values) {
  let [low, high] = [0, 0];
  for (const v of values) {
    low = Math.min(low, v);
    high = Math.max(high, v);
  }
  if (high - low < 1e-3) high = 1e-3;
  const pad = (high - low) * 0.06;
  return [low < 0 ? low - pad : 0, high + pad];
}
