// Words and bars of a diagnosis: which effect, how far it helps, what next.

import {html, type Html, join, raw} from "../lib/html";
import {degrees, fixed, isNumber, millimetres, words} from "../lib/format";
import {bar, table} from "../lib/table";
import type {Tile} from "../lib/page";
import type {Figures} from "../run/data";
import {isNamed, namesOf, type GapData} from "./data";

const titleOf = (cause: Figures): string => namesOf(cause).map(words).join(" + ");
const plusses = (names: string): string => names.split("+").map(words).join(" + ");

/// Each number by its effect, as on the terminal: the program writes the texts, and what stayed neutral has none. Then what goes
/// away with the effect on held-out runs, beside the others.
const parameters = (cause: Figures): Html[] => namesOf(cause).flatMap((name) => {
  const texts = Object.values(cause.effects[name] as Figures).map((p) => (typeof p === "object" && p ? p.text : `in ${p}`)).filter(Boolean);
  const own = namesOf(cause).length > 1 && cause.worth?.effects?.[name];
  const all = [...texts.map((t) => t.replace(/(^|[ (])-(?=\d)/g, "$1\u2212")), ...(own ? [`worth ${worth(own)}`] : [])];
  return all.length ? [html`${words(name)}: ${all.join(", ")}`] : [];
});

const worth = (w: Figures): string => `${millimetres(w.position_mm)}, ${degrees(w.heading_deg)}`;

const percent = (p: number): string => `${p >= 0.9995 ? "100" : p >= 0.0995 ? fixed(100 * p, 0) : p >= 0.0005 ? fixed(100 * p, 1) : "<0.1"}\u00a0%`;

function remainder({remainder: r}: Figures): Html {
  if (!r) return raw("");
  const where = r.where ? `, mostly ${r.where}` : "";
  const pattern = r.pattern && html` An effect of the catalogue with the pattern “${words(r.pattern)}” could take ${r.in_catalogue ? "most" : "a small part"} of it.`;
  return html`<p>Remainder: <b>${millimetres(r.position_mm)}</b>, ${fixed(100 * r.share, 0)}\u00a0% of the squared error beyond noise${where}.${pattern}</p>`;
}

export function which(d: Figures): Html {
  const set: string[] = d.set ?? [];
  const shown = (d.causes ?? []).filter((c: Figures, i: number) => i === 0 || c.probability >= 0.0005 || set.includes(namesOf(c).join("+"))).slice(0, 8);
  const rows = shown.map((c: Figures) => [titleOf(c), html`${bar(c.probability, set.includes(namesOf(c).join("+")) ? "tied" : "rest")}`, percent(c.probability),
    join([...parameters(c), c.worth && html`takes away ${worth(c.worth)}${namesOf(c).length > 1 && " in all"}`], raw("<br>"))]);
  const names = join(set.map((n) => html`<b>${plusses(n)}</b>`), raw("; "));
  const alike = set.length > 1 ? html`These data do not tell apart: ${names}.` : html`Nothing else in the catalogue explains these data as well as ${names}.`;
  const rest = d.unexplained?.detected && d.unexplained.description ? html`<p class="notice">Left over: ${d.unexplained.description}.</p>` : "";
  const remarks = d.remarks?.length ? html`<p>Shows in the commands or counts, and moves no pose beyond the noise: ${join(d.remarks.map((n: string) => html`<b>${words(n)}</b>`), raw(", "))}.</p>` : "";
  return html`${table({caption: "Explanations with their probability, numbers with 95 % intervals", stack: true, keepEmpty: true, text: [3],
    head: ["explanation", "", "probability", "numbers"], rows})}<p>${alike}</p>${remarks}${remainder(d)}${rest}`;
}

export function whereText(d: Figures): Html {
  if (!d.gap.detected) return html`<p>The scenario describes these runs: nothing parts from it beyond the noise.</p>`;
  const at = d.where.place_m ? `, at (${fixed(d.where.place_m[0], 2)}, ${fixed(d.where.place_m[1], 2)})\u00a0m` : "";
  const top = d.where.segments?.[0];
  const most = top && html` Most evidence: run <b>${top.run}</b>, leg ${top.leg}, ${top.part}.`;
  return html`<p>Stage: <b>${words(d.where.stage)}</b>. Pattern: <b>${words(d.where.pattern || "undecided")}</b>${at}.${most}</p>`;
}

export function tiles(d: Figures): Tile[] {
  const c = d.closure ?? {};
  const closed = isNumber(c.held_out_fraction);
  const all: (Tile | false)[] = [
    {name: "Off by", value: millimetres(d.gap.before_mm), more: "scenario against recording, r.m.s."},
    {name: "Noise floor", value: millimetres(d.gap.noise_floor_mm), more: "what runs alone differ by"},
    closed && {name: "Closed on held-out runs", value: `${fixed(100 * c.held_out_fraction, 1)}\u00a0%`,
               more: `95 %: ${fixed(100 * c.ci95[0], 0)} to ${fixed(100 * c.ci95[1], 0)} %`},
    closed && {name: "Off by, with the twin", value: millimetres(c.after_mm), more: "held-out runs"}];
  return all.filter((t): t is Tile => !!t);
}

function twinHolds(effective: Figures | null): string {
  if (!effective) return "with the effect added";
  const dimensions = Object.keys(effective.dimensions).map(words).join(" and ");
  return effective.beside_causes ? `with an effective ${dimensions}` : `with an effective ${dimensions} in their place`;
}

export function closure(d: Figures): Html {
  const c = d.closure ?? {};
  if (!isNumber(c.held_out_fraction)) return html`<p>${d.gap.detected ? "Nothing could be held out, or no named effect was found." : "There is no gap to close."}</p>`;
  const most = Math.max(c.before_mm, c.after_mm, c.noise_floor_mm);
  const row = (name: string, v: number, css: string, heading?: number) => [name, bar(v / most, css), millimetres(v), isNumber(heading) ? degrees(heading) : ""];
  const conditions: Figures[] = Array.isArray(c.conditions) ? c.conditions : [];
  return html`${table({
    caption: "Each condition predicted with numbers fitted on the others: position along the run (r.m.s.), heading at its end", keepEmpty: true, stack: true,
    head: ["", "", "position", "heading"], rows: [
      row("scenario as it was", c.before_mm, "rest", c.before_deg),
      ...(c.effective ? [row("with the causes", c.effective.after_mm_without, "tied")] : []),
      row(twinHolds(c.effective), c.after_mm, "tied", c.after_deg),
      row("noise floor", c.noise_floor_mm, "floor")]})}
    ${conditions.length ? table({caption: "Each held-out condition", stack: true, head: ["condition", "before", "after"],
      rows: conditions.map((x) => [x.name ?? x.condition, millimetres(x.before_mm), millimetres(x.after_mm)])}) : ""}`;
}

export function next(data: GapData): Html {
  const d = data.diagnosis;
  const items = (d.next_experiment ?? []).map((n: Figures) => html`<li><b>${n.run}</b> separates ${(n.separates ?? []).map(words).join(", ")}</li>`);
  const ties = (d.indistinguishable ?? []).map((t: string[]) => html`<li>Alike in these runs: ${t.map(words).join(", ")}</li>`);
  const twin = d.causes?.some((c: Figures) => c.worth) || d.closure?.effective || (d.gap.detected && d.causes?.length && isNamed(d.causes[0]));
  const limits = (d.limits ?? []).map((l: string) => html`<li>${l}</li>`);
  return html`<ul>${items.length ? items : d.set?.length > 1 ? "" : html`<li>No further run is needed to tell the explanations apart.</li>`}${ties}
    ${twin ? html`<li><code>umbsim run twin.yaml</code> drives the scenario with what the twin holds.</li>` : ""}</ul>
    ${limits.length ? html`<p>Limits of this answer:</p><ul>${limits}</ul>` : ""}`;
}
