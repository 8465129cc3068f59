// One axis of a plot: numbers to pixels and back, and where its ticks are.
import { short } from "./numbers.js";

/** @param {number} span @param {number} most */
function niceStep(span, most) {
  const rough = span / most;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].find((factor) => factor * power >= rough) ?? 10;
  return step * power;
}

export class Axis {
  /** @param {{ label: string, isLogarithmic?: boolean, isReversed?: boolean }} options */
  constructor({ label, isLogarithmic = false, isReversed = false }) {
    this.label = label;
    this.isLogarithmic = isLogarithmic;
    this.isReversed = isReversed;
    this.low = 0;
    this.high = 1;
    this.from = 0;
    this.to = 1;
  }

  /** @param {number} value */
  scaled(value) {
    return this.isLogarithmic ? Math.log10(value) : value;
  }

  /** The range that holds these values, with some air. @param {number[]} values @param {number} [air] */
  hold(values, air = 0.06) {
    const usable = values.filter((value) => Number.isFinite(this.scaled(value)));
    let low = usable.reduce((a, b) => Math.min(a, b), Infinity);
    let high = usable.reduce((a, b) => Math.max(a, b), -Infinity);
    if (!(low <= high)) [low, high] = this.isLogarithmic ? [0.1, 10] : [0, 1];
    let [a, b] = [this.scaled(low), this.scaled(high)];
    // What changes by less than a hundredth of a percent is drawn flat: the eye would take round-off for a motion.
    const size = Math.max(Math.abs(a), Math.abs(b));
    if (b - a <= 1e-4 * size) [a, b] = [a - 0.05 * (size || 20), b + 0.05 * (size || 20)];
    const extra = air * (b - a);
    this.low = a - extra;
    this.high = b + extra;
  }

  /** @param {number} from pixel @param {number} to pixel */
  place(from, to) {
    [this.from, this.to] = this.isReversed ? [to, from] : [from, to];
  }

  /** @param {number} value */
  pixel(value) {
    return this.from + ((this.scaled(value) - this.low) / (this.high - this.low)) * (this.to - this.from);
  }

  /** @param {number} pixel */
  value(pixel) {
    const scaled = this.low + ((pixel - this.from) / (this.to - this.from)) * (this.high - this.low);
    return this.isLogarithmic ? 10 ** scaled : scaled;
  }

  /** @param {number} most @returns {{ value: number, text: string }[]} */
  ticks(most) {
    const step = this.isLogarithmic
      ? Math.max(1, Math.ceil((this.high - this.low) / most))
      : niceStep(this.high - this.low, most);
    const ticks = [];
    for (let k = Math.ceil(this.low / step - 1e-9); k * step <= this.high + 1e-9 * step; ++k) {
      const scaled = Number((k * step).toPrecision(12));
      const value = this.isLogarithmic ? 10 ** scaled : scaled;
      ticks.push({ value, text: this.isLogarithmic ? powerText(scaled) : short(value, 6) });
    }
    return ticks;
  }
}

/** @param {number} power */
function powerText(power) {
  if (power >= 0 && power < 4) return String(10 ** power);
  return "10" + [...String(power)].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)])).join("");
}
