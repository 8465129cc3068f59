// Numbers, units and names as a textbook sets them.
import { element } from "./dom.js";

/** @type {Record<string, string>} */
const greek = {
  alpha: "α",
  beta: "β",
  gamma: "γ",
  delta: "δ",
  epsilon: "ε",
  zeta: "ζ",
  eta: "η",
  theta: "θ",
  kappa: "κ",
  lambda: "λ",
  mu: "μ",
  nu: "ν",
  xi: "ξ",
  rho: "ρ",
  sigma: "σ",
  tau: "τ",
  phi: "φ",
  chi: "χ",
  psi: "ψ",
  omega: "ω",
  Gamma: "Γ",
  Delta: "Δ",
  Theta: "Θ",
  Lambda: "Λ",
  Phi: "Φ",
  Psi: "Ψ",
  Omega: "Ω",
};
const subscripts = "₀₁₂₃₄₅₆₇₈₉";

/** "theta_dot" as θ̇, "l0" as l₀, "p_phi" as p_φ; other names as they are. @param {string} name @returns {string} */
export function symbol(name) {
  if (name.endsWith("_ddot")) return dotted(symbol(name.slice(0, -5)), "\u0308");
  if (name.endsWith("_dot")) return dotted(symbol(name.slice(0, -4)), "\u0307");
  if (name.startsWith("p_") && name.length > 2) return "p_" + symbol(name.slice(2));
  const parts = /^([A-Za-z]+?)_?(\d*)$/.exec(name);
  if (!parts) return name;
  const letter = greek[parts[1]] ?? parts[1];
  return letter + [...parts[2]].map((digit) => subscripts[Number(digit)]).join("");
}

const letters = new Set(Object.values(greek));

/** The same for a page: a letter is in italics, dots stand clear above it, what comes after p_ is a subscript, and words are words. @param {string} name @returns {HTMLElement} */
export function symbolNode(name) {
  const dots = name.endsWith("_ddot") ? 2 : name.endsWith("_dot") ? 1 : 0;
  const plain = dots ? name.slice(0, dots === 2 ? -5 : -4) : name;
  if (plain.startsWith("p_") && plain.length > 2) return element("i", {}, "p", element("sub", {}, symbolNode(plain.slice(2))));
  const shown = symbol(plain);
  const isLetter = shown.replace(/[₀-₉]/g, "").length === 1 || letters.has(shown);
  if (!isLetter) return element("span", {}, shown.replaceAll("_", " ") + "′".repeat(dots));
  return element("i", { class: dots ? `dots-${dots}` : null }, shown);
}

/** Words with their Greek letters. @param {string} text */
export function prose(text) {
  return text.replace(/\b([A-Za-z]+\d?)(_dot|_ddot)?\b/g, (whole, name) =>
    greek[name.replace(/\d$/, "")] ? symbol(whole) : whole,
  );
}

/** A dot stands above the first letter. @param {string} text @param {string} mark */
function dotted(text, mark) {
  return text.slice(0, 1) + mark + text.slice(1);
}

/** "kg*m^2/s" as kg·m²/s. @param {string | undefined} unit */
export function unitText(unit) {
  if (!unit || unit === "1") return "";
  return unit
    .replaceAll("*", "·")
    .replace(/\^(-?\d+)/g, (_, power) => [...power].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)])).join(""))
    .replace(/^deg\b/, "°");
}

/** A real minus sign, and thin spaces between groups of three decimals. @param {string} digits */
function typeset(digits) {
  const [whole, decimals = ""] = digits.replace("-", "−").split(".");
  const grouped = decimals.length > 4 ? decimals.replace(/(\d{3})(?=\d)/g, "$1\u2009") : decimals;
  return decimals ? `${whole}.${grouped}` : whole;
}

/** @param {number} value @param {number} decimals */
function fixed(value, decimals) {
  return value.toFixed(Math.max(0, Math.min(17, decimals)));
}

/** Mantissa and power of ten, where a plain number would have too many zeros. @param {number} value @returns {[number, number]} */
function scaled(value) {
  const size = Math.abs(value);
  if (value === 0 || !Number.isFinite(value) || (size >= 1e-3 && size < 1e6)) return [value, 0];
  const power = Math.floor(Math.log10(size));
  return [value / 10 ** power, power];
}

/** @param {number} power @param {string} mantissa */
function withPower(mantissa, power) {
  return power === 0 ? mantissa : `${mantissa} × 10^${power}`;
}

/** A number in a few digits, as text for a canvas or a sentence. @param {number} value @param {number} [digits] */
export function short(value, digits = 4) {
  if (!Number.isFinite(value)) return value > 0 ? "∞" : value < 0 ? "−∞" : "–";
  const [mantissa, power] = scaled(value);
  const text = typeset(String(Number(mantissa.toPrecision(digits))));
  const raised = [...String(power)].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)])).join("");
  return power === 0 ? text : `${text} × 10${raised}`;
}

/** The digits that an error allows, with the error of the last one in brackets: 0.962 233(1). @param {number} value @param {number} error */
export function withError(value, error) {
  const [mantissa, power] = scaled(value);
  const spread = error / 10 ** power;
  if (!(spread > 0) || !Number.isFinite(spread)) return withPower(typeset(String(mantissa)), power);
  const decimals = Math.max(0, Math.ceil(-Math.log10(spread)));
  const most = 15 - Math.max(0, Math.floor(Math.log10(Math.abs(mantissa) || 1)));
  if (decimals > most) return withPower(typeset(String(Number(fixed(mantissa, most)))), power);
  const last = Math.ceil(spread * 10 ** decimals - 1e-9);
  return withPower(`${typeset(fixed(mantissa, decimals))}(${last})`, power);
}

/** A text with its 10^n as a superscript. @param {string} text @returns {(Node | string)[]} */
function raised(text) {
  const found = /^(.*10)\^(-?\d+)$/.exec(text);
  return found ? [found[1], element("sup", {}, found[2].replace("-", "−"))] : [text];
}

const phone = globalThis.matchMedia?.("(max-width: 30rem)");
const digitsOnPhone = 5;

/** The beginning of a long number, for a phone: a tap, or Enter, shows the whole. @param {HTMLElement} whole @param {number} value @param {string} unit */
function beginningOf(whole, value, unit) {
  const show = () => {
    button.replaceWith(whole);
    whole.tabIndex = -1;
    whole.focus();
  };
  const button = element(
    "button",
    { type: "button", class: "number beginning", title: whole.title, onclick: show },
    ...raised(withPowerShort(value, digitsOnPhone)),
    unit,
  );
  return button;
}

/**
 * A number with its unit, as far as its error allows; all its digits are in its title.
 * @param {number | null | undefined} value @param {{ unit?: string, error?: number, digits?: number }} [options]
 */
export function quantity(value, { unit, error, digits } = {}) {
  if (value === null || value === undefined) return element("span", { class: "number" }, "–");
  const isFiner = error !== undefined && digits !== undefined && error < Math.abs(value) * 10 ** -digits;
  const text = error === undefined || isFiner ? withPowerShort(value, digits ?? 6) : withError(value, error);
  const shown = unitText(unit) ? `\u202F${unitText(unit)}` : "";
  const said = error === undefined ? String(value) : `${value} ± ${error}`;
  const whole = element("span", { class: "number", title: said }, ...raised(text), shown);
  const isLong = text.replace(/[^0-9]/g, "").length > digitsOnPhone + 3;
  return phone?.matches && isLong ? beginningOf(whole, value, shown) : whole;
}

/** @param {number} value @param {number} digits */
function withPowerShort(value, digits) {
  const [mantissa, power] = scaled(value);
  return withPower(typeset(String(Number(mantissa.toPrecision(digits)))), power);
}

/** "± 3 × 10⁻¹⁰" @param {number | null | undefined} error @param {string} [unit] */
export function plusMinus(error, unit) {
  if (error === null || error === undefined) return "error not estimated";
  const shown = unitText(unit);
  return `± ${short(error, 2)}${shown ? " " + shown : ""}`;
}
