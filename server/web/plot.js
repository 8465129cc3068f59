// A plot: curves with the stated error as a band, direct labels, ticks of events, and what is not known any more faded.
import { Axis } from "./axis.js";
import { download, element } from "./dom.js";
import { palette } from "./painter.js";
import { drawLabels, drawMarker, pixels, thinned } from "./plot_parts.js";
import { CanvasSurface, SvgSurface } from "./surface.js";

/** @typedef {{ x: ArrayLike<number>, y: ArrayLike<number>, colour: string, label?: string, note?: string, error?: number, dash?: number[], width?: number, alpha?: number, marker?: "dot" | "ring" | "square" | "cross" | "diamond" | "triangle", joined?: boolean }} Series */
/** @typedef {{ x?: number, y?: number, label?: string, colour?: string, kind?: "tick" | "line" }} Mark */
/** @typedef {{ title: string, x: import("./axis.js").Axis | any, y: any, isSquare?: boolean, hasEqualScales?: boolean, hasLabels?: boolean, onSeek?: (x: number) => void, onPick?: (x: number, y: number) => void, isDraggable?: boolean, height?: number }} PlotOptions */

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
    /** @type {[number, number] | null} */
    this.zoomed = null;
    this.canvas = element("canvas", { class: options.isSquare ? "plot square" : "plot", role: "img", tabindex: "0", "aria-label": options.title });
    this.cursor = element("div", { class: "cursor", hidden: true });
    this.frame = element("div", { class: options.isSquare ? "plot-frame square" : "plot-frame" }, this.canvas, this.cursor);
    this.node = element("figure", { class: "figure" }, element("figcaption", {}, element("span", {}, options.title), this.tools()), this.frame);
    this.listen();
  }

  tools() {
    const name = this.options.title.replace(/\W+/g, "-").toLowerCase();
    return element("span", { class: "tools" },
      element("button", { type: "button", class: "quiet", onclick: () => this.zoom(null), title: "Shows the whole again" }, "whole"),
      element("button", { type: "button", class: "quiet", onclick: () => download(`${name}.svg`, new Blob([this.svg()], { type: "image/svg+xml" })) }, "SVG"),
      element("button", { type: "button", class: "quiet", onclick: () => this.canvas.toBlob((blob) => blob && download(`${name}.png`, blob)) }, "PNG"));
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
    const at = this.cursorAt ?? (low + high) / 2;
    const step = (high - low) / 200;
    if (event.key === "ArrowLeft") this.options.onSeek?.(at - step);
    else if (event.key === "ArrowRight") this.options.onSeek?.(at + step);
    else if (event.key === "+" && !this.x.isLogarithmic) this.zoom([at - (high - low) / 4, at + (high - low) / 4]);
    else if (event.key === "-" || event.key === "0") this.zoom(null);
    else return;
    event.preventDefault();
  }

  /** A click goes to that instant; a drag zooms, or takes along what can be picked. @param {PointerEvent} event */
  select(event) {
    const box = this.canvas.getBoundingClientRect();
    const begin = event.clientX - box.left;
    const pick = (/** @type {PointerEvent} */ now) => this.options.onPick?.(this.x.value(now.clientX - box.left), this.y.value(now.clientY - box.top));
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
  }

  resize() {
    const box = this.frame.getBoundingClientRect();
    if (!box.width) return;
    this.width = box.width;
    this.height = this.options.isSquare ? Math.min(box.width, 420) : this.options.height ?? 200;
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
    this.drawFrame(surface, colours);
    const [left, right] = [Math.min(this.x.from, this.x.to), Math.max(this.x.from, this.x.to)];
    const [top, bottom] = [Math.min(this.y.from, this.y.to), Math.max(this.y.from, this.y.to)];
    surface.clipped(left, top - 4, right - left + 1, bottom - top + 8, () => {
      for (const series of this.series) this.drawSeries(surface, series, colours);
    });
    this.drawMarks(surface, colours, top, bottom);
    if (this.options.hasLabels !== false) drawLabels(surface, colours, this.series, this.y, right);
  }

  layout() {
    const [width, height] = [this.width ?? 600, this.height ?? 200];
    const all = (/** @type {"x" | "y"} */ name) => this.series.flatMap((series) => Array.from(series[name]));
    const ends = this.marks.flatMap(({ x, kind }) => (x !== undefined && kind === "line" ? [x] : []));
    this.x.hold(this.zoomed ?? [...all("x"), ...ends], this.zoomed || (this.options.onSeek && !this.options.isSquare) ? 0 : 0.05);
    this.y.hold(this.zoomed ? this.seen() : all("y"));
    const hasLabels = this.options.hasLabels !== false && this.series.some((series) => series.label);
    const longest = this.series.reduce((most, { label = "", note = "" }) => Math.max(most, 8 * label.length, 5.8 * note.length), 0);
    const room = hasLabels ? Math.min(0.32 * width, 14 + longest) : 16;
    const widest = this.y.ticks(5).reduce((most, tick) => Math.max(most, tick.text.length), 0);
    this.x.place(30 + 7 * widest, width - room);
    this.y.place(height - 38, 10);
    if (this.options.hasEqualScales) this.equalize();
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

  /** @param {CanvasSurface | SvgSurface} surface @param {Record<string, string>} colours */
  drawFrame(surface, colours) {
    const [left, right] = [Math.min(this.x.from, this.x.to), Math.max(this.x.from, this.x.to)];
    const bottom = this.y.from;
    for (const { value, text } of this.y.ticks(5)) {
      const y = this.y.pixel(value);
      surface.line([[left, y], [right, y]], { colour: colours.line, alpha: 0.5 });
      surface.text(text, [left - 7, y], { colour: colours.soft, size: 11, align: "right" });
    }
    for (const { value, text } of this.x.ticks(Math.max(3, Math.min(10, (right - left) / 70)))) {
      const x = this.x.pixel(value);
      surface.line([[x, bottom], [x, bottom + 4]], { colour: colours.soft });
      surface.text(text, [x, bottom + 13], { colour: colours.soft, size: 11, align: "center" });
    }
    surface.line([[left, bottom], [right, bottom]], { colour: colours.soft });
    surface.text(this.x.label, [(left + right) / 2, bottom + 29], { colour: colours.ink, size: 12, align: "center" });
    surface.text(this.y.label, [9, (this.y.from + this.y.to) / 2], { colour: colours.ink, size: 12, align: "center", turned: true });
  }

  /** @param {CanvasSurface | SvgSurface} surface @param {Series} series @param {Record<string, string>} colours */
  drawSeries(surface, series, colours) {
    const colour = colours[series.colour] ?? series.colour;
    const points = this.options.isSquare ? pixels(series, this.x, this.y) : thinned(pixels(series, this.x, this.y), Math.abs(this.x.to - this.x.from));
    if (series.error) this.drawBand(surface, points, series, colour);
    if (series.joined !== false) {
      const cut = this.x.pixel(this.knownUntil);
      const fades = Number.isFinite(this.knownUntil);
      const known = fades ? points.filter(([x]) => x <= cut) : points;
      const stroke = { colour, width: series.width ?? 1.5, dash: series.dash, alpha: series.alpha ?? 1 };
      surface.line(known, stroke);
      if (fades) surface.line(points.filter(([x]) => x >= cut), { ...stroke, alpha: 0.3 });
    }
    if (series.marker) for (const [x, y] of points) if (Number.isFinite(y)) drawMarker(surface, [x, y], series.marker, colour);
  }

  /**
   * The stated error is that of the worst row. Up to the horizon it is at most a thousandth of the column's size. At true
   * scale: where it is thinner than a pixel it cannot be seen, and the label says it.
   * @param {CanvasSurface | SvgSurface} surface @param {number[][]} points @param {Series} series @param {string} colour
   */
  drawBand(surface, points, series, colour) {
    const scale = Math.abs(this.y.to - this.y.from) / (this.y.high - this.y.low);
    const size = Array.from(series.y).reduce((most, value) => Math.max(most, Math.abs(value) || 0), 0);
    const worst = series.error ?? 0;
    const cut = this.x.pixel(this.knownUntil);
    const early = Number.isFinite(this.knownUntil) ? Math.min(worst, 1e-3 * size) : worst;
    for (const [error, part] of /** @type {[number, number[][]][]} */ ([[early, points.filter(([x]) => !(x > cut))], [worst, points.filter(([x]) => x > cut)]])) {
      const half = Math.min(error * scale, 1e4);
      const usable = part.filter(([, y]) => Number.isFinite(y));
      if (half < 0.5 || usable.length < 2) continue;
      surface.area([...usable.map(([x, y]) => [x, y - half]), ...usable.reverse().map(([x, y]) => [x, y + half])], colour, 0.16);
    }
  }

  /** @param {CanvasSurface | SvgSurface} surface @param {Record<string, string>} colours @param {number} top @param {number} bottom */
  drawMarks(surface, colours, top, bottom) {
    const [left, right] = [Math.min(this.x.from, this.x.to), Math.max(this.x.from, this.x.to)];
    /** @type {Mark[]} */
    const marks = Number.isFinite(this.knownUntil) ? [...this.marks, { x: this.knownUntil, label: "known until here", kind: "line" }] : this.marks;
    let free = -Infinity;
    for (const { x, y, label, colour = "soft", kind = "line" } of marks) {
      const stroke = { colour: colours[colour] ?? colour };
      if (y !== undefined) {
        const at = this.y.pixel(y);
        surface.line([[left, at], [right, at]], { ...stroke, dash: [5, 4] });
        if (label) surface.text(label, [left + 6, at - 9], { ...stroke, size: 11 });
        continue;
      }
      const at = this.x.pixel(x ?? 0);
      if (at < left - 1 || at > right + 1) continue;
      surface.line([[at, kind === "tick" ? bottom - 9 : top], [at, bottom]], { ...stroke, dash: kind === "tick" ? [] : [5, 4] });
      if (label && at > free) {
        const isLate = at + 6.5 * label.length > right;
        surface.text(label, [isLate ? at - 4 : at + 4, kind === "tick" ? bottom - 14 : top + 7], { ...stroke, size: 11, align: isLate ? "right" : "left" });
        free = at + 7 * label.length;
      }
    }
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
