// Recovered against injected E_d and E_b: does UMBmark find what was put in?

import * as Plot from "@observablehq/plot";
import {extent} from "d3";
import {Chart, type Drawing} from "../lib/chart";
import {isNumber} from "../lib/format";
import {fill, find, html} from "../lib/html";
import {heading, legend, lineIcon, markerIcon, type Section} from "../lib/page";
import {describe, faultOf, has, numberOf, type Row, type SweepData} from "./data";

const FORMS = [{key: "endpoint", css: "cw", symbol: "circle", text: "endpoint form"}, {key: "heading", css: "ccw", symbol: "triangle", text: "heading form"}] as const;
const MOST = 1500;  // dots of a form

type Error = "e_d" | "e_b";

export function recoveredSection(data: SweepData): Section | null {
  const varies = (name: string) => has(data, name) && new Set(data.rows.map((r) => numberOf(data, r, name)).filter(isNumber)).size > 1;
  const errors = (["e_d", "e_b"] as const).filter((e) => varies(`injected.${e}`));
  if (!errors.length) return null;
  const stride = Math.ceil(data.rows.length / MOST);
  const rows = data.rows.filter((_, i) => i % stride === 0);
  const panels = (["value", "error"] as const).flatMap((kind) => errors.map((error) => ({kind, error})));
  return {id: "figure-2", setup: (section) => {
    fill(section, html`${heading("figure-2", "Figure 2. Recovered against injected errors")}<figure><div class="panels">${panels.map(({kind, error}) => html`<div class="panel">
      <p class="panel-title">${kind === "value" ? "Recovered" : "Recovered minus injected"} E<sub>${error.slice(2)}</sub></p><div id="recovered-${error}-${kind}"></div></div>`)}</div>
      ${legend([...FORMS.map((f): [ReturnType<typeof markerIcon>, string] => [markerIcon(f.css, "after"), f.text]), [lineIcon("var(--ink)", "6 4"), "recovered = injected"]])}
      <figcaption>Above: what UMBmark makes of the squares before calibration, over what the robot was built with; on the line it is found exactly. Below:
        how far it is off. The <b>endpoint</b> form takes small angles for granted and errs where they are not small; the <b>heading</b> form does not.${
        stride > 1 ? ` Every ${stride}th point is drawn.` : ""}</figcaption></figure>`);
    for (const {kind, error} of panels) {
      new Chart(find(section, `#recovered-${error}-${kind}`), {
        name: `recovered-${error}-${kind}`, draw: (width) => drawing(data, rows, error, kind, width)});
    }
  }};
}

function drawing(data: SweepData, rows: Row[], error: Error, kind: "value" | "error", width: number): Drawing {
  const name = error.replace("e", "E");
  const points = FORMS.flatMap((form) => rows.flatMap((row) => {
    const [x, found] = [numberOf(data, row, `injected.${error}`), numberOf(data, row, `calibration.${form.key}.${error}`)];
    const fault = faultOf(data, row);
    return isNumber(x) && isNumber(found) ? [{form, x, y: kind === "value" ? found : found - x,
      words: `${form.text}: ${found.toPrecision(7)}\ninjected ${x.toPrecision(7)}\n${describe(data, row)}${fault && `\n${fault}`}`}] : [];
  }));
  return {
    label: `${name} ${kind === "value" ? "recovered against injected" : "recovered minus injected, over injected"}`, points,
    height: Math.max(250, width * 0.62), plot: {marginLeft: 72}, grid: "xy", x: {label: `injected ${name}`, inset: 6},
    y: {label: kind === "value" ? `recovered ${name}` : `${name}: difference`, nice: true},
    marks: [Plot.line(extent(points, (p) => p.x).map((x) => [x!, kind === "value" ? x! : 0]), {stroke: "var(--ink)", strokeDasharray: "6 4"}),
      ...FORMS.map((form) => Plot.dot(points.filter((p) => p.form === form), {
        x: "x", y: "y", symbol: form.symbol, r: 3.4, fill: `var(--${form.css})`, fillOpacity: 0.6, className: "recovered"}))],
  };
}
