// A plot: curves with the stated error as a band, direct labels, ticks of events, and what is not known any more faded.
import { Axis } from "./axis.js";
import { download, element } from "./dom.js";
import { palette } from "./painter.js";
import { PlotDrawing } from "./plot_drawing.js";
import { CanvasSurface, SvgSurface } from "./surface.js";

/** @typedef {{ x: ArrayLike<number>, y: ArrayLike<number>, colour: string, label?: string, note?: string, error?: number, dash?: number[], width?: number, alpha?: number, marker?: "dot" | "ring" | "square" | "cross" | "diamond" | "triangle", joined?: boolean }} Series */
/** @typedef {{ x?: number, y?: number, label?: string, colour?: string, kind?: "tick" | "line" }} Mark */
/** @typedef {{ title: string, x: import("./axis.js").Axis | any, y: any, isSquare?: boolean, hasEqualScales?: boolean, hasLabels?: boolean, onSeek?: (x: number) => void, onPick?: (x: number, y: number) => void, isDraggable?: boolean, onZoom?: (range: [number, number] | null) => void, height?: number }} PlotOptions */

export class Plot {
  /** @param {PlotOptions} options */
  constructor(options) {
    this.options = options;
    this.x = new Axis(options.x);
    this.y = new Axis(options.y);
    /** @type {Series[]} */
    this.series = [];
    /** @type {Mark[]} */
    this.marks = [];
    this.knownUntil = Infinity;
    this.least = [0, 0];
    /** @type {[number, number] | null} */
    this.zoomed = null;
    this.canvas = element("canvas", {
      class: options.isSquare ? "plot square" : "plot",
      role: "img",
      tabindex: "0",
      "aria-label": options.title,
    });
    this.cursor = element("div", { class: "cursor", hidden: true });
    this.frame = element("div", { class: options.isSquare ? "plot-frame square" : "plot-frame" }, this.canvas, this.cursor);
    this.node = element(
      "figure",
      { class: "figure" },
      element("figcaption", {}, element("span", {}, options.title), this.tools()),
      this.frame,
    );
    this.listen();
  }

  tools() {
    const name = this.options.title.replace(/\W+/g, "-").toLowerCase();
    return element(
      "span",
      { class: "tools" },
      element(
        "button",
        { type: "button", class: "quiet", onclick: () => this.zoom(null), title: "Shows the whole again" },
        "whole",
      ),
      element(
        "button",
        {
          type: "button",
          class: "quiet",
          onclick: () => download(`${name}.svg`, new Blob([this.svg()], { type: "image/svg+xml" })),
        },
        "SVG",
      ),
      element(
        "button",
        { type: "button", class: "quiet", onclick: () => this.canvas.toBlob((blob) => blob && download(`${name}.png`, blob)) },
        "PNG",
      ),
    );
  }

  /** @param {string} title */
  setTitle(title) {
    const words = this.node.querySelector("figcaption span");
    if (words && words.textContent !== title) words.textContent = title;
  }

  /** @param {{ series: Series[], marks?: Mark[], knownUntil?: number, said?: string }} content */
  set({ series, marks = [], knownUntil = Infinity, said }) {
    this.series = series;
    this.marks = marks;
    this.knownUntil = knownUntil;
    if (said) this.canvas.setAttribute("aria-label", said);
    this.resize();
  }

  listen() {
    new ResizeObserver(() => this.resize()).observe(this.frame);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
    this.canvas.addEventListener("pointerdown", (event) => this.select(event));
    this.canvas.addEventListener("dblclick", () => this.zoom(null));
    this.canvas.addEventListener("keydown", (event) => this.key(event));
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const [low, high] = [this.x.value(this.x.from), this.x.value(this.x.to)];
    const at = this.cursorAt ?? this.x.value((this.x.from + this.x.to) / 2);
    const beside = (/** @type {number} */ share) => this.x.value(this.x.pixel(at) + share * (this.x.to - this.x.from));
    const { onSeek, onPick } = this.options;
    const move = onSeek ?? (onPick && ((/** @type {number} */ x) => this.showCursor(x)));
    if (event.key === "ArrowLeft") move?.(beside(-1 / 200));
    else if (event.key === "ArrowRight") move?.(beside(1 / 200));
    else if (event.key === "Enter" && onPick) onPick(at, NaN);
    else if (event.key === "+" && !this.x.isLogarithmic) this.zoom([at - (high - low) / 4, at + (high - low) / 4]);
    else if (event.key === "-" || event.key === "0") this.zoom(null);
    else return;
    event.preventDefault();
  }

  /** A click goes to that instant; a drag zooms, or takes along what can be picked. @param {PointerEvent} event */
  select(event) {
    const box = this.canvas.getBoundingClientRect();
    const begin = event.clientX - box.left;
    const pick = (/** @type {PointerEvent} */ now) =>
      this.options.onPick?.(this.x.value(now.clientX - box.left), this.y.value(now.clientY - box.top));
    this.canvas.setPointerCapture(event.pointerId);
    if (this.options.isDraggable) this.canvas.addEventListener("pointermove", pick);
    const end = (/** @type {PointerEvent} */ last) => {
      this.canvas.removeEventListener("pointermove", pick);
      this.canvas.removeEventListener("pointerup", end);
      this.canvas.removeEventListener("pointercancel", end);
      if (last.type === "pointercancel") return;
      const [a, b] = [this.x.value(begin), this.x.value(last.clientX - box.left)];
      const isClick = Math.abs(last.clientX - event.clientX) < 5;
      if (isClick) this.options.onSeek?.(a);
      if (isClick || this.options.isDraggable) pick(last);
      else if (!this.x.isLogarithmic && !this.options.onPick) this.zoom([Math.min(a, b), Math.max(a, b)]);
    };
    this.canvas.addEventListener("pointerup", end);
    this.canvas.addEventListener("pointercancel", end);
  }

  /** @param {[number, number] | null} range */
  zoom(range) {
    this.zoomed = range;
    this.redraw();
    this.options.onZoom?.(range);
  }

  resize() {
    const box = this.frame.getBoundingClientRect();
    if (!box.width) return;
    this.width = box.width;
    this.height = this.options.isSquare ? Math.min(box.width, 420) : (this.options.height ?? 200);
    const density = Math.min(3, window.devicePixelRatio || 1);
    this.canvas.style.height = `${this.height}px`;
    this.canvas.width = Math.round(this.width * density);
    this.canvas.height = Math.round(this.height * density);
    this.redraw();
  }

  redraw() {
    const context = this.canvas.getContext("2d");
    if (!context || !this.width || !this.height) return;
    const density = this.canvas.width / this.width;
    context.setTransform(density, 0, 0, density, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    this.draw(new CanvasSurface(context), palette());
    this.showCursor(this.cursorAt);
  }

  svg() {
    const surface = new SvgSurface();
    this.draw(surface, palette());
    return surface.file(this.width ?? 600, this.height ?? 200, palette().paper);
  }

  /** @param {CanvasSurface | SvgSurface} surface @param {Record<string, string>} colours */
  draw(surface, colours) {
    this.layout();
    const drawing = new PlotDrawing(surface, colours, this.x, this.y, this.knownUntil);
    drawing.frame();
    drawing.curves(this.series, !this.options.isSquare);
    drawing.marks(this.marks);
    if (this.options.hasLabels !== false) drawing.labels(this.series);
  }

  /** What the axes show. */
  ranges() {
    const all = (/** @type {"x" | "y"} */ name) => this.series.flatMap((series) => Array.from(series[name]));
    const ends = this.marks.flatMap(({ x, kind }) => (x !== undefined && kind === "line" ? [x] : []));
    const isOverTime = this.options.onSeek && !this.options.isSquare;
    this.x.hold(this.zoomed ?? [...all("x"), ...ends], this.zoomed || isOverTime ? 0 : 0.05);
    this.y.hold(this.zoomed ? this.seen() : all("y"));
  }

  layout() {
    const [width, height] = [this.width ?? 600, this.height ?? 200];
    this.ranges();
    const [left, right] = this.margins();
    this.x.place(Math.max(left, this.least[0]), width - Math.max(right, this.least[1]));
    this.y.place(height - 38, 10);
    if (this.options.hasEqualScales) this.equalize();
  }

  /** What the numbers at the left and the names at the right need, in pixels. */
  margins() {
    const widest = this.y.ticks(5).reduce((most, tick) => Math.max(most, tick.text.length), 0);
    const hasLabels = this.options.hasLabels !== false && this.series.some((series) => series.label);
    const longest = this.series.reduce(
      (most, { label = "", note = "" }) => Math.max(most, 8 * label.length, 5.8 * note.length),
      0,
    );
    return [30 + 7 * widest, hasLabels ? Math.min(0.32 * (this.width ?? 600), 14 + longest) : 16];
  }

  /** Plots below each other begin and end at the same place. @param {Plot[]} plots */
  static align(plots) {
    const all = plots.map((plot) => {
      plot.ranges();
      return plot.margins();
    });
    const least = [0, 1].map((side) => Math.max(0, ...all.map((margins) => margins[side])));
    for (const plot of plots) {
      plot.least = least;
      plot.redraw();
    }
  }

  /** A circle is a circle: the axis with more pixels a unit is shown further. */
  equalize() {
    const scale = (/** @type {Axis} */ axis) => Math.abs(axis.to - axis.from) / (axis.high - axis.low);
    const least = Math.min(scale(this.x), scale(this.y));
    for (const axis of [this.x, this.y]) {
      const missing = (Math.abs(axis.to - axis.from) / least - (axis.high - axis.low)) / 2;
      axis.low -= missing;
      axis.high += missing;
    }
  }

  /** The values inside the zoomed range. */
  seen() {
    const [low, high] = this.zoomed ?? [-Infinity, Infinity];
    return this.series.flatMap(({ x, y }) => Array.from(y).filter((_, i) => x[i] >= low && x[i] <= high));
  }

  /** A dot where the motion is. @param {number} x @param {number} y */
  showDot(x, y) {
    this.cursor.className = "cursor dot";
    this.cursor.hidden = false;
    this.cursor.style.transform = `translate(${this.x.pixel(x)}px, ${this.y.pixel(y)}px)`;
  }

  /** @param {number | undefined} x */
  showCursor(x) {
    if (this.cursor.className !== "cursor") return;
    this.cursorAt = x;
    const at = x === undefined ? NaN : this.x.pixel(x);
    const isInside = at >= Math.min(this.x.from, this.x.to) - 1 && at <= Math.max(this.x.from, this.x.to) + 1;
    this.cursor.hidden = !isInside;
    if (isInside) this.cursor.style.transform = `translateX(${at}px)`;
  }
}
