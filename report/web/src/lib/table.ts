// Tables: a caption, a head, rows; each can be saved as CSV. Below 560 px rows stand as blocks of "name: value".

import {escapeHtml, html, Html, raw} from "./html";
import {NONE} from "./format";
import {saveCsv} from "./save";

export interface Table {
  caption: unknown;
  head: unknown[];
  rows: unknown[][];
  text?: number[];    // columns of words: left-aligned, may be broken; the first always is one
  keepEmpty?: boolean;  // rows without any value, too
  stack?: boolean;    // on a narrow screen a row becomes a block
}

const show = (value: unknown): string => html`${value}`.text;
const bare = (value: unknown): string => show(value).replace(/<[^>]*>/g, "");

export function table({caption, head, rows, text = [], keepEmpty = false, stack = false}: Table): Html {
  const kept = keepEmpty ? rows : rows.filter((row) => row.slice(1).some((cell) => show(cell) !== NONE));
  if (!kept.length) return raw("");
  const css = (i: number) => (i === 0 || text.includes(i) ? ' class="text"' : "");
  const heads = head.map((h, i) => `<th scope="col"${css(i)}>${show(h)}</th>`).join("");
  const body = kept.map((row) => `<tr>${row.map((value, i) => {
    const name = stack ? ` data-name="${bare(head[i])}"` : "";
    return i === 0 ? `<th scope="row" class="text">${show(value)}</th>` : `<td${css(i)}${name}>${show(value)}</td>`;
  }).join("")}</tr>`).join("");
  const words = bare(caption);
  return raw(`<div class="table-frame"><div class="table-wrap${stack ? " stack" : ""}" tabindex="0" role="region" aria-label="${words}">` +
      `<table><caption>${show(caption)}</caption><thead><tr>${heads}</tr></thead><tbody>${body}</tbody></table></div>` +
      `<button type="button" class="save" data-save="csv" aria-label="Save as CSV: ${words}">CSV</button></div>`);
}

/// The explanation stands beside its table where there is room.
export const beside = (left: Html, note: Html): Html =>
    (left.text ? html`<div class="beside">${left}<div class="note muted">${note}</div></div>` : raw(""));

/// A bar from 0 to a share of the cell, for the eye; its number stands beside it.
export const bar = (share: number, css: string): Html =>
    raw(`<span class="bar" aria-hidden="true"><span class="${escapeHtml(css)}" style="width:${(100 * Math.max(0, Math.min(1, share))).toFixed(1)}%"></span></span>`);

export function fileName(text: string): string {
  return text.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "").slice(0, 60) || "umbsim";
}

document.addEventListener("click", (event) => {
  const button = (event.target as Element).closest?.("[data-save=csv]");
  const found = button?.parentElement?.querySelector("table");
  if (found) saveCsv(found, fileName(found.caption?.textContent ?? "table"));
});
