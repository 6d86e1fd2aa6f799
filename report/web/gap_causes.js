"use strict";

// Words and bars of a diagnosis: which effect, how far it helps, what next.

const gapWords = (name) => String(name).replace(/_/g, " ");

const gapNames = (cause) => Object.keys(cause.effects).sort();

const gapTitle = (cause) => gapNames(cause).map(gapWords).join(" + ");

const isNamed = (cause) => !["none", "unknown"].includes(gapNames(cause)[0]);

// Each number by its effect, as on the terminal: the program writes the texts. What stayed neutral has none.
function gapParameters(cause) {
  return gapNames(cause).map((name) => {
    const texts = Object.values(cause.effects[name]).map((p) => (typeof p === "object" ? p.text : `in ${p}`)).filter(Boolean);
    return texts.length ? `${escapeHtml(gapWords(name))}: ${escapeHtml(texts.join(", "))}` : "";
  }).filter(Boolean).join("<br>");
}

const percent = (p) => (p >= 0.9995 ? "100" : p >= 0.0995 ? fixed(100 * p, 0) : p >= 0.0005 ? fixed(100 * p, 1) : "&lt;0.1") + "\u00a0%";

const barHtml = (share, cssClass) =>
    `<span class="bar" aria-hidden="true"><span class="${cssClass}" style="width:${(100 * Math.max(0, Math.min(1, share))).toFixed(1)}%"></span></span>`;

// What goes away with a cause on held-out runs, and with each of its effects beside the others.
function gapWorth(cause) {
  if (!cause.worth) return "";
  const text = (w) => `${gapMm(w.position_mm)}, ${fixed(w.heading_deg, 3)}\u00a0°`;
  const each = Object.entries(cause.worth.effects || {}).map(([name, w]) => `${escapeHtml(gapWords(name))}: ${text(w)}`);
  return [`takes away ${text(cause.worth)}`, ...each].join("<br>");
}

function gapRemainder(d) {
  const r = d.remainder;
  if (!r) return "";
  const where = r.where ? `, mostly ${escapeHtml(r.where)}` : "";
  const pattern = r.pattern ? ` An effect of the catalogue with the pattern “${escapeHtml(gapWords(r.pattern))}” could take ${r.in_catalogue ? "most" : "a small part"} of it.` : "";
  return `<p>Remainder: <b>${gapMm(r.position_mm)}</b>, ${fixed(100 * r.share, 0)}\u00a0% of the squared error beyond noise${where}.${pattern}</p>`;
}

function gapWhichHtml(d) {
  const shown = d.causes.filter((c, i) => i === 0 || c.probability >= 0.0005 || d.set.includes(gapNames(c).join("+"))).slice(0, 8);
  const rows = shown.map((c) => {
    const tied = d.set.includes(gapNames(c).sort().join("+"));
    return `<tr><th scope="row" class="text">${escapeHtml(gapTitle(c))}</th><td class="bar-cell">${barHtml(c.probability, tied ? "tied" : "rest")}</td>
      <td>${percent(c.probability)}</td><td class="text">${[gapParameters(c), gapWorth(c)].filter(Boolean).join("<br>")}</td></tr>`;
  });
  const set = d.set.map((n) => `<b>${escapeHtml(gapWords(n))}</b>`).join(", ");
  const alike = d.set.length > 1 ? `These data do not tell apart: ${set}.` : `Nothing else in the catalogue explains these data as well as ${set}.`;
  const rest = d.unexplained.detected && d.unexplained.description ? `<p class="notice">Left over: ${escapeHtml(d.unexplained.description)}.</p>` : "";
  return `<div class="table-wrap"><table><caption>Explanations with their probability, numbers with 95 % intervals</caption>
    <thead><tr><th class="text">explanation</th><th></th><th>probability</th><th class="text">numbers</th></tr></thead>
    <tbody>${rows.join("")}</tbody></table></div><p>${alike}</p>${gapRemainder(d)}${rest}`;
}

function gapWhereText(d) {
  if (!d.gap.detected) return "The scenario describes these runs: nothing parts from it beyond the noise.";
  const at = d.where.place_m ? `, at (${fixed(d.where.place_m[0], 2)}, ${fixed(d.where.place_m[1], 2)})\u00a0m` : "";
  const top = d.where.segments[0];
  const most = top ? ` Most evidence: run <b>${escapeHtml(top.run)}</b>, leg ${top.leg}, ${escapeHtml(top.part)}.` : "";
  return `Stage: <b>${escapeHtml(gapWords(d.where.stage))}</b>. Pattern: <b>${escapeHtml(gapWords(d.where.pattern || "undecided"))}</b>${at}.${most}`;
}

const gapMm = (v) => `${fixed(v, v >= 10 ? 1 : 2)}\u00a0mm`;

function gapTilesHtml(d) {
  const tile = (name, value, more) => value === "" ? "" :
      `<div class="tile"><dt>${name}</dt><dd><div class="value">${value}</div><div class="more">${more}</div></dd></div>`;
  const c = d.closure;
  const closed = isNumber(c.held_out_fraction);
  return `<dl class="tiles">${[
    tile("Off by", gapMm(d.gap.before_mm), "scenario against recording, r.m.s."),
    tile("Noise floor", gapMm(d.gap.noise_floor_mm), "what runs alone differ by"),
    tile("Closed on held-out runs", closed ? `${fixed(100 * c.held_out_fraction, 1)}\u00a0%` : "",
         closed ? `95 %: ${fixed(100 * c.ci95[0], 0)} to ${fixed(100 * c.ci95[1], 0)} %` : ""),
    tile("Off by, with the twin", closed ? gapMm(c.after_mm) : "", "held-out runs"),
  ].join("")}</dl>`;
}

function gapClosureHtml(d) {
  const c = d.closure;
  if (!isNumber(c.held_out_fraction)) return `<p>${d.gap.detected ? "Nothing could be held out, or no named effect was found." : "There is no gap to close."}</p>`;
  const scale = Math.max(c.before_mm, c.after_mm, c.noise_floor_mm);
  const row = (name, v, css, degrees) => `<tr><th scope="row" class="text">${name}</th><td class="bar-cell">${barHtml(v / scale, css)}</td>
    <td>${gapMm(v)}</td><td>${isNumber(degrees) ? `${fixed(degrees, 3)}°` : ""}</td></tr>`;
  return `<div class="table-wrap"><table><caption>Each condition predicted with numbers fitted on the others: position along the run (r.m.s.), heading at its end</caption>
    <thead><tr><th class="text"></th><th></th><th>position</th><th>heading</th></tr></thead><tbody>
    ${row("scenario as it was", c.before_mm, "rest", c.before_deg)}${row("with the effect added", c.after_mm, "tied", c.after_deg)}
    ${row("noise floor", c.noise_floor_mm, "floor")}</tbody></table></div>`;
}

function setupGapScatter(data, element) {
  const points = data.runs.flatMap((r) => ["before", "after"].filter((s) => r.end[s]).map((s) => ({run: r, stage: s, ...r.end[s]})));
  const reach = 1.15 * Math.max(0.001, ...points.map((p) => Math.max(Math.abs(p.x_m), Math.abs(p.y_m)))) * 1000;
  element.innerHTML = `<div class="plot"></div>${legendHtml([
    [markerIcon("cw", "before"), "clockwise, scenario"], [markerIcon("ccw", "before"), "counter-clockwise, scenario"],
    ...(points.some((p) => p.stage === "after") ? [[markerIcon("cw", "after"), "with the twin (filled)"]] : [])])}`;
  const place = element.querySelector(".plot");
  return () => {
    const plot = Plot.square({width: Math.min(480, panelWidth(place)), x: [-reach, reach], y: [-reach, reach],
                              xLabel: "recorded minus predicted end, ahead (mm)", yLabel: "to the left (mm)"});
    for (const p of points) {
      plot.marker([1000 * p.x_m, 1000 * p.y_m], p.run.direction, p.stage, `${p.run.id}, ${p.stage === "before" ? "scenario" : "twin"}: ` +
          `${fixed(1000 * p.x_m, 1)}, ${fixed(1000 * p.y_m, 1)} mm, ${fixed(p.theta_rad * DEG, 3)}°`);
    }
    place.innerHTML = plot.svg(`End-point errors of ${plural(data.runs.length, "run")}, before and after the effect is added, in millimetres`);
  };
}

function gapNextHtml(d) {
  const next = (d.next_experiment || []).map((n) => `<li><b>${escapeHtml(n.run)}</b> separates ${(n.separates || []).map((s) => escapeHtml(gapWords(s))).join(" and ")}</li>`);
  const ties = (d.indistinguishable || []).map((t) => `<li>Alike in these runs: ${t.map((s) => escapeHtml(gapWords(s))).join(", ")}</li>`);
  const limits = (d.limits || []).map((l) => `<li>${escapeHtml(l)}</li>`);
  const none = d.set.length > 1 ? "" : "<li>No further run is needed to tell the explanations apart.</li>";
  const twin = d.causes.some((c) => c.worth) || (d.gap.detected && isNamed(d.causes[0])) ? "<li><code>umbsim run twin.yaml</code> drives the scenario with the effect added.</li>" : "";
  return `<ul>${next.length ? next.join("") : none}${ties.join("")}${twin}</ul>` + (limits.length ? `<p>Limits of this answer:</p><ul>${limits.join("")}</ul>` : "");
}
