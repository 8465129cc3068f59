// Columns over time with their errors, one column against another, and what is kept.
import { askForTable } from "./api.js";
import { allColumns, broken, includeOf, jumpTimes } from "./columns.js";
import { download, element, fill } from "./dom.js";
import { foot, notes, problemNote } from "./foot.js";
import { plusMinus, short, symbol, symbolNode, unitText } from "./numbers.js";
import { Plot } from "./plot.js";
import { sentence } from "./system.js";
import { Versus } from "./versus.js";

/** @typedef {import("./system.js").SystemPage} SystemPage */

const colours = ["blue", "vermillion", "green", "purple", "orange", "sky"];

export class MotionView {
  /** @param {SystemPage} page */
  constructor(page) {
    this.page = page;
    this.columns = allColumns(page.subject);
    this.plots = /** @type {Map<string, Plot>} */ (new Map());
    this.plotBox = element("div", { class: "plots" });
    this.words = element("div", { class: "words" });
    this.footBox = element("div");
    this.chooser = element("div", { class: "chooser", role: "group", "aria-label": "Columns" });
    this.versus = new Versus(page, this.columns);
    this.node = element("div", {}, this.chooser, this.plotBox, this.versus.node, this.words, this.footBox);
    this.fillChooser();
    page.include = this.includes();
  }

  get scene() {
    return this.page.subject.scene;
  }
  get inDegrees() {
    return this.page.subject.values.has("_deg");
  }

  chosen() {
    const wanted = this.page.subject.values.get("_show");
    return wanted === undefined
      ? [...this.page.subject.coordinates, "energy"]
      : wanted.split(",").filter((name) => this.columns.includes(name));
  }

  includes() {
    const groups = [...this.chosen(), ...this.versus.names].map((name) => includeOf(name, this.scene));
    return /** @type {string[]} */ ([...new Set(groups.filter((group) => group !== null))]);
  }

  fillChooser() {
    const chosen = this.chosen();
    const boxes = this.columns.map((name) => {
      const box = element("input", { type: "checkbox", checked: chosen.includes(name), onchange: () => this.choose() });
      box.dataset.column = name;
      return element("label", { class: "toggle" }, box, symbolNode(name));
    });
    const degrees = element("input", {
      type: "checkbox",
      checked: this.inDegrees,
      onchange: () => this.page.set("_deg", degrees.checked ? "1" : null),
    });
    const hasAngles = this.scene.coordinates.some((/** @type {any} */ q) => q.unit === "rad");
    fill(this.chooser, ...boxes, hasAngles ? element("label", { class: "toggle apart" }, degrees, "angles in degrees") : "");
  }

  choose() {
    const boxes = /** @type {NodeListOf<HTMLInputElement>} */ (this.chooser.querySelectorAll("input[data-column]"));
    const names = [...boxes].filter((box) => box.checked).map((box) => box.dataset.column ?? "");
    this.page.set("_show", names.join(","));
  }

  /** Asks anew where a column is wished that the motion has not. */
  async show() {
    const wanted = this.includes();
    if (wanted.join() === this.page.include.join()) return;
    this.page.include = wanted;
    this.page.motionLatest.wish();
  }

  motionCame() {
    const { page } = this;
    const { answer } = page;
    if (!answer) return;
    const groups = this.groupsByUnit(answer);
    for (const [unit, plot] of this.plots)
      if (!groups.has(unit)) {
        plot.node.remove();
        this.plots.delete(unit);
      }
    for (const [unit, names] of groups) this.plotOf(unit).set(this.content(answer, names));
    const nodes = [...groups.keys()].map((unit) => this.plotOf(unit).node);
    if (nodes.some((node, i) => this.plotBox.children[i] !== node) || nodes.length !== this.plotBox.childElementCount)
      fill(this.plotBox, ...nodes);
    Plot.align([...this.plots.values()]);
    this.versus.show(answer, (unit) => this.factor(unit));
    fill(this.words, ...notes(answer), ...this.sentences(answer));
    fill(
      this.footBox,
      foot({ endpoint: "simulate", body: page.motionBody ?? {} }),
      element(
        "p",
        { class: "copies" },
        element(
          "button",
          {
            type: "button",
            class: "quiet",
            onclick: async () => download(`${this.scene.name}.csv`, await askForTable("simulate", page.motionBody ?? {})),
          },
          "download CSV",
        ),
      ),
    );
    this.tick(page.stage.clock.time);
  }

  /** @param {unknown} error */
  motionFailed(error) {
    fill(this.words, problemNote(error));
  }

  /** @param {string | undefined} unit */
  factor(unit) {
    return this.inDegrees && /\brad\b/.test(unit ?? "") && !/[*]/.test(unit ?? "") ? 180 / Math.PI : 1;
  }

  /** @param {any} answer @returns {Map<string, string[]>} */
  groupsByUnit(answer) {
    const groups = new Map();
    for (const name of this.chosen()) {
      if (!(name in answer.trajectory)) continue;
      const unit = answer.units[name];
      groups.set(unit, [...(groups.get(unit) ?? []), name]);
    }
    return groups;
  }

  /** @param {string} unit */
  plotOf(unit) {
    const known = this.plots.get(unit);
    if (known) return known;
    const seek = (/** @type {number} */ t) => {
      this.page.stage.clock.pause();
      this.page.stage.clock.seek(t);
    };
    // All of them show the same time.
    const onZoom = (/** @type {[number, number] | null} */ range) => {
      for (const other of this.plots.values()) {
        other.zoomed = range;
        other.redraw();
      }
    };
    const plot = new Plot({ title: "over time", x: { label: "t / s" }, y: { label: "" }, onSeek: seek, onZoom });
    this.plots.set(unit, plot);
    return plot;
  }

  /** @param {any} answer @param {string[]} names */
  content(answer, names) {
    const unit = answer.units[names[0]];
    const plot = this.plotOf(unit);
    const factor = this.factor(unit);
    const shown = unitText(factor === 1 ? unit : unit.replace("rad", "deg"));
    const symbols = names.map(symbol).join(", ");
    plot.y.label = shown ? `${symbols} / ${shown}` : symbols;
    plot.setTitle(`${symbols} over time`);
    return {
      series: names.map((name) => this.curve(answer, name, factor)),
      marks: this.marks(answer),
      knownUntil: answer.accuracy.horizon ?? Infinity,
      said: sentence(answer, this.scene),
    };
  }

  /** @param {any} answer @param {string} name @param {number} factor */
  curve(answer, name, factor) {
    const jumps = jumpTimes(answer, name);
    const stated = answer.accuracy.max_abs_error?.[name];
    const error = stated === undefined ? undefined : stated * factor;
    const values = answer.trajectory[name] ?? [];
    return {
      ...broken(answer.trajectory.t, factor === 1 ? values : values.map((/** @type {number} */ value) => value * factor), jumps),
      label: symbol(name),
      colour: colours[this.columns.indexOf(name) % colours.length],
      error,
      note: error === undefined ? this.driftOf(answer, name) : plusMinus(error),
    };
  }

  /** @param {any} answer @param {string} name */
  driftOf(answer, name) {
    const kept = answer.diagnostics.conserved.find((/** @type {any} */ one) => one.name === name);
    return kept ? `kept to ${short(kept.max_abs_drift, 1)}` : "";
  }

  /** @param {any} answer */
  marks(answer) {
    const named = new Set();
    const marks = answer.events.map((/** @type {any} */ event) => {
      const label = named.has(event.name) ? undefined : event.name.replaceAll("_", " ");
      named.add(event.name);
      return { x: event.t, label, kind: "tick" };
    });
    if (answer.stop)
      marks.push({ x: answer.stop.t, label: answer.stop.reason.replaceAll("_", " "), colour: "vermillion-text", kind: "line" });
    return marks;
  }

  /** @param {any} answer @returns {HTMLElement[]} */
  sentences(answer) {
    const { accuracy, diagnostics } = answer;
    const worst = Object.entries(accuracy.max_abs_error ?? {})
      .filter(([name]) => name in answer.request.initial || this.chosen().includes(name))
      .map(([name, error]) => `${symbol(name)} ${plusMinus(error, answer.units[name])}`);
    const said = [
      element(
        "p",
        {},
        `Error of ${accuracy.horizon === null ? "every" : "the worst"} row, ${accuracy.bounded ? "each step proven" : "measured"}: ${worst.join(", ")}.`,
      ),
    ];
    if (accuracy.reason) said.push(element("p", {}, accuracy.reason));
    if (accuracy.horizon !== null) said.push(element("p", { class: "known-until" }, `Known until ${short(accuracy.horizon)} s.`));
    if (answer.stop)
      said.push(element("p", { class: "ending" }, `It stops at ${short(answer.stop.t)} s. ${answer.stop.message}`));
    for (const kept of diagnostics.conserved) {
      said.push(
        element(
          "p",
          {},
          `${kept.name === "energy" ? "The energy" : symbol(kept.name)} is kept${answer.strides?.length ? " between impacts" : ""}: ${short(kept.initial)} ${unitText(kept.unit)}, to ${short(kept.max_abs_drift, 2)}.`,
        ),
      );
    }
    said.push(
      element(
        "p",
        { class: "quiet-words" },
        `${accuracy.method}, ${diagnostics.steps} steps, ${diagnostics.rhs_evaluations} evaluations.`,
      ),
    );
    return said;
  }

  /** @param {number} t */
  tick(t) {
    for (const plot of this.plots.values()) plot.showCursor(t);
    this.versus.tick(t);
  }

  leave() {
    this.page.include = [];
  }
}
