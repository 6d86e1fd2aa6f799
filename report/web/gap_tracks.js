"use strict";

// Figure 1 of a diagnosis: every run as recorded and as predicted, with the errors exaggerated.

// A prediction as shown: recorded + k (predicted - recorded).
const gapShown = (run, track, k) => track.map((p, i) => {
  const r = run.recorded[Math.min(i, run.recorded.length - 1)];
  return [r[0] + k * (p[0] - r[0]), r[1] + k * (p[1] - r[1])];
});

const gapError = (run) => Math.max(...run.before.map((p, i) => Math.hypot(p[0] - run.recorded[i][0], p[1] - run.recorded[i][1])));

function gapBounds(points) {
  const xs = points.map((p) => p[0]);
  const ys = points.map((p) => p[1]);
  return [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
}

const gapSpan = (b) => Math.max(b[1] - b[0], b[3] - b[2], 0.01);

// Share of the highest score that a part has.
const gapShare = (data, part) => part.score / Math.max(...data.runs.flatMap((r) => r.parts.map((p) => p.score)), 1e-9);

function gapRunSvg(data, run, k, width) {
  const before = gapShown(run, run.before, k);
  const after = run.after ? gapShown(run, run.after, k) : [];
  const place = data.diagnosis.where.place_m;
  const b = gapBounds([...run.recorded, ...before, ...after, ...(place ? [place] : [])]);
  const half = gapSpan(b) * 0.58;
  const [cx, cy] = [(b[0] + b[1]) / 2, (b[2] + b[3]) / 2];
  const plot = Plot.square({width, x: [cx - half, cx + half], y: [cy - half, cy + half], xLabel: "x (m)", yLabel: "y (m)"});
  for (const part of run.parts) {
    const line = run.recorded.slice(part.from, part.to + 1);
    const d = line.map((p, i) => `${i ? "L" : "M"}${px(plot.px(p[0]))} ${px(plot.py(p[1]))}`).join("");
    const opacity = (0.25 + 0.6 * gapShare(data, part)).toFixed(2);
    plot.add(`<path class="scored" style="stroke-opacity:${opacity}" d="${d}"><title>leg ${part.leg}, ${escapeHtml(part.part)}: ` +
        `score ${fixed(part.score, 1)}</title></path>`);
  }
  plot.path(before, "odometry");
  plot.path(run.recorded, `truth ${colourClass(run.direction)}`);
  if (after.length) plot.path(after, "twin");
  if (place) plot.circle(place, 11 / plot.scale, "place");
  const [from, end] = [run.recorded[0], run.recorded[run.recorded.length - 1]];
  plot.add(`<circle class="fix" cx="${px(plot.px(from[0]))}" cy="${px(plot.py(from[1]))}" r="3.6"/>`);
  plot.add(`<circle class="end ${colourClass(run.direction)}" cx="${px(plot.px(end[0]))}" cy="${px(plot.py(end[1]))}" r="4.2"/>`);
  return plot.svg(`Run ${run.id}: recorded path solid, scenario dashed${after.length ? ", twin dotted" : ""}, ` +
      `differences shown ${k} times` + (run.parts.length ? `, ${plural(run.parts.length, "part")} marked that score` : ""));
}

function setupGapTracks(data, section) {
  const runs = data.runs.filter((r) => r.recorded.length > 1);
  const twin = runs.some((r) => r.after);
  const size = Math.max(...runs.map((r) => gapSpan(gapBounds(r.recorded))));
  let k = Math.max(1, Math.min(50, Math.floor(size / 10 / Math.max(1e-6, ...runs.map(gapError)))));
  section.innerHTML = `
    <h2>Where</h2>
    <p>${gapWhereText(data.diagnosis)}</p>
    <figure>
      <div class="controls"><label>Differences shown
        <input type="range" min="1" max="50" step="1" value="${k}" aria-label="Exaggeration of the differences"><output></output></label></div>
      <div class="panels small">${runs.map((r, i) => `<div class="panel"><p class="panel-title">${escapeHtml(r.id)}
        <span class="muted">off by ${mmUnit(gapError(r))} at most</span></p><div class="plot" data-run="${i}"></div></div>`).join("")}</div>
      ${legendHtml([
        [lineIcon("truth cw"), "recorded, clockwise"], [lineIcon("truth ccw"), "recorded, counter-clockwise"],
        [lineIcon("odometry"), "predicted by the scenario"],
        ...(twin ? [[lineIcon("twin"), "predicted by the twin"]] : []), [lineIcon("scored"), "parts that score"],
        ...(data.diagnosis.where.place_m ? [['<svg width="18" height="18" aria-hidden="true"><circle class="place" cx="9" cy="9" r="7"/></svg>', "the place"]] : []),
      ])}
      <figcaption>Every run as the tracker recorded it and as the simulator drives it from the recorded ticks. Start pose and
        frame are fitted to each run. <b>Broad bands</b> mark the parts of the run in which the scenario errs; the darker,
        the more evidence.</figcaption>
    </figure>`;
  const draw = () => {
    section.querySelector("output").textContent = `\u00d7${k}`;
    section.querySelector("input").setAttribute("aria-valuetext", `${k} times`);
    section.querySelectorAll(".plot").forEach((element) => {
      element.innerHTML = gapRunSvg(data, runs[Number(element.dataset.run)], k, Math.max(220, Math.min(420, element.clientWidth || 320)));
    });
  };
  section.addEventListener("input", (event) => {
    k = Number(event.target.value);
    draw();
  });
  return draw;
}
