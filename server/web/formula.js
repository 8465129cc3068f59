// The service's closed forms, set as mathematics. It writes them in LaTeX; the few commands that it uses are known here.
import { element, mathematics } from "./dom.js";
import { prose } from "./numbers.js";

const functions = new Set(["sin", "cos", "tan", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "exp", "ln"]);
const greek = new Map(
  "alpha α beta β gamma γ delta δ epsilon ε zeta ζ eta η theta θ kappa κ lambda λ mu μ nu ν xi ξ pi π rho ρ sigma σ tau τ phi φ chi χ psi ψ omega ω Gamma Γ Delta Δ Theta Θ Lambda Λ Phi Φ Psi Ψ Omega Ω"
    .split(" ")
    .flatMap((name, i, all) => (i % 2 ? [] : [/** @type {[string, string]} */ ([name, all[i + 1]])])),
);
const signs = new Map([
  ["cdot", "·"],
  ["le", "≤"],
  ["ge", "≥"],
]);

/** @param {string} text */
const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");

/** Throws what it does not know. */
class Reader {
  /** @param {string} latex */
  constructor(latex) {
    this.tokens = latex.match(/\\[A-Za-z]+|\\.|\d+(\.\d+)?|\S/g) ?? [];
    this.next = 0;
  }

  whole() {
    const shown = this.row();
    if (this.next < this.tokens.length) throw new Error(this.tokens[this.next]);
    return shown;
  }

  row() {
    let shown = "";
    while (this.next < this.tokens.length && !["}", "\\right"].includes(this.tokens[this.next])) shown += this.scripted();
    return `<mrow>${shown}</mrow>`;
  }

  scripted() {
    let base = this.atom();
    for (let sign = this.tokens[this.next]; sign === "^" || sign === "_"; sign = this.tokens[this.next]) {
      this.next += 1;
      const kind = sign === "^" ? "msup" : "msub";
      base = `<${kind}>${base}${this.atom()}</${kind}>`;
    }
    return base;
  }

  group() {
    const shown = this.row();
    this.next += 1;
    return shown;
  }

  /** @returns {string} */
  atom() {
    const token = this.tokens[this.next] ?? "";
    this.next += 1;
    if (token === "{") return this.group();
    if (token === "\\frac") return `<mfrac>${this.atom()}${this.atom()}</mfrac>`;
    if (token === "\\sqrt") return `<msqrt>${this.atom()}</msqrt>`;
    if (token === "\\left") return this.bracketed();
    if (token === "\\dot" || token === "\\ddot")
      return `<mover accent="true">${this.atom()}<mo>${token === "\\dot" ? "˙" : "¨"}</mo></mover>`;
    if (/^\d/.test(token)) return `<mn>${token}</mn>`;
    if (/^[A-Za-z]$/.test(token)) return `<mi>${token}</mi>`;
    if (/^[-+=,()/|<>]$/.test(token)) return `<mo>${escaped(token === "-" ? "−" : token)}</mo>`;
    return this.command(token.slice(1));
  }

  bracketed() {
    const open = this.tokens[this.next];
    this.next += 1;
    const inside = this.row();
    const close = this.tokens[this.next + 1];
    this.next += 2;
    if (open !== "(" || close !== ")") throw new Error(open);
    return `<mrow><mo>(</mo>${inside}<mo>)</mo></mrow>`;
  }

  /** @param {string} name */
  command(name) {
    if (functions.has(name)) return `<mrow><mi>${name}</mi><mo>\u2061</mo></mrow>`;
    if (name === "," || name === ";") return '<mspace width="0.17em"/>';
    if (name === "mathrm" || name === "text" || name === "operatorname") return this.word();
    const letter = greek.get(name);
    if (letter) return `<mi>${letter}</mi>`;
    const sign = signs.get(name);
    if (sign) return `<mo>${sign}</mo>`;
    throw new Error(name);
  }

  word() {
    let word = "";
    for (this.next += 1; this.next < this.tokens.length && this.tokens[this.next] !== "}"; this.next += 1)
      word += this.tokens[this.next];
    this.next += 1;
    return `<mi>${escaped(word)}</mi>`;
  }
}

/** Mathematics, or the text where it has something else in it. @param {{ text: string, latex: string }} form */
export function formula({ text, latex }) {
  try {
    const shown = mathematics(`<math xmlns="http://www.w3.org/1998/Math/MathML">${new Reader(latex).whole()}</math>`);
    shown.setAttribute("display", "inline");
    return element("span", { class: "formula", title: text }, shown);
  } catch {
    return element("code", { class: "formula" }, text);
  }
}

/** A formula of an answer, with what it is of where that is not the number beside it: ω² = g/l. @param {{ text: string, latex: string, of?: string }} form */
export function closedForm(form) {
  if (!form.of) return formula(form);
  return element("span", {}, formula({ text: form.of, latex: form.of.replace(/^omega/, "\\omega ") }), " = ", formula(form));
}

/** What formulas assume, in one sentence; nothing where they assume nothing. @param {any[]} forms */
export function assumptions(forms) {
  const all = [...new Set(forms.flatMap((form) => form?.assumes ?? []))];
  return all.length ? element("p", { class: "quiet-words assumes" }, prose(`The formulas hold for ${all.join(", ")}.`)) : "";
}
