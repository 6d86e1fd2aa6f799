"use strict";

// Recovered against injected E_d and E_b: does UMBmark find what was put in?

const FORMS = [{key: "endpoint", css: "cw", text: "endpoint form"}, {key: "heading", css: "ccw", text: "heading form"}];

function recoveredPoints(data, error, form) {
  const [injected, found] = [`injected.${error}`, `calibration.${form.key}.${error}`];
  if (!has(data, injected) || !has(data, found)) return [];
  return data.rows.map((row) => ({row, x: valueOf(data, row, injected), y: valueOf(data, row, found)}))
      .filter((p) => isNumber(p.x) && isNumber(p.y));
}

function setupRecovered(data, section) {
  const panel = (error, kind) => `<div class="panel"><p class="panel-title">${kind === "value" ? "Recovered" : "Recovered minus injected"}
    ${error === "e_d" ? "E<sub>d</sub>" : "E<sub>b</sub>"}</p><div class="plot" data-error="${error}" data-kind="${kind}"></div></div>`;
  section.innerHTML = `
    <h2>Figure 2. Recovered against injected errors</h2>
    <figure>
      <div class="panels">${panel("e_d", "value")}${panel("e_b", "value")}${panel("e_d", "error")}${panel("e_b", "error")}</div>
      <div class="legend-slot"></div>
      <figcaption>Above: what UMBmark makes of the squares before calibration, over what the robot was built with; on the
        line it is found exactly. Below: how far it is off. The <b>endpoint</b> form takes small angles for granted and
        errs where they are not small; the <b>heading</b> form does not.</figcaption>
    </figure>`;
  section.querySelector(".legend-slot").innerHTML = legendHtml([
    ...FORMS.map((f) => [markerIcon(f.css, "after"), f.text]), [lineIcon("emax"), "recovered = injected"]]);
  return () => section.querySelectorAll(".plot").forEach((element) => {
    element.innerHTML = recoveredSvg(data, element.dataset.error, element.dataset.kind, panelWidth(element));
  });
}

function recoveredSvg(data, error, kind, width) {
  const sets = FORMS.map((form) => ({form, points: recoveredPoints(data, error, form)}));
  const height = (p) => (kind === "value" ? p.y : p.y - p.x);
  const all = sets.flatMap((s) => s.points);
  const padded = (values) => {
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const pad = (high - low || Math.abs(low) * 1e-3 || 1e-6) * 0.06;
    return [low - pad, high + pad];
  };
  const plot = new Plot({
    width, height: Math.max(230, width * 0.62), x: padded(all.map((p) => p.x)), y: padded(all.map(height)),
    xLabel: `injected ${error}`, yLabel: kind === "value" ? `recovered ${error}` : `${error}: difference`,
  });
  const [low, high] = plot.x;
  plot.line([low, kind === "value" ? low : 0], [high, kind === "value" ? high : 0], "emax");
  for (const {form, points} of sets) {
    for (const p of points) {
      const title = `${describeRow(data, p.row)}; ${form.text}: ${p.y.toPrecision(7)}, injected ${p.x.toPrecision(7)}`;
      plot.marker([p.x, height(p)], form.css, "small", title);
      if (p.row.unmet || p.row.failed) plot.add(faultMark(plot.px(p.x), plot.py(height(p)), 8, {unmet: true}));
    }
  }
  return plot.svg(`${error} recovered against injected`);
}
