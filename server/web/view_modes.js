// Small oscillations about an equilibrium: each mode with its frequency and shape, shown moving in the drawing.
import { ask } from "./api.js";
import { element, fill, table } from "./dom.js";
import { Figure } from "./figure.js";
import { foot } from "./foot.js";
import { assumptions, closedForm, formula } from "./formula.js";
import { ModeMotion } from "./motion.js";
import { quantity, short, symbol, symbolNode } from "./numbers.js";

/** @typedef {import("./system.js").SystemPage} SystemPage */

/** A visible size of a shape: angles of a third, lengths of a part of the figure. @param {any} mode @param {any} scene @param {Record<string, number>} state */
function sizeOf(mode, scene, state) {
  const parts = scene.coordinates.map((/** @type {any} */ q) => {
    const most = q.unit === "rad" ? 0.45 : 0.25 * Math.abs(state[q.name] || 0.6);
    return Math.abs(mode.shape[q.name]) > 0 ? most / Math.abs(mode.shape[q.name]) : Infinity;
  });
  return Math.min(...parts);
}

export class ModesView {
  /** @param {SystemPage} page */
  constructor(page) {
    this.page = page;
    this.node = element("div", {});
  }

  /** @param {AbortSignal} signal */
  async show(signal) {
    const body = this.page.subject.body("parameters");
    const answer = await ask("modes", body, signal);
    this.answer = answer;
    const scaled = answer.modes.some(
      (/** @type {any} */ mode) => mode.shape_scaled && JSON.stringify(mode.shape_scaled) !== JSON.stringify(mode.shape),
    );
    fill(
      this.node,
      element("p", {}, ...this.words(answer)),
      this.table(answer, scaled),
      assumptions(answer.modes.map((/** @type {any} */ mode) => mode.exact)),
      ...this.matrices(answer),
      foot({ endpoint: "modes", body }),
    );
    this.animate(Math.min(this.chosen, answer.modes.length - 1));
  }

  get chosen() {
    return Number(this.page.subject.values.get("_mode") ?? 0) || 0;
  }

  /** @param {any} answer */
  words(answer) {
    const state = answer.coordinates.flatMap((/** @type {string} */ name, /** @type {number} */ i) => [
      i ? ", " : "",
      symbolNode(name),
      " = ",
      quantity(answer.equilibrium.state[name], {
        unit: answer.units[name],
        error: answer.equilibrium.error?.[name] || undefined,
      }),
    ]);
    return ["About the equilibrium ", ...state, `, which is ${answer.equilibrium.stability}.`];
  }

  /** @param {any} answer @param {boolean} scaled */
  table(answer, scaled) {
    const heads = [
      "mode",
      "ω",
      "frequency, period",
      ...answer.coordinates.map((/** @type {string} */ name) => symbolNode(name)),
      scaled ? "in one unit" : null,
    ].filter((head) => head !== null);
    return table(
      { class: "modes", heads },
      ...answer.modes.flatMap((/** @type {any} */ mode, /** @type {number} */ i) => this.rows(answer, mode, i, scaled)),
    );
  }

  /** @param {any} answer @param {any} mode @param {number} i @param {boolean} scaled */
  rows(answer, mode, i, scaled) {
    const { units } = answer;
    const pick = element("input", {
      type: "radio",
      name: "mode",
      value: i,
      checked: i === this.chosen,
      id: `mode-${i}`,
      onchange: () => this.choose(i),
    });
    const cells =
      mode.kind === "oscillation"
        ? [
            quantity(mode.omega, { unit: units.omega, error: mode.error, digits: 10 }),
            element(
              "div",
              {},
              quantity(mode.f, { unit: units.f, digits: 5 }),
              element("br"),
              quantity(mode.period, { unit: units.period, digits: 5 }),
            ),
          ]
        : [
            mode.kind === "rigid"
              ? quantity(0, { unit: units.omega })
              : quantity(mode.rate, { unit: units.rate, error: mode.error, digits: 10 }),
            "–",
          ];
    const numbers = element(
      "tr",
      {},
      element("th", { scope: "row" }, element("label", { for: `mode-${i}` }, pick, mode.kind)),
      ...cells.map((cell) => element("td", {}, cell)),
      ...answer.coordinates.map((/** @type {string} */ name) => element("td", { class: "number" }, short(mode.shape[name], 5))),
      scaled
        ? element(
            "td",
            { class: "number" },
            `(${answer.coordinates.map((/** @type {string} */ name) => short(mode.shape_scaled[name], 5)).join(", ")})`,
          )
        : "",
    );
    if (!mode.exact) return [numbers];
    numbers.classList.add("with-formula");
    return [numbers, this.exactly(mode, 3 + answer.coordinates.length + (scaled ? 1 : 0))];
  }

  /** The frequency as a formula, or its square where that is what has one, in a row of its own. @param {any} mode @param {number} width */
  exactly({ exact }, width) {
    const itself = exact.omega ?? exact.rate;
    const shown = itself ? ["ω = ", formula(itself)] : [closedForm(exact)];
    if (exact.rate && !exact.omega) shown[0] = "rate = ";
    return element(
      "tr",
      { class: "formula-row" },
      element("td", { colspan: width }, element("div", { tabindex: "0" }, ...shown)),
    );
  }

  /** @param {number} i */
  choose(i) {
    this.page.subject.values.set("_mode", String(i));
    this.page.changed();
  }

  /** @param {number} i */
  animate(i) {
    const { answer, page } = this;
    const mode = answer?.modes[i];
    if (!mode || !page.stage) return;
    const { scene } = page.subject;
    const figure = new Figure(scene, answer.request.parameters, {});
    const size = sizeOf(mode, scene, answer.equilibrium.state);
    const motion = new ModeMotion(answer.equilibrium.state, mode.shape, size, mode.omega ?? 0, answer.coordinates);
    page.borrow(
      motion,
      figure,
      `Mode ${i + 1}: ${answer.coordinates.map((/** @type {string} */ name) => `${symbol(name)} ${short(mode.shape[name], 4)}`).join(", ")}`,
    );
    page.stage.clock.play();
  }

  /** @param {any} answer */
  matrices(answer) {
    const show = (/** @type {string} */ title, /** @type {number[][]} */ rows) =>
      element(
        "div",
        {},
        element("h2", {}, title),
        table(
          { class: "matrix" },
          ...rows.map((row) => element("tr", {}, ...row.map((value) => element("td", { class: "number" }, short(value, 6))))),
        ),
      );
    const isZero = answer.gyroscopic_matrix.flat().every((/** @type {number} */ value) => value === 0);
    return [
      element(
        "div",
        { class: "matrices" },
        show("Mass matrix", answer.mass_matrix),
        show("Stiffness matrix", answer.stiffness_matrix),
        isZero ? "" : show("Gyroscopic matrix", answer.gyroscopic_matrix),
      ),
    ];
  }

  leave() {
    this.page.giveBack();
  }
}
