// How many times a difference is shown larger than it is.

import {html, type Html} from "./html";

const FACTORS = [1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 200, 500, 1000];

/// The largest factor that shows `error` at an eighth of `size` at most; 1 where there is none.
export function factorFor(size: number, error: number): number {
  if (!(error > 1e-9)) return 1;
  return Math.max(1, ...FACTORS.filter((f) => f * error <= size / 8));
}

export const slider = (words: string, factor: number): Html => html`<label>${words} <input type="range" class="enlarge" min="0"
  max="${FACTORS.length - 1}" step="1" value="${FACTORS.indexOf(factor)}" aria-label="${words}: enlargement"><output></output></label>
  <span class="too-small muted"></span>`;

export const factorAt = (input: HTMLInputElement): number => FACTORS[Number(input.value)];

/// What stands beside the slider, and what a screen reader says of it.
export function sayFactor(section: ParentNode, factor: number, size: number, error: number): void {
  section.querySelector(".controls output")!.textContent = `\u00d7${factor}`;
  section.querySelector(".controls .too-small")!.textContent = factor * error < size / 500 ? "too small to be seen" : "";
  section.querySelector("input.enlarge")!.setAttribute("aria-valuetext", `${factor} times`);
}
