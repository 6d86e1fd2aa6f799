"use strict";

// Figure 2: driven paths, truth against odometry, with the error exaggerated.

const hasPath = (run) => [run.truth, run.odometry].every((path) => Array.isArray(path) && path.length > 1);

const samplesOf = (run) => Math.min(run.truth.length, run.odometry.length);

// Truth as shown: odometry + k (truth - odometry).
function exaggerated(run, k) {
  const shown = [];
  for (let i = 0; i < samplesOf(run); ++i) {
    const [t, o] = [run.truth[i], run.odometry[i]];
    shown.push([o[0] + k * (t[0] - o[0]), o[1] + k * (t[1] - o[1]), o[2] + k * (t[2] - o[2])]);
  }
  return shown;
}

function largestError(run) {
  let error = 0;
  for (let i = 0; i < samplesOf(run); ++i) {
    error = Math.max(error, Math.hypot(run.truth[i][0] - run.odometry[i][0], run.truth[i][1] - run.odometry[i][1]));
  }
  return error;
}

// The largest factor up to 20 that keeps the shown error below an eighth of the course.
function defaultExaggeration(runs) {
  const size = Math.max(...runs.map((r) => boundsSpan(boundsOf(r.odometry))));
  const error = Math.max(1e-9, ...runs.map((r) => Math.max(largestError(r), largestEllipse(r))));
  return Math.max(1, Math.min(20, Math.floor(size / 8 / error)));
}

function boundsOf(points) {
  const b = [Infinity, -Infinity, Infinity, -Infinity];
  for (const [x, y] of points) {
    b[0] = Math.min(b[0], x);
    b[1] = Math.max(b[1], x);
    b[2] = Math.min(b[2], y);
    b[3] = Math.max(b[3], y);
  }
  return b;
}

const boundsSpan = (b) => Math.max(b[1] - b[0], b[3] - b[2]);

const directionsWithPaths = (data) => [...new Set(data.runs.filter(hasPath).map((r) => r.direction))];

// selection: {direction: run}, shared with figure 3.
function setupPaths(data, section, selection, onChange) {
  const directions = directionsWithPaths(data);
  let k = defaultExaggeration(Object.values(selection));
  section.innerHTML = `
    <h2>Figure 2. Driven paths</h2>
    <figure>
      <div class="controls"><label>Error shown
        <input type="range" min="1" max="20" step="1" value="${k}" aria-label="Exaggeration of the error"
               aria-describedby="exaggeration-help"><output></output></label></div>
      <div class="panels">${directions.map(panel).join("")}</div>
      ${legendHtml(pathLegend(data, directions))}
      <figcaption id="exaggeration-help">${CAPTIONS.paths}${hasEllipses(data) ? CAPTIONS.ellipses : ""}</figcaption>
    </figure>`;

  function panel(direction) {
    const options = data.runs.filter((r) => hasPath(r) && r.direction === direction);
    const rows = options.map((r) => {
      const selected = r === selection[direction] ? "selected" : "";
      const text = `${escapeHtml(r.id)}, ${escapeHtml(stageName(r.stage))}`;
      return `<option value="${data.runs.indexOf(r)}" ${selected}>${text}</option>`;
    });
    return `<div class="panel ${directions.length === 1 ? "alone" : ""}" data-direction="${escapeHtml(direction)}">
      <label>Run <select aria-label="${escapeHtml(directionName(direction))} run">${rows.join("")}</select></label>
      <p class="panel-title"></p><div class="plot"></div></div>`;
  }

  function draw() {
    section.querySelector("output").textContent = `\u00d7${k}`;
    section.querySelector("input").setAttribute("aria-valuetext", `${k} times`);
    const views = Object.values(selection).map(
        (run) => boundsOf(
            [...run.odometry, ...exaggerated(run, k), ...bumpsShown(data, run, k), ...ellipseCorners(run, k)]));
    const span = Math.max(...views.map(boundsSpan), 0.01) * 1.1;
    for (const element of section.querySelectorAll(".panel")) {
      const run = selection[element.dataset.direction];
      const plot = element.querySelector(".plot");
      element.querySelector(".panel-title").innerHTML = returnErrorText(run);
      plot.innerHTML = pathSvg(data, run, k, span, panelWidth(plot));
    }
  }

  section.addEventListener("input", (event) => {
    if (event.target.type === "range")
      k = Number(event.target.value);
    else
      selection[event.target.closest(".panel").dataset.direction] = data.runs[Number(event.target.value)];
    draw();
    if (event.target.type !== "range") onChange();
  });
  return draw;
}

function returnErrorText(run) {
  const name = directionName(run.direction);
  const error = hasError(run) ?
      `: return error ${mmUnit(Math.hypot(run.error.x_m, run.error.y_m))}, ${degUnit(run.error.theta_rad)}` :
      "";
  return `${escapeHtml(name[0].toUpperCase() + name.slice(1))}<span class="muted">${error}</span>`;
}

// Index of the pose whose wheel is nearest to the point: half a wheelbase aside, neither ahead nor behind.
function poseAt(path, x, y, wheelbase) {
  let least = Infinity;
  let index = 0;
  path.forEach((pose, i) => {
    const [dx, dy] = [x - pose[0], y - pose[1]];
    const ahead = dx * Math.cos(pose[2]) + dy * Math.sin(pose[2]);
    const aside = Math.abs(dy * Math.cos(pose[2]) - dx * Math.sin(pose[2]));
    const cost = Math.hypot(ahead, aside - wheelbase / 2);
    if (cost < least) [least, index] = [cost, i];
  });
  return index;
}

// A bump lies on the true floor; it is shown moved like the true path there. [x, y, heading]
function bumpsShown(data, run, k) {
  return data.bumps.filter((b) => b.run === run.id && isNumber(b.x_m) && isNumber(b.y_m)).map((b) => {
    const i = poseAt(run.truth.slice(0, samplesOf(run)), b.x_m, b.y_m, data.wheelbase_m || 0);
    const [t, o] = [run.truth[i], run.odometry[i]];
    return [b.x_m + (k - 1) * (t[0] - o[0]), b.y_m + (k - 1) * (t[1] - o[1]), t[2]];
  });
}

function pathSvg(data, run, k, span, width) {
  const truth = exaggerated(run, k);
  const odometry = run.odometry.slice(0, truth.length);
  const bumps = bumpsShown(data, run, k);
  const b = boundsOf([...truth, ...odometry, ...bumps, ...ellipseCorners(run, k)]);
  const [cx, cy] = [(b[0] + b[1]) / 2, (b[2] + b[3]) / 2];
  const plot = Plot.square({
    width,
    x: [cx - span / 2, cx + span / 2],
    y: [cy - span / 2, cy + span / 2],
    xLabel: "x (m)",
    yLabel: "y (m)",
  });
  const [end, calculated] = [truth[truth.length - 1], odometry[odometry.length - 1]];
  drawEllipses(plot, run, k);
  plot.path(odometry, "odometry");
  plot.path(truth, `truth ${colourClass(run.direction)}`);
  bumps.forEach((bump) => drawBump(plot, bump));
  drawFixes(plot, run, truth);
  plot.line(calculated, end, "gap-line");
  drawRobot(plot, odometry[0]);
  drawEnd(plot, calculated, "end calculated");
  drawEnd(plot, end, `end ${colourClass(run.direction)}`);
  return plot.svg(
      `Path of run ${run.id}, truth solid against odometry dashed, in metres, error shown ${k} times` +
      (bumps.length ? `, ${plural(bumps.length, "bump")} marked` : ""));
}

function drawRobot(plot, pose) {
  const at = `translate(${px(plot.px(pose[0]))} ${px(plot.py(pose[1]))}) rotate(${px(-pose[2] * DEG)})`;
  plot.add(`<path class="robot" transform="${at}" d="M10 0L-5 5.5L-2 0L-5 -5.5Z"><title>start</title></path>`);
}

function drawEnd(plot, pose, cssClass) {
  plot.add(`<circle class="${cssClass}" cx="${px(plot.px(pose[0]))}" cy="${px(plot.py(pose[1]))}" r="4.2"/>`);
}

function drawBump(plot, [x, y, heading]) {
  const at = `translate(${px(plot.px(x))} ${px(plot.py(y))}) rotate(${px(-heading * DEG)})`;
  plot.add(`<line class="bump" transform="${at}" x1="0" x2="0" y1="-4.5" y2="4.5"/>`);
}

function pathLegend(data, directions) {
  const dot = (cssClass) =>
      `<svg width="12" height="12" aria-hidden="true"><circle class="${cssClass}" cx="6" cy="6" r="4.2"/></svg>`;
  const arrow = '<path class="robot" transform="translate(6 7)" d="M10 0L-5 5.5L-2 0L-5 -5.5Z"/>';
  const robot = `<svg width="18" height="14" aria-hidden="true">${arrow}</svg>`;
  const bump = '<svg width="8" height="14" aria-hidden="true"><line class="bump" x1="4" x2="4" y1="2" y2="12"/></svg>';
  const items = directions.map((d) => [lineIcon(`truth ${colourClass(d)}`), `truth, ${escapeHtml(d)}`]);
  items.push(
      [lineIcon("odometry"), "odometry"], [robot, "start"], [dot(`end ${colourClass(directions[0])}`), "true end"],
      [dot("end calculated"), "calculated end"]);
  if (data.bumps.length) items.push([bump, "bump"]);
  items.push(...ellipseLegend(data, directions[0]));
  return items;
}
