// The page of a plan: which effects a set of runs can tell apart, before there is any data.

import {fixed, plural, words} from "../lib/format";
import {find, html, type Html, raw} from "../lib/html";
import {build, type Section} from "../lib/page";
import {table} from "../lib/table";
import type {Figures} from "../run/data";
import {provenance} from "../run/tables";
import {matrix, type Cell} from "./bars";

const list = (names: unknown[]): string => names.map((n) => (Array.isArray(n) ? n.filter((v) => typeof v === "string").map(words).join(" and ") : words(n))).join("; ");

function result(id: string, title: string, r: Figures): Section | null {
  if (!r) return null;
  const m = r.confusion;
  const cells = m ? m.truth.flatMap((truth: string, i: number) => m.named.flatMap((named: string, k: number): Cell[] => {
    const [value, row, column] = [m.probability[i][k], words(truth), words(named)];
    return value < 0.005 ? [] : [{row, column, value, right: row === column, text: fixed(100 * value, 0), words: `${row}\nwould be named ${column}\nin ${fixed(100 * value, 1)} % of cases`}];
  })) : [];
  const groups = (r.indistinguishable ?? []).map((g: string[]) => html`<li>${g.map(words).join(", ")}</li>`);
  return {
    id, title, content: html`<p>${r.separated_pairs} of ${r.pairs} pairs of effects are told apart.</p>${cells.length ? html`<figure><div id="${id}-matrix"></div>
      <figcaption>A row for each effect that is there: what a diagnosis would name, in per cent of drawn cases. Framed cells are right.</figcaption></figure>` : ""}
      ${groups.length ? html`<p>Not told apart:</p><ul>${groups}</ul>` : ""}
      ${r.not_shown?.length ? html`<p>Hardly shows at all: ${list(r.not_shown)}.</p>` : ""}`,
    setup: (section) => {
      if (cells.length) matrix(find(section, `#${id}-matrix`), id, m.truth.map(words), m.named.map(words), cells, ["truth", "named"]);
    },
  };
}

/// Few pairs are named, many are counted and can be unfolded.
function pairs(separates: unknown): Html {
  if (!Array.isArray(separates) || separates.length <= 4) return html`${Array.isArray(separates) ? list(separates) : separates ?? ""}`;
  return html`<details><summary>${plural(separates.length, "pair")}</summary>${list(separates)}</details>`;
}

function chosen(title: string, r: Figures): Html {
  if (!r?.runs?.length) return raw("");
  return table({caption: `${title}: ${plural(r.runs.length, "run")}, ${fixed(r.duration_s / 60, 1)} min`, head: ["run", "shows, beyond the runs above", "tells apart, beyond them"], text: [1, 2], stack: true, keepEmpty: true,
    rows: r.runs.map((x: Figures) => [x.run, list(x.shows ?? []), pairs(x.separates)])});
}

export function showPlan(data: Figures): Promise<void> {
  const p = data.plan;
  return build({
    title: data.title, footer: `umbsim ${data.version}`, warnings: p.limits,
    headline: html`${p.these_runs ? html`These runs tell <b>${p.these_runs.separated_pairs}</b> of ${p.these_runs.pairs} pairs of effects apart. ` : ""}${
      p.recommended ? html`The shortest set that separates what can be separated takes <b>${fixed(p.recommended.duration_s / 60, 1)} min</b>.` : ""}`,
    sections: [
      {id: "recommended", title: "What to drive", content: html`${chosen("From nothing", p.recommended)}${chosen("On top of these runs", p.further)}`},
      result("these-runs", "What these runs tell apart", p.these_runs), result("recommended-result", "What the recommended runs tell apart", p.recommended?.result),
      {id: "menu", title: "Runs to choose from", content: table({caption: "The menu", head: ["run", "duration (s)"], rows: (p.menu ?? []).map((m: Figures) => [m.run, fixed(m.duration_s, 0)])})},
      {id: "provenance", title: "Provenance", content: provenance(data)},
    ],
  });
}
