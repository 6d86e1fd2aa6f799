// A chart in its frame: drawn by Observable Plot, drawn again when its place changes; saved as SVG or PNG; enlarged by buttons
// or by dragging a box, and shown whole again; one tip for pointer and arrow keys alike.

import * as Plot from "@observablehq/plot";
import {brush, brushX, pointer, select} from "d3";
import {find, html, fill} from "./html";
import {saveSvg, savePng} from "./save";

export type Range = [number, number];

/// A place that has something to say: one fact a line.
export interface Point {
  x: unknown;
  y: unknown;
  words: string;
}

export interface Drawing {
  label: string;         // the chart in words
  x: Plot.ScaleOptions;
  y: Plot.ScaleOptions & {tickSpacing?: number};
  marks: Plot.Markish[];
  points?: Point[];
  every?: number;        // the arrow keys visit every second, third ... of the points
  height?: number;       // px; without: equal scales on both axes for ranges of equal span
  grid?: "x" | "xy" | "zero" | "none";
  plot?: Plot.PlotOptions;  // margins, colours
}

export interface Options {
  name: string;          // of the files that are saved
  draw: (width: number) => Drawing;
  zoom?: "box" | "square" | "none";
  brush?: (range: Range | null) => void;  // a stretch of x that was marked, instead of enlarging
  click?: (x: number) => void;
  most?: number;         // widest, px
  least?: number;        // narrowest, px: below it the chart scrolls in its place
}

const MARGIN = {left: 56, right: 14, top: 26, bottom: 40};
const TIP = {fill: "var(--card)", stroke: "var(--axis)", fontSize: 12.5, maxRadius: 30, lineWidth: 40, clip: false};

function grid(which: string, tickSpacing?: number): Plot.Markish[] {
  const line = {stroke: "var(--grid)", strokeOpacity: 1};
  return [which !== "none" && Plot.gridX(line), ["xy", "zero"].includes(which) && Plot.gridY({...line, tickSpacing}),
    which === "zero" && [Plot.ruleX([0], {stroke: "var(--axis)"}), Plot.ruleY([0], {stroke: "var(--axis)"})]].filter(Boolean) as Plot.Markish[];
}

const seen = (scale: Plot.ScaleOptions, view?: Range): Plot.ScaleOptions => (view ? {...scale, domain: view, nice: false} : scale);

// Its group has no role that may bear Plot's label.
const tipOf = (points: Point[]): Plot.Markish =>
    Object.assign(Plot.tip(points, Plot.pointer({x: "x", y: "y", title: "words", className: "tip", ...TIP})), {ariaLabel: undefined});

type Placed = SVGSVGElement & Plot.Plot;

export class Chart {
  private view: {x?: Range; y?: Range} = {};
  private svg!: Placed;
  private stops: Point[] = [];
  private at = -1;
  private width = 0;

  constructor(private readonly place: HTMLElement, private readonly options: Options) {
    const button = (act: string, sign: string, words: string) =>
        html`<button type="button" data-act="${act}" aria-label="${words}: ${options.name}" title="${words}">${sign}</button>`;
    fill(place, html`<div class="plot" tabindex="0" role="group"></div>
      <div class="chart-tools" role="group" aria-label="${options.name}">${options.zoom !== "none" && !options.brush && [
        button("in", "+", "Enlarge"), button("out", "\u2212", "Reduce"), button("all", "All", "Show all")]}
        ${[button("svg", "SVG", "Save as SVG"), button("png", "PNG", "Save as PNG")]}
        <span class="said" aria-live="polite"></span></div>`);
    place.classList.add("chart", ...(options.least ? ["scrolls"] : []));
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
    const width = Math.max(this.options.least ?? 250, Math.min(this.options.most ?? 640, this.width || 480));
    const {label, x, y, marks, points = [], every = 1, height, grid: lines = "zero", plot = {}} = this.options.draw(width);
    this.stops = points.filter((_, i) => i % every === 0);
    this.svg = Plot.plot({
      width, height: height ?? width - MARGIN.left - MARGIN.right + MARGIN.top + MARGIN.bottom,
      marginLeft: MARGIN.left, marginRight: MARGIN.right, marginTop: MARGIN.top, marginBottom: MARGIN.bottom, clip: true, ...plot,
      style: {fontSize: "12px", overflow: "visible"}, x: {labelAnchor: "center", ...seen(x, this.view.x)}, y: seen(y, this.view.y),
      marks: [grid(lines, y.tickSpacing), marks, points.length ? tipOf(points) : null],
    }) as Placed;
    const links = this.svg.querySelectorAll("a");  // where the points are, in their order
    this.svg.setAttribute("role", links.length ? "group" : "img");
    this.svg.setAttribute("aria-label", label);
    this.svg.dataset.chart = this.options.name;
    this.svg.querySelectorAll("[aria-label]").forEach((mark) => mark.removeAttribute("aria-label"));  // the label above says it all
    links.forEach((link, i) => link.setAttribute("aria-label", points[i].words.replace(/\n/g, " ")));
    const box = find(this.place, ".plot");
    box.setAttribute("aria-label", `${this.options.name}. Arrow keys read the values.`);
    box.replaceChildren(this.svg);
    if (this.options.zoom !== "none") this.addBrush();
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

  private range(axis: "x" | "y"): Range {
    return [...this.svg.scale(axis)!.range as Range].sort((a, b) => a - b) as Range;
  }

  /// A mark that moves with time, without drawing the chart again.
  cursor(places: {x: number; y?: number; colour: string}[]): void {
    const layer = select(this.svg).selectAll<SVGGElement, number>("g.cursor").data([0]).join("g").attr("class", "cursor overlay");
    const [low, high] = this.range("y");
    layer.selectAll("line").data(places.filter((p) => p.y === undefined)).join("line")
        .attr("x1", (p) => this.px("x", p.x)).attr("x2", (p) => this.px("x", p.x)).attr("y1", low).attr("y2", high)
        .style("stroke", (p) => p.colour);
    layer.selectAll("circle").data(places.filter((p) => p.y !== undefined)).join("circle").attr("r", 6)
        .attr("cx", (p) => this.px("x", p.x)).attr("cy", (p) => this.px("y", p.y)).style("fill", (p) => p.colour);
  }

  private act(act: string): void {
    if (act === "svg") saveSvg(this.svg, this.options.name);
    else if (act === "png") void savePng(this.svg, this.options.name);
    else if (act === "all") this.show();
    else this.show(this.about("x", act === "in" ? 0.5 : 2), this.about("y", act === "in" ? 0.5 : 2));
  }

  private show(x?: Range, y?: Range): void {
    const values = (axis: "x" | "y", px?: Range) => px && this.svg.scale(axis)?.invert && px.map((p) => this.value(axis, p)).sort((a, b) => a - b) as Range;
    this.view = {x: values("x", x), y: values("y", y)};
    this.redraw();
  }

  /// The axis about the value that was read last, or its middle, px.
  private about(axis: "x" | "y", by: number): Range {
    const stop = this.stops[this.at];
    const [low, high] = this.range(axis);
    const middle = stop ? this.px(axis, stop[axis]) : (low + high) / 2;
    return [middle + (low - middle) * by, middle + (high - middle) * by];
  }

  // Below the marks, which let the pointer through, so that a drag can begin anywhere.
  private addBrush(): void {
    const tell = this.options.brush;
    const [x, y] = [this.range("x"), this.range("y")];
    const drag = tell ? brushX<unknown>() : brush<unknown>().touchable(false);
    drag.extent([[x[0], y[0]], [x[1], y[1]]]).on(tell ? "brush end" : "end", ({selection, sourceEvent}) => {
      if (!sourceEvent) return;
      if (tell) tell(selection ? (selection as Range).map((px) => this.value("x", px)) as Range : null);
      else if (selection) this.enlarge(selection as [Range, Range]);
    });
    select(this.svg).selectAll("path, line, circle").style("pointer-events", "none");
    select(this.svg).insert("g", "g").attr("class", `${tell ? "brush" : "zoom"} overlay`).call(drag as never);
    if (!tell) this.svg.addEventListener("dblclick", () => this.show());
  }

  private enlarge([[left, top], [right, bottom]]: [Range, Range]): void {
    const square = Math.max(right - left, bottom - top);
    const [w, h] = this.options.zoom === "square" ? [square, square] : [right - left, bottom - top];
    if (w < 8 || h < 8) return this.redraw();
    const [x, y] = [(left + right) / 2, (top + bottom) / 2];
    this.show([x - w / 2, x + w / 2], [y - h / 2, y + h / 2]);
  }

  // The pointer is put where the value lies: the tip is the same for all.
  private key(event: KeyboardEvent): void {
    const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1, Home: -Infinity, End: Infinity}[event.key];
    if (event.key === "Escape") this.point();
    if (step === undefined || !this.stops.length) return;
    event.preventDefault();
    this.at = Math.max(0, Math.min(this.stops.length - 1, this.at + step));
    this.point(this.stops[this.at]);
  }

  private point(stop?: Point): void {
    const area = this.svg.getBoundingClientRect();
    const scale = area.width / this.svg.viewBox.baseVal.width;
    const at = stop && {clientX: area.left + this.px("x", stop.x) * scale, clientY: area.top + this.px("y", stop.y) * scale};
    this.svg.dispatchEvent(new PointerEvent(stop ? "pointermove" : "pointerleave", {...at, bubbles: false, pointerType: "mouse"}));
    find(this.place, ".said").textContent = stop ? stop.words.replace(/\n+/g, ", ") : "";
  }
}
