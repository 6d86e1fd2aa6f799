// The page of a sweep: any figure over any two axes, recovered against injected errors, expectations, failed points.

import * as Plot from "@observablehq/plot";
import {Chart} from "../lib/chart";
import {short, words} from "../lib/format";
import {fill, find, html, type Html} from "../lib/html";
import {build, heading, legend, lineIcon, type Tile} from "../lib/page";
import {table} from "../lib/table";
import {provenance} from "../run/tables";
import {colours, curveNames, drawing, isCurves, type Choice} from "./charts";
import {axisOf, has, isScattered, labelOf, load, valueOf, type Axis, type SweepData} from "./data";
import {recoveredSection} from "./recovered";

const MOST_ROWS = 200;

function tiles(data: SweepData): Tile[] {
  const unmet = data.checks.filter((c) => !c.met).length;
  return [{name: "Points driven", value: data.done, more: `of ${data.points}, ${words(data.design)}`}, {name: "Failed", value: data.failed.length, more: "could not be driven"},
    ...(data.checks.length ? [{name: "Expectations met", value: data.checks.length - unmet, more: `of ${data.checks.length}`}] : [])];
}

function checks(data: SweepData): Html {
  const all = data.checks.flatMap((c) => c.unmet.map((u) => [u.point ?? "\u2013", u.where, c.figure, short(u.value)]));
  const more = all.length > MOST_ROWS ? `, the first ${MOST_ROWS} of ${all.length}` : "";
  return html`${table({caption: "What the sweep asks for", head: ["", "expectation", "checked", "not met"], text: [1], keepEmpty: true, stack: true, rows: data.checks.map((c) => [
    c.met ? html`<b class="good">met</b>` : html`<b class="bad">not met</b>`, c.expectation, c.checked, c.unmet.length])})}
    ${table({caption: `Not met${more} (SI units)`, head: ["point", "where", "figure", "value"], text: [1, 2], stack: true, rows: all.slice(0, MOST_ROWS)})}`;
}

const failed = (data: SweepData): Html => table({
  caption: "Points that could not be driven", head: ["point", "where", "why"], text: [1, 2], stack: true,
  rows: data.failed.slice(0, MOST_ROWS).map((f) => [f.point, f.where, f.error])});

/// What to show first: the sweep file's wish, else the axes with the most values.
function firstChoice(data: SweepData): Choice {
  const byValues = [...data.axes].sort((a, b) => b.values.length - a.values.length);
  const x = axisOf(data, data.view.x) ?? byValues[0];
  const y = axisOf(data, data.view.y) ?? byValues.find((a) => a !== x && a.values.length > 1);
  const wanted = ["recovery.e_d_error", "umbmark.e_max_syst_m"].find((f) => has(data, f));
  const curves = !y || y.values.length <= 8;
  return {x: x.key, y: y?.key ?? "", figure: has(data, data.view.figure) ? data.view.figure : wanted ?? data.figures[0], kind: curves ? "curves" : "map", log: data.view.log};
}

const select = (name: string, label: unknown, values: [string, string][], chosen: string): Html => html`<label>${label} <select data-control="${name}">${
    values.map(([value, text]) => html`<option value="${value}" ${value === chosen ? html`selected` : ""}>${text}</option>`)}</select></label>`;

function setup(data: SweepData, section: HTMLElement): void {
  const choice = firstChoice(data);
  const slices: Record<string, string> = {};
  // Axes that the figure does not show: one of their values, or all together.
  const others = (): Axis[] => (choice.kind === "parallel" ? [] :
      data.axes.filter((a) => a.key !== choice.x && a.key !== choice.y && a.values.length > 1 && !isScattered(data, a)));
  const rows = () => others().reduce((kept, axis) => {
    const at = (slices[axis.key] ??= axis.numeric ? "all" : "0");  // names are looked at one by one, numbers all together
    return at === "all" ? kept : kept.filter((row) => valueOf(data, row, axis.key) === axis.values[Number(at)]);
  }, data.rows);
  const controls = () => {
    const axes = data.axes.map((a): [string, string] => [a.key, labelOf(data, a.key)]);
    return html`${select("figure", "Figure", data.figures.map((f) => [f, labelOf(data, f)]), choice.figure)}
      ${select("kind", "as", [["curves", "curves"], ["map", "map"], ["parallel", "all axes side by side"]], choice.kind)}
      ${choice.kind !== "parallel" && html`${select("x", "over", axes, choice.x)}${select("y", "and", [["", "\u2013"], ...axes.filter(([key]) => key !== choice.x)], choice.y)}`}
      ${others().map((a) => select(`slice ${a.key}`, labelOf(data, a.key), [["all", "all together"], ...a.values.map((v, i): [string, string] => [String(i), short(v)])], slices[a.key] ?? "all"))}
      <label><input type="checkbox" data-control="log" ${choice.log ? html`checked` : ""}>log scale of the size</label>
      ${axisOf(data, choice.x)?.numeric && choice.kind !== "parallel" && html`<label><input type="checkbox" data-control="log x" ${axisOf(data, choice.x)!.log ? html`checked` : ""}>log axis</label>`}`;
  };
  fill(section, html`${heading("figure-1", "Figure 1. One figure over the axes")}<figure><div class="controls" role="group" aria-label="What the figure shows"></div>
    <div id="sweep-map"></div><div class="key-slot"></div><figcaption>Curves and colours show the chosen figure; where several points fall on one place (repeats, other axes) their
      median, and a <b>band</b> that holds 80 % of them. A <b>ring</b> marks points that do not meet an expectation, a <b>cross</b> those that could not be driven.</figcaption></figure>`);
  rows();
  fill(find(section, ".controls"), controls());
  const chart = new Chart(find(section, "#sweep-map"), {name: "sweep", most: 1060, draw: (width) => drawing(data, rows(), choice, width)});
  const key = () => {
    const slot = find(section, ".key-slot");
    slot.replaceChildren();
    if (isCurves(data, choice)) fill(slot, legend(curveNames(data, rows(), choice).map(([c, text]) => [lineIcon(c), text])));
    else slot.append(Plot.legend({color: colours(data, rows(), choice), width: 300, tickFormat: short} as unknown as Plot.LegendOptions));
  };
  key();
  section.addEventListener("change", (event) => {
    const input = event.target as HTMLInputElement;
    const name = input.dataset.control;
    if (!name) return;
    if (name === "log") choice.log = input.checked;
    else if (name === "log x") axisOf(data, choice.x)!.log = input.checked;
    else if (name.startsWith("slice ")) slices[name.slice(6)] = input.value;
    else (choice as unknown as Record<string, string>)[name] = input.value;
    if (choice.y === choice.x) choice.y = "";
    rows();
    fill(find(section, ".controls"), controls());
    section.querySelector<HTMLElement>(`[data-control="${CSS.escape(name)}"]`)?.focus();
    chart.redraw();
    key();
  });
}

export function showSweep(given: SweepData): Promise<void> {
  const data = load(given);
  return build({
    title: `Sweep ${data.title}`, description: data.description, tiles: tiles(data),
    footer: `umbsim ${data.version}${data.stride > 1 ? ` · every ${data.stride}th point is shown` : ""}`,
    sections: [
      !!data.rows.length && !!data.figures.length && {id: "figure-1", setup: (section: HTMLElement) => setup(data, section)},
      recoveredSection(data), {id: "expectations", title: "Expectations", content: checks(data)}, {id: "failed", title: "Failed points", content: failed(data)},
      {id: "provenance", title: "Provenance", content: provenance(data)},
    ],
  });
}
