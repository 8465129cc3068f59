// A plot on its surface: ticks, curves with their errors, marks, and names at the ends of the curves.
import { drawMarker, pixels, thinned } from "./plot_parts.js";

/** @typedef {import("./plot_parts.js").Surface} Surface */
/** @typedef {import("./plot.js").Series} Series */
/** @typedef {import("./plot.js").Mark} Mark */
/** @typedef {import("./axis.js").Axis} Axis */

export class PlotDrawing {
  /** @param {Surface} surface @param {Record<string, string>} colours @param {Axis} x @param {Axis} y @param {number} knownUntil */
  constructor(surface, colours, x, y, knownUntil) {
    this.surface = surface;
    this.colours = colours;
    this.x = x;
    this.y = y;
    this.knownUntil = knownUntil;
    this.left = Math.min(x.from, x.to);
    this.right = Math.max(x.from, x.to);
    this.top = Math.min(y.from, y.to);
    this.bottom = Math.max(y.from, y.to);
  }

  /** @param {number[]} from @param {number[]} to @param {import("./surface.js").Stroke} stroke */
  straight(from, to, stroke) {
    this.surface.line([from, to], stroke);
  }

  frame() {
    const { surface, colours, left, right, bottom, x, y } = this;
    const small = { colour: colours.soft, size: 11 };
    for (const { value, text } of y.ticks(5)) {
      const at = y.pixel(value);
      this.straight([left, at], [right, at], { colour: colours.line, alpha: 0.5 });
      surface.text(text, [left - 7, at], { ...small, align: "right" });
    }
    for (const { value, text } of x.ticks(Math.max(3, Math.min(10, (right - left) / 70)))) {
      const at = x.pixel(value);
      this.straight([at, bottom], [at, bottom + 4], { colour: colours.soft });
      surface.text(text, [at, bottom + 13], { ...small, align: "center" });
    }
    this.straight([left, bottom], [right, bottom], { colour: colours.soft });
    const name = /** @type {const} */ ({ colour: colours.ink, size: 12, align: "center" });
    surface.text(x.label, [(left + right) / 2, bottom + 29], name);
    surface.text(y.label, [9, (this.top + bottom) / 2], { ...name, turned: true });
  }

  /** @param {Series[]} all @param {boolean} isOverX whether each curve goes from left to right only */
  curves(all, isOverX) {
    this.surface.clipped(this.left, this.top - 4, this.right - this.left + 1, this.bottom - this.top + 8, () => {
      for (const series of all) this.curve(series, isOverX);
    });
  }

  /** @param {Series} series @param {boolean} isOverX */
  curve(series, isOverX) {
    const colour = this.colours[series.colour] ?? series.colour;
    const every = pixels(series, this.x, this.y);
    const points = isOverX ? thinned(every, this.right - this.left) : every;
    if (series.error) this.band(points, series, colour);
    if (series.joined !== false) this.line(points, series, colour);
    if (!series.marker) return;
    for (const point of points) if (Number.isFinite(point[1])) drawMarker(this.surface, point, series.marker, colour);
  }

  /** What is not known any more is faint. @param {number[][]} points @param {Series} series @param {string} colour */
  line(points, series, colour) {
    const stroke = { colour, width: series.width ?? 1.5, dash: series.dash, alpha: series.alpha ?? 1 };
    if (!Number.isFinite(this.knownUntil)) {
      this.surface.line(points, stroke);
      return;
    }
    const cut = this.x.pixel(this.knownUntil);
    this.surface.line(
      points.filter(([x]) => x <= cut),
      stroke,
    );
    this.surface.line(
      points.filter(([x]) => x >= cut),
      { ...stroke, alpha: 0.3 },
    );
  }

  /**
   * The stated error is that of the worst row. Up to the horizon it is at most a thousandth of the column's size. At true
   * scale: where it is thinner than a pixel it cannot be seen, and the label says it.
   * @param {number[][]} points @param {Series} series @param {string} colour
   */
  band(points, series, colour) {
    const size = Array.from(series.y).reduce((most, value) => Math.max(most, Math.abs(value) || 0), 0);
    const worst = series.error ?? 0;
    const cut = this.x.pixel(this.knownUntil);
    this.strip(
      points.filter(([x]) => !(x > cut)),
      Number.isFinite(this.knownUntil) ? Math.min(worst, 1e-3 * size) : worst,
      colour,
    );
    this.strip(
      points.filter(([x]) => x > cut),
      worst,
      colour,
    );
  }

  /** @param {number[][]} points @param {number} error in the units of y @param {string} colour */
  strip(points, error, colour) {
    const scale = (this.bottom - this.top) / (this.y.high - this.y.low);
    const half = Math.min(error * scale, 1e4);
    const usable = points.filter(([, y]) => Number.isFinite(y));
    if (half < 0.5 || usable.length < 2) return;
    this.surface.area(
      [...usable.map(([x, y]) => [x, y - half]), ...usable.reverse().map(([x, y]) => [x, y + half])],
      colour,
      0.16,
    );
  }

  /** @param {Mark[]} marks */
  marks(marks) {
    /** @type {Mark[]} */
    const horizon = Number.isFinite(this.knownUntil) ? [{ x: this.knownUntil, label: "known until here" }] : [];
    let free = -Infinity;
    for (const mark of [...marks, ...horizon]) {
      if (mark.y !== undefined) this.level(mark, mark.y);
      else free = this.instant(mark, this.x.pixel(mark.x ?? 0), free);
    }
  }

  /** @param {Mark} mark @param {number} y */
  level({ label, colour = "soft" }, y) {
    const stroke = { colour: this.colours[colour] ?? colour };
    const at = this.y.pixel(y);
    this.straight([this.left, at], [this.right, at], { ...stroke, dash: [5, 4] });
    if (label) this.surface.text(label, [this.left + 6, at - 9], { ...stroke, size: 11 });
  }

  /** @param {Mark} mark @param {number} at pixel @param {number} free where there is room for words @returns {number} the same after it */
  instant({ label, colour = "soft", kind = "line" }, at, free) {
    if (at < this.left - 1 || at > this.right + 1) return free;
    const stroke = { colour: this.colours[colour] ?? colour };
    const isTick = kind === "tick";
    this.straight([at, isTick ? this.bottom - 9 : this.top], [at, this.bottom], { ...stroke, dash: isTick ? [] : [5, 4] });
    if (!label || at <= free) return free;
    const isLate = at + 6.5 * label.length > this.right;
    const place = [isLate ? at - 4 : at + 4, isTick ? this.bottom - 14 : this.top + 7];
    this.surface.text(label, place, { ...stroke, size: 11, align: isLate ? "right" : "left" });
    return at + 7 * label.length;
  }

  /** Names at the ends of the curves, pushed apart where they would overlap. @param {Series[]} all */
  labels(all) {
    const { surface, colours, right } = this;
    const labels = all
      .filter((series) => series.label)
      .map((series) => ({ series, y: this.y.pixel(Array.from(series.y).findLast(Number.isFinite) ?? 0) }))
      .sort((a, b) => a.y - b.y);
    const room = labels.some(({ series }) => series.note) ? 27 : 15;
    let next = this.top + 6;
    labels.forEach(({ series, y }, i) => {
      const at = Math.max(next, Math.min(y, this.bottom - (labels.length - 1 - i) * room - (room - 12)));
      const colour = colours[`${series.colour}-text`] ?? colours[series.colour] ?? series.colour;
      surface.text(series.label ?? "", [right + 7, at], { colour, size: 13 });
      if (series.note) surface.text(series.note, [right + 7, at + 13], { colour: colours.soft, size: 10 });
      next = at + room;
    });
  }
}
