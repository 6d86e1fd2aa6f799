// The list of results.

import {isNumber, mmUnit, plural, short} from "../lib/format";
import {html} from "../lib/html";
import {build} from "../lib/page";
import {table} from "../lib/table";
import type {Figures} from "../run/data";

const figure = ({figure: v, figure_name: name}: Figures): string => {
  if (v === null || v === undefined) return "";
  if (isNumber(v)) return / \(m\)$/.test(name) ? `${name.replace(/ \(m\)$/, "")} ${mmUnit(v)}` : `${name} ${short(v)}`;
  return name ? `${name} ${v}` : String(v);
};

export function showIndex(data: Figures): Promise<void> {
  const rows = (data.results ?? []).map((r: Figures) => [
    r.page ? html`<a href="${encodeURIComponent(r.name)}/report.html">${r.name}</a>` : r.name, r.kind, figure(r)]);
  return build({
    title: data.title, headline: html`${plural(rows.length, "result")}, the newest first.`, footer: `umbsim ${data.version}`,
    sections: [{id: "results", content: table({caption: "Results in this folder", head: ["result", "kind", "figure"], text: [1, 2], rows, stack: true})}],
  });
}
