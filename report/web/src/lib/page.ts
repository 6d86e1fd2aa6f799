// The frame that all pages share: header, tiles, sections with an address of their own, licences, what goes wrong.

import {fill, find, html, Html, raw} from "./html";

declare const LICENCES: {name: string; version: string; licence: string; text: string}[];

export interface Tile {
  name: unknown;
  value: unknown;
  unit?: string;
  more?: unknown;
}

export interface Section {
  id: string;
  title?: string;  // without: the section brings its own heading
  content?: Html;
  setup?: (element: HTMLElement) => void;
}

export interface Page {
  title: string;
  headline?: Html;
  description?: string;
  warnings?: string[];
  tiles?: Tile[];
  sections: (Section | null | false | undefined)[];
  footer?: unknown;
}

const tile = ({name, value, unit, more}: Tile): Html => html`<div class="tile"><dt>${name}</dt><dd><div class="value">${value}${
    unit && html`<small>${unit}</small>`}</div><div class="more">${more}</div></dd></div>`;

export const heading = (id: string, title: string): Html =>
    html`<h2>${title} <a class="anchor" href="#${id}" aria-label="Link to: ${title}">#</a></h2>`;

function licences(): Html {
  const items = LICENCES.map((l) => html`<li><details><summary>${l.name} ${l.version}: ${l.licence}</summary><pre>${
      l.text || "The package holds no text of its licence."}</pre></details></li>`);
  return html`<details class="licences"><summary>Licences of what this page is made of</summary><ul>${items}</ul></details>`;
}

export function showError(message: string): void {
  const banner = find(document, "#page-error");
  banner.textContent = `This report could not be drawn completely: ${message}`;
  banner.hidden = false;
}

function goToAddress(): void {
  const id = decodeURIComponent(location.hash.slice(1));
  if (id) document.getElementById(id)?.scrollIntoView();
}

/// Lets the browser paint what there is.
const painted = (): Promise<void> => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));

/// Puts the page together, then draws the sections in their order: the first is seen before the others are drawn.
export async function build(page: Page): Promise<void> {
  const sections = page.sections.filter((s): s is Section => !!s && (!!s.setup || !!s.content?.text));
  const body = sections.map((s) => html`<section id="${s.id}">${s.title && heading(s.id, s.title)}${s.content}</section>`);
  fill(find(document, "#report"), html`
    <header>
      <h1>${page.title}</h1>
      ${page.headline?.text ? html`<p class="headline">${page.headline}</p>` : ""}
      ${page.description && page.description !== page.title && html`<p class="muted">${page.description}</p>`}
      ${page.warnings?.length ? html`<ul class="notice warnings">${page.warnings.map((w) => html`<li>${w}</li>`)}</ul>` : ""}
      ${page.tiles?.length ? html`<dl class="tiles">${page.tiles.map(tile)}</dl>` : ""}
    </header>${body}
    <footer><p>${page.footer}</p>${licences()}</footer>`);
  const [first, ...others] = sections.filter((s) => s.setup);
  const draw = (s: Section) => s.setup!(find(document, `#${CSS.escape(s.id)}`));
  if (first) draw(first);
  if (document.visibilityState === "visible") await painted();
  performance.mark("first-chart");
  others.forEach(draw);
  goToAddress();
  window.addEventListener("hashchange", goToAddress);
}

export const legend = (items: [Html, unknown][]): Html =>
    html`<ul class="legend">${items.map(([icon, text]) => html`<li>${icon}<span>${text}</span></li>`)}</ul>`;

/// A line as the charts draw it: solid, dashed or dotted.
export const lineIcon = (colour: string, dash = "", width = 2): Html => raw(`<svg width="30" height="12" aria-hidden="true">` +
    `<line x1="1" y1="6" x2="29" y2="6" style="stroke:${colour};stroke-width:${width};stroke-dasharray:${dash || "none"}"/></svg>`);

/// A mark of a chart, by the class of its colours: a disc, or a path in a square of 18 px.
export const icon = (css: string, path = "M9 5a4 4 0 1 0 0.01 0Z"): Html => raw(`<svg width="18" height="16" aria-hidden="true"><path class="${css}" d="${path}"/></svg>`);

export const SPREAD = "M2 8a7 4 0 1 0 14 0a7 4 0 1 0 -14 0";  // an ellipse

/// cw: circle, ccw: triangle, others: square. Hollow before, filled after calibration, pale with cables.
export function markerIcon(direction: string, stage: string): Html {
  const css = `class="pt ${direction === "cw" || direction === "ccw" ? direction : "other"} ${stage === "after" ? "after" : stage === "bumped" ? "bumped" : ""}"`;
  const shape = direction === "cw" ? `<circle ${css} cx="7" cy="7" r="4.6"/>` :
      direction === "ccw"          ? `<path ${css} d="M7 1.2L12.4 11H1.6Z"/>` :
                                     `<rect ${css} x="3" y="3" width="8" height="8"/>`;
  return raw(`<svg class="swatch" width="14" height="14" aria-hidden="true">${shape}</svg>`);
}
