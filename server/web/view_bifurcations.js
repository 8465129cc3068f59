// How the equilibria move with a parameter, and where their number or their stability changes.
import { ask } from "./api.js";
import { pieces, tellingColumns } from "./branches.js";
import { element, fill, table } from "./dom.js";
import { assumptions, formula } from "./formula.js";
import { foot, problemNote } from "./foot.js";
import { quantity, short, symbol, symbolNode, unitText } from "./numbers.js";
import { Plot } from "./plot.js";
import { typed } from "./subject.js";

/** @typedef {import("./system.js").SystemPage} SystemPage */

export class BifurcationsView {
  /** @param {SystemPage} page */
  constructor(page) {
    this.page = page;
    this.shown = "";
    this.results = element("div", {});
    this.node = element("div", {}, this.chooser(), this.results);
  }

  get parameter() {
    const { parameters, values } = this.page.subject;
    const wanted = values.get("_parameter") ?? "";
    return parameters.includes(wanted)
      ? wanted
      : (parameters.find((/** @type {string} */ name) => /^(Omega|gamma)/.test(name)) ?? parameters[0]);
  }

  /** @param {string} name the middle of the range is the present value */
  present(name) {
    return this.page.answer?.request.parameters[name] ?? 1;
  }

  range() {
    const { values } = this.page.subject;
    const present = Math.abs(this.present(this.parameter)) || 1;
    const hasImpact = Boolean(this.page.subject.scene.impact);
    const [from, to] = hasImpact ? [present / 3, 2 * present] : [0.05 * present, 2 * present];
    return {
      from: typed(values.get("_from") ?? String(Number(from.toPrecision(3)))),
      to: typed(values.get("_to") ?? String(Number(to.toPrecision(3)))),
    };
  }

  chooser() {
    const { parameters } = this.page.subject;
    const select = element(
      "select",
      {
        id: "bifurcation-of",
        onchange: () => {
          this.page.subject.values.delete("_from");
          this.page.subject.values.delete("_to");
          this.page.set("_parameter", select.value);
          this.fillRange();
        },
      },
      ...parameters.map((/** @type {string} */ name) =>
        element("option", { value: name, selected: name === this.parameter }, symbol(name)),
      ),
    );
    this.fromField = element("input", {
      type: "text",
      class: "value",
      "aria-label": "from",
      onchange: () => this.page.set("_from", this.fromField?.value || null),
    });
    this.toField = element("input", {
      type: "text",
      class: "value",
      "aria-label": "to",
      onchange: () => this.page.set("_to", this.toField?.value || null),
    });
    this.fillRange();
    return element(
      "p",
      { class: "solver" },
      element("label", { for: "bifurcation-of" }, this.page.subject.scene.impact ? "Gaits as " : "Equilibria as "),
      select,
      " goes from ",
      this.fromField,
      " to ",
      this.toField,
    );
  }

  fillRange() {
    const { from, to } = this.range();
    if (this.fromField) this.fromField.value = String(from);
    if (this.toField) this.toField.value = String(to);
  }

  motionCame() {
    if (this.isShown) return;
    this.isShown = true;
    this.fillRange();
    this.page.viewLatest.wish();
  }

  /** @param {AbortSignal} signal */
  async show(signal) {
    if (!this.page.answer || !this.parameter) return;
    const body = { ...this.page.subject.body("parameters"), parameter: this.parameter, ...this.range() };
    const key = JSON.stringify(body);
    if (key === this.shown) return this.mark();
    fill(this.results, element("p", { class: "quiet-words" }, "Searching …"));
    try {
      const answer = await ask("bifurcations", body, signal);
      this.shown = key;
      this.showAnswer(answer, body);
    } catch (error) {
      if (signal.aborted) throw error;
      fill(this.results, problemNote(error), foot({ endpoint: "bifurcations", body }));
    }
  }

  /** @param {any} answer @param {any} body */
  showAnswer(answer, body) {
    this.answer = answer;
    this.plots = tellingColumns(answer, this.page.subject.coordinates).map((/** @type {string} */ name) =>
      this.diagram(answer, name),
    );
    fill(
      this.results,
      this.words(answer),
      this.table(answer),
      ...this.plots.map((/** @type {Plot} */ plot) => plot.node),
      element("p", { class: "quiet-words" }, "Heavy lines are stable, dashed ones unstable. A click takes the parameter there, as do the arrow keys and Enter."),
      foot({ endpoint: "bifurcations", body }),
    );
    this.plots.forEach((/** @type {Plot} */ plot) => plot.resize());
    this.mark();
  }

  /** @param {any} answer @param {string} column */
  diagram(answer, column) {
    const { parameter } = this;
    const unit = unitText(answer.units[column]);
    const plot = new Plot({
      title: `${symbol(column)} of the ${answer.of ?? "equilibria"}`,
      height: 280,
      hasLabels: false,
      x: { label: [symbol(parameter), unitText(answer.units[parameter])].filter(Boolean).join(" / ") },
      y: { label: unit ? `${symbol(column)} / ${unit}` : symbol(column) },
      onPick: (x) => this.page.set(parameter, String(Number(x.toPrecision(4)))),
    });
    const series = answer.branches.flatMap((/** @type {any} */ branch) =>
      pieces(branch, parameter, column, answer.critical).map(({ stability, x, y }) => ({
        x,
        y,
        colour: stability === "stable" ? "blue" : "soft",
        width: stability === "stable" ? 2.5 : 1.5,
        dash: stability === "unstable" ? [5, 4] : stability === "neutral" ? [1, 3] : [],
      })),
    );
    const critical = answer.critical.filter((/** @type {any} */ one) => one.state?.[column] !== undefined);
    series.push({
      x: critical.map((/** @type {any} */ one) => one.value),
      y: critical.map((/** @type {any} */ one) => one.state[column]),
      colour: "vermillion",
      marker: "dot",
      joined: false,
      width: 1,
    });
    plot.set({
      series,
      said: `Branches of ${column}; critical values: ${answer.critical.map((/** @type {any} */ one) => `${short(one.value)}, ${one.kind}`).join("; ") || "none"}.`,
    });
    return plot;
  }

  mark() {
    for (const plot of this.plots ?? []) plot.showCursor(this.present(this.parameter));
  }

  /** @param {any} answer */
  words(answer) {
    const count = answer.critical.length;
    const said =
      count === 0
        ? `${answer.at_ends ? "No equilibria meet" : "Nothing changes"} in this range${answer.complete ? "; that is proven." : "."}`
        : `${count === 1 ? "One critical value" : `${count} critical values`}${answer.complete ? ", proven to be all." : "."}`;
    return element("p", {}, said, typeof answer.reason === "string" ? ` ${answer.reason}` : "");
  }

  /** @param {any} answer */
  table(answer) {
    if (!answer.critical.length) return "";
    const rows = table(
      {},
      ...answer.critical.map((/** @type {any} */ one) =>
        element(
          "tr",
          {},
          element(
            "th",
            { scope: "row" },
            symbolNode(this.parameter),
            " = ",
            quantity(one.value, { unit: answer.units[this.parameter], error: one.error }),
          ),
          element("td", {}, one.exact ? formula(one.exact) : ""),
          element("td", {}, one.kind.replaceAll("_", " ")),
        ),
      ),
    );
    return element("div", {}, rows, assumptions(answer.critical.map((/** @type {any} */ one) => one.exact)));
  }
}
