// A chart in its frame: drawn by Observable Plot, drawn again when its place changes; saved as SVG or PNG; zoomed by buttons,
// by dragging a box, and back; walked along by the arrow keys.

import * as Plot from "@observablehq/plot";
import {brushX, pointer, select} from "d3";
import {find, html, fill} from "./html";
import {saveSvg, savePng} from "./save";

export type Range = [number, number];
export interface View {
  x?: Range;
  y?: Range;
}

export interface Drawing {
  plot: Plot.PlotOptions;
  label: string;                    // the chart in words
  stops?: [unknown, number][];      // what the arrow keys visit, in the units of the axes
}

export interface Options {
  name: string;                     // of the files that are saved
  draw: (width: number, view: View) => Drawing;
  zoom?: "box" | "square" | "none";
  brush?: (range: Range | null) => void;  // a stretch of x that was marked, instead of zooming
  click?: (x: number) => void;
  most?: number;                    // widest, px
}

const MARGIN = {left: 56, right: 14, top: 26, bottom: 40};

/// Equal scales on both axes for ranges of equal span.
export const square = (width: number): Plot.PlotOptions =>
    sized(width, width - MARGIN.left - MARGIN.right + MARGIN.top + MARGIN.bottom);

export const sized = (width: number, height: number): Plot.PlotOptions => ({
  width, height, marginLeft: MARGIN.left, marginRight: MARGIN.right, marginTop: MARGIN.top, marginBottom: MARGIN.bottom,
});

/// Grid lines with the zero line stronger.
export const grid = (): Plot.Markish[] => [
  Plot.gridX({stroke: "var(--grid)", strokeOpacity: 1}), Plot.gridY({stroke: "var(--grid)", strokeOpacity: 1}),
  Plot.ruleX([0], {stroke: "var(--axis)", clip: true}), Plot.ruleY([0], {stroke: "var(--axis)", clip: true})];

/// The text of a tip or of a mark's title: one fact a line.
export const tip = {fill: "var(--card)", stroke: "var(--axis)", fontSize: 12.5, maxRadius: 30, lineWidth: 40};

type Placed = SVGSVGElement & Plot.Plot;

export class Chart {
  private view: View = {};
  private svg!: Placed;
  private stops: [unknown, number][] = [];
  private at = -1;
  private width = 0;

  constructor(private readonly place: HTMLElement, private readonly options: Options) {
    const zoom = options.zoom ?? "box";
    const button = (act: string, sign: string, words: string) =>
        html`<button type="button" data-act="${act}" aria-label="${words}: ${options.name}" title="${words}">${sign}</button>`;
    fill(place, html`<div class="plot" tabindex="0" role="group"></div>
      <div class="chart-tools" role="group" aria-label="${options.name}">${zoom !== "none" && !options.brush && [
        button("in", "+", "Enlarge"), button("out", "\u2212", "Reduce"), button("all", "All", "Show all")]}
        ${[button("svg", "SVG", "Save as SVG"), button("png", "PNG", "Save as PNG")]}
        <span class="said" aria-live="polite"></span></div>`);
    place.classList.add("chart");
    place.addEventListener("click", (event) => {
      const act = (event.target as Element).closest<HTMLElement>("[data-act]")?.dataset.act;
      if (act) this.act(act);
    });
    find(place, ".plot").addEventListener("keydown", (event) => this.key(event as KeyboardEvent));
    this.redraw();
    new ResizeObserver(() => {
      if (this.place.clientWidth !== this.width) requestAnimationFrame(() => this.redraw());
    }).observe(place);
  }

  redraw(): void {
    this.width = this.place.clientWidth;
    const width = Math.max(250, Math.min(this.options.most ?? 640, this.width || 480));
    const {plot, label, stops = []} = this.options.draw(width, this.view);
    this.stops = stops;
    this.svg = Plot.plot({...plot, style: {fontSize: "12px", overflow: "visible", ...(plot.style as object)}}) as Placed;
    this.svg.setAttribute("role", "img");
    this.svg.setAttribute("aria-label", label);
    this.svg.dataset.chart = this.options.name;
    this.svg.querySelectorAll("[aria-label]").forEach((mark) => mark.removeAttribute("aria-label"));  // the label above says it all
    const box = find(this.place, ".plot");
    box.setAttribute("aria-label", `${this.options.name}. Arrow keys read the values.`);
    box.replaceChildren(this.svg);
    if (this.options.brush) this.addBrush(this.options.brush);
    else if ((this.options.zoom ?? "box") !== "none") this.addZoomBox();
    const click = this.options.click;
    if (click) this.svg.addEventListener("click", (event) => click(this.value("x", pointer(event, this.svg)[0])));
  }

  /// Where a value lies, px.
  private px(axis: "x" | "y", value: unknown): number {
    const scale = this.svg.scale(axis)!;
    return scale.apply(value) + (scale.bandwidth ?? 0) / 2;
  }

  private value(axis: "x" | "y", px: number): number {
    return this.svg.scale(axis)!.invert!(px) as number;
  }

  /// A mark that moves with time, without drawing the chart again.
  cursor(places: {x: number; y?: number; colour: string}[]): void {
    const layer = select(this.svg).selectAll<SVGGElement, number>("g.cursor").data([0]).join("g").attr("class", "cursor overlay");
    const [low, high] = [this.svg.scale("y")!.range as number[]].map((r) => [Math.min(...r), Math.max(...r)])[0];
    layer.selectAll("line").data(places.filter((p) => p.y === undefined)).join("line")
        .attr("x1", (p) => this.px("x", p.x)).attr("x2", (p) => this.px("x", p.x)).attr("y1", low).attr("y2", high)
        .style("stroke", (p) => p.colour);
    layer.selectAll("circle").data(places.filter((p) => p.y !== undefined)).join("circle").attr("r", 6)
        .attr("cx", (p) => this.px("x", p.x)).attr("cy", (p) => this.px("y", p.y)).style("fill", (p) => p.colour);
  }

  private act(act: string): void {
    if (act === "svg") saveSvg(this.svg, this.options.name);
    else if (act === "png") void savePng(this.svg, this.options.name);
    else {
      this.view = act === "all" ? {} : this.scaled(act === "in" ? 0.5 : 2);
      this.redraw();
    }
  }

  /// The view about the value that was read last, or the middle.
  private scaled(by: number): View {
    const view: View = {};
    for (const axis of ["x", "y"] as const) {
      const scale = this.svg.scale(axis);
      const range = scale?.range as Range | undefined;
      if (!scale?.invert || !range) continue;
      const stop = this.stops[this.at]?.[axis === "x" ? 0 : 1];
      const middle = stop === undefined ? (range[0] + range[1]) / 2 : this.px(axis, stop);
      view[axis] = range.map((end) => this.value(axis, middle + (end - middle) * by)).sort((a, b) => a - b) as Range;
    }
    return view;
  }

  private addBrush(tell: (range: Range | null) => void): void {
    const [x, y] = [this.svg.scale("x")!.range as Range, this.svg.scale("y")!.range as Range];
    const brush = brushX<unknown>().extent([[Math.min(...x), Math.min(...y)], [Math.max(...x), Math.max(...y)]])
        .on("brush end", ({selection, sourceEvent}) => {
          if (sourceEvent) tell(selection ? (selection as Range).map((px) => this.value("x", px)) as Range : null);
        });
    // Below the marks, so that tips still find the pointer; lines let it through, else no drag could begin on a curve.
    select(this.svg).selectAll("path, line").style("pointer-events", "none");
    select(this.svg).insert("g", "g").attr("class", "brush overlay").call(brush as never);
  }

  private addZoomBox(): void {
    let from: Range | null = null;
    const box = select(this.svg).append("rect").attr("class", "zoom overlay").attr("visibility", "hidden");
    const corners = (event: PointerEvent) => {
      let [x, y] = pointer(event, this.svg);
      if (this.options.zoom === "square") {
        const side = Math.max(Math.abs(x - from![0]), Math.abs(y - from![1]));
        [x, y] = [from![0] + Math.sign(x - from![0]) * side, from![1] + Math.sign(y - from![1]) * side];
      }
      return [[Math.min(x, from![0]), Math.max(x, from![0])], [Math.min(y, from![1]), Math.max(y, from![1])]];
    };
    this.svg.addEventListener("pointerdown", (event) => {
      if (event.button === 0 && event.pointerType === "mouse") from = pointer(event, this.svg) as Range;
    });
    this.svg.addEventListener("pointermove", (event) => {
      if (!from) return;
      const [x, y] = corners(event);
      box.attr("visibility", "visible").attr("x", x[0]).attr("y", y[0]).attr("width", x[1] - x[0]).attr("height", y[1] - y[0]);
    });
    const end = (event: PointerEvent) => {
      if (!from) return;
      const [x, y] = corners(event);
      from = null;
      box.attr("visibility", "hidden");
      if (x[1] - x[0] < 8 || y[1] - y[0] < 8 || !this.svg.scale("x")?.invert || !this.svg.scale("y")?.invert) return;
      this.view = {x: x.map((px) => this.value("x", px)) as Range, y: y.map((px) => this.value("y", px)).reverse() as Range};
      this.redraw();
    };
    this.svg.addEventListener("pointerup", end);
    this.svg.addEventListener("pointerleave", () => {
      from = null;
      box.attr("visibility", "hidden");
    });
    this.svg.addEventListener("dblclick", () => this.act("all"));
  }

  // The pointer is put where the value lies: the tip is the same for all.
  private key(event: KeyboardEvent): void {
    const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1, Home: -Infinity, End: Infinity}[event.key];
    if (event.key === "Escape") this.point(null);
    if (step === undefined || !this.stops.length) return;
    event.preventDefault();
    this.at = Math.max(0, Math.min(this.stops.length - 1, this.at + step));
    this.point(this.stops[this.at]);
  }

  private point(stop: [unknown, number] | null): void {
    const area = this.svg.getBoundingClientRect();
    const scale = area.width / this.svg.viewBox.baseVal.width;
    const at = stop ? {clientX: area.left + this.px("x", stop[0]) * scale, clientY: area.top + this.px("y", stop[1]) * scale} : {};
    this.svg.dispatchEvent(new PointerEvent(stop ? "pointermove" : "pointerleave", {...at, bubbles: false, pointerType: "mouse"}));
    requestAnimationFrame(() => {
      const lines = [...this.svg.querySelectorAll("[aria-label=tip] tspan")].map((t) => t.textContent).filter(Boolean);
      find(this.place, ".said").textContent = stop ? lines.join(", ") : "";
    });
  }
}
