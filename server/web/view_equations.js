// The equations as mathematics, in the form that is wanted, and what is conserved and why.
import { ask } from "./api.js";
import { copyButton, element, fill, mathematics, table } from "./dom.js";
import { foot } from "./foot.js";
import { prose, symbol, symbolNode } from "./numbers.js";

/** @typedef {import("./system.js").SystemPage} SystemPage */

const forms = [
  ["mathml", "mathematics"],
  ["text", "text"],
  ["latex", "LaTeX"],
  ["sympy", "SymPy"],
  ["maxima", "Maxima"],
  ["c", "C"],
];

/** One equation with its button. @param {string} text @param {string} form @param {string} [left] what it is equal to */
function equation(text, form, left) {
  if (form === "mathml") {
    const shown = mathematics(text);
    shown.setAttribute("display", "inline");
    return element("div", { class: "equation", tabindex: "0" }, left ? element("i", {}, `${left} = `) : "", shown);
  }
  return element(
    "div",
    { class: "equation" },
    element("pre", { tabindex: "0" }, text),
    copyButton("copy", () => text),
  );
}

/** @param {string} title @param {(Node | string)[]} children */
function part(title, children) {
  return children.length ? element("section", {}, element("h2", {}, title), ...children) : "";
}

/** Names with their expressions; what is not known is left out. @param {Record<string, string | null>} entries @param {string} form */
function list(entries, form) {
  const rows = /** @type {[string, string][]} */ (Object.entries(entries ?? {}).filter(([, text]) => text !== null));
  return rows.length
    ? [
        element(
          "dl",
          { class: "terms" },
          ...rows.flatMap(([name, text]) => [
            element("dt", {}, symbolNode(name)),
            element("dd", { tabindex: "0" }, equation(text, form)),
          ]),
        ),
      ]
    : [];
}

/** Why the answer does not have this, where it says so. @param {any} answer @param {string} name */
function reason(answer, name) {
  const words = answer.reasons?.[name];
  return words ? [element("p", { class: "quiet-words" }, prose(words))] : [];
}

export class EquationsView {
  /** @param {SystemPage} page */
  constructor(page) {
    this.page = page;
    this.shown = "";
    this.node = element("div", {});
  }

  get form() {
    const wanted = this.page.subject.values.get("_form") ?? "mathml";
    return forms.some(([form]) => form === wanted) ? wanted : "mathml";
  }

  chooser() {
    const select = element(
      "select",
      { id: "form", onchange: () => this.page.set("_form", select.value === "mathml" ? null : select.value) },
      ...forms.map(([form, label]) => element("option", { value: form, selected: form === this.form }, label)),
    );
    return element("p", { class: "choice" }, element("label", { for: "form" }, "Written as "), select);
  }

  /** @param {AbortSignal} signal */
  async show(signal) {
    const body = this.page.subject.body("system");
    const form = this.form;
    const key = JSON.stringify([body, form]);
    if (key === this.shown) return;
    const answer = await ask("equations", { ...body, form }, signal);
    this.shown = key;
    fill(this.node, this.chooser(), ...this.parts(answer, form), foot({ endpoint: "equations", body: { ...body, form } }));
  }

  /** @param {any} answer @param {string} form */
  parts(answer, form) {
    const one = (/** @type {string} */ text, /** @type {string} */ left = "") => equation(text, form, left);
    return [
      part(
        "Equations of motion",
        answer.equations_of_motion.map((/** @type {any} */ motion) => one(motion.equation)),
      ),
      part("Solved for the accelerations", [...list(answer.accelerations, form), ...reason(answer, "accelerations")]),
      part("Energies", [...list({ T: answer.T, V: answer.V, L: answer.L }, form), ...reason(answer, "T")]),
      part(
        "What is conserved",
        answer.conserved.length
          ? answer.conserved.map((/** @type {any} */ kept) =>
              element("div", {}, element("p", {}, symbolNode(kept.name), ": ", prose(kept.why)), one(kept.value)),
            )
          : [element("p", {}, "Nothing that follows from the form of L."), ...reason(answer, "energy_not_conserved")],
      ),
      answer.routhian
        ? part("Ignorable coordinates", [
            element(
              "p",
              {},
              `${answer.ignorable_coordinates.map(symbol).join(", ")} can be left out: its momentum is a constant. The Routhian is`,
            ),
            one(answer.routhian.R),
            ...list(answer.routhian.rates, form),
          ])
        : "",
      part("Momenta", list(answer.momenta, form)),
      part("Hamiltonian", [...(answer.hamiltonian ? [one(answer.hamiltonian)] : []), ...reason(answer, "hamiltonian")]),
      part("Mass matrix", [this.matrix(answer.mass_matrix, form)]),
      this.forces(answer, form),
      this.dimensionless(answer.dimensionless, form),
    ];
  }

  /** @param {string[][]} rows @param {string} form */
  matrix(rows, form) {
    return table(
      { class: "matrix" },
      ...rows.map((row) =>
        element(
          "tr",
          {},
          ...row.map((text) => element("td", {}, form === "mathml" ? mathematics(text) : element("code", {}, text))),
        ),
      ),
    );
  }

  /** @param {any} answer @param {string} form */
  forces(answer, form) {
    const zero = (/** @type {string} */ text) => /^(<math[^>]*>(<mrow>)?<mn>0<\/mn>(<\/mrow>)?<\/math>|0(\.0)?)$/.test(text);
    const acting = Object.fromEntries(
      Object.entries(answer.generalized_forces ?? {})
        .filter(([, text]) => !zero(/** @type {string} */ (text)))
        .map(([name, text]) => [`Q_${name}`, /** @type {string} */ (text)]),
    );
    return part("Generalized forces", list(acting, form));
  }

  /** @param {any} scaled @param {string} form */
  dimensionless(scaled, form) {
    if (!scaled?.L) return "";
    return part("Without dimensions", [
      element("p", {}, "In units of these scales only what is left can matter."),
      ...list({ ...scaled.groups, "unit of energy": scaled.energy_unit, "unit of time": scaled.time_unit, L: scaled.L }, form),
    ]);
  }
}
