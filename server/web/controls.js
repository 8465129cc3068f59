// A number: its name, a slider over the useful part of its domain, and a field that takes units and expressions.
import { element, fill } from "./dom.js";
import { short, symbolNode, unitText } from "./numbers.js";

/** @typedef {{ name: string, title?: string, unit: string, meaning?: string, domain?: any, default?: any }} Declared */

/** @param {any} domain "> 0" or { exclusiveMinimum: 0 } @returns {{ low: number, high: number, open: boolean }} */
function bounds(domain) {
  if (!domain) return { low: -Infinity, high: Infinity, open: false };
  if (typeof domain !== "string") {
    return {
      low: domain.exclusiveMinimum ?? domain.minimum ?? -Infinity,
      high: domain.exclusiveMaximum ?? domain.maximum ?? Infinity,
      open: "exclusiveMinimum" in domain,
    };
  }
  const result = { low: -Infinity, high: Infinity, open: false };
  for (const [, sign, number] of domain.matchAll(/([<>]=?)\s*(-?[\d.e+-]+)/g)) {
    if (sign.startsWith(">")) Object.assign(result, { low: Number(number), open: sign === ">" });
    else result.high = Number(number);
  }
  return result;
}

/** @typedef {{ low: number, high: number, isLogarithmic: boolean }} Range */

/** The domain made useful. @param {Declared} declared @param {number} value @returns {Range} */
export function usefulRange({ domain, unit }, value) {
  const { low, high, open } = bounds(domain);
  const size = Math.abs(value) || 1;
  if (Number.isFinite(low) && Number.isFinite(high)) return { low, high, isLogarithmic: false };
  if (low === 0 && open) return { low: size / 10, high: size * 10, isLogarithmic: true };
  if (Number.isFinite(low)) return { low, high: low + 3 * size, isLogarithmic: false };
  if (unit === "rad") return { low: -Math.PI, high: Math.PI, isLogarithmic: false };
  return { low: -3 * size, high: Math.min(high, 3 * size), isLogarithmic: false };
}

/** @param {Range} range @param {number} value */
const toSlider = ({ low, high, isLogarithmic }, value) =>
  isLogarithmic ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
/** @param {Range} range @param {number} place */
const fromSlider = ({ low, high, isLogarithmic }, place) =>
  isLogarithmic ? low * (high / low) ** place : low + place * (high - low);

let count = 0;

export class NumberControl {
  /** @param {Declared} declared @param {number} initial @param {(text: string | null) => void} change null: back to the default */
  constructor(declared, initial, change) {
    this.declared = declared;
    this.change = change;
    this.range = usefulRange(declared, initial);
    const id = `number-${++count}`;
    this.slider = element("input", {
      type: "range",
      min: "0",
      max: "1",
      step: "any",
      "aria-label": `${declared.name}, slider`,
      oninput: () => this.slid(),
      ondblclick: () => this.change(null),
    });
    this.field = element("input", {
      type: "text",
      id,
      class: "value",
      inputmode: "text",
      autocomplete: "off",
      spellcheck: "false",
      "aria-describedby": `${id}-problem`,
      onchange: () => this.change(this.field.value.trim() || null),
    });
    this.problem = element("div", { class: "problem", id: `${id}-problem` });
    this.node = element(
      "div",
      { class: "number-row" },
      element(
        "label",
        { for: id, title: declared.meaning ?? "" },
        declared.title ? declared.title : symbolNode(declared.name),
        element("span", { class: "meaning" }, declared.meaning ?? ""),
      ),
      this.slider,
      this.field,
      element("span", { class: "unit" }, unitText(declared.unit)),
      this.problem,
    );
    this.show(initial);
  }

  slid() {
    const value = Number(fromSlider(this.range, Number(this.slider.value)).toPrecision(3));
    this.field.value = String(value);
    this.slider.setAttribute("aria-valuetext", `${value} ${this.declared.unit}`);
    this.change(String(value));
  }

  /** @param {number} value @param {string} [typed] what stands in the field, where it is not the number */
  show(value, typed) {
    if (value < this.range.low || value > this.range.high) this.range = usefulRange(this.declared, value);
    if (document.activeElement !== this.slider) this.slider.value = String(toSlider(this.range, value));
    this.slider.setAttribute("aria-valuetext", `${short(value)} ${this.declared.unit}`);
    if (document.activeElement !== this.field) this.field.value = typed ?? String(Number(value.toPrecision(5)));
    this.field.title = String(value);
    this.clear();
  }

  clear() {
    fill(this.problem);
    this.field.removeAttribute("aria-invalid");
  }

  /** @param {import("./api.js").FieldError} error */
  complain(error) {
    this.field.setAttribute("aria-invalid", "true");
    const wanted = error.did_you_mean;
    fill(
      this.problem,
      error.detail,
      " ",
      wanted && element("button", { type: "button", onclick: () => this.change(wanted) }, `use ${wanted}`),
    );
  }
}
