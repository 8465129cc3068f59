// Columns over time with their errors, a phase portrait, and what is kept.
import { askForTable } from "./api.js";
import { download, element, fill } from "./dom.js";
import { foot, problemNote } from "./foot.js";
import { plusMinus, short, symbol, symbolNode, unitText } from "./numbers.js";
import { Plot } from "./plot.js";
import { sentence } from "./system.js";

/** @typedef {import("./system.js").SystemPage} SystemPage */

const colours = ["blue", "vermillion", "green", "purple", "orange", "sky"];

/** What a column belongs to in a request's `include`. @param {string} name @param {any} scene */
function groupOf(name, scene) {
  if (name === "energy") return "energy";
  if (name.startsWith("p_")) return "momenta";
  if (name.endsWith("_ddot")) return "accelerations";
  const conditions = [...(scene.valid_while ?? []), ...(scene.reports ?? [])];
  return conditions.some((/** @type {any} */ one) => one.name === name) ? "validity" : null;
}

/** A curve is broken where the state jumps. @param {number[]} times @param {number[]} column @param {number[]} jumps */
function broken(times, column, jumps) {
  if (!jumps.length) return { x: times, y: column };
  /** @type {number[]} */
  const x = [];
  /** @type {number[]} */
  const y = [];
  times.forEach((t, i) => {
    if (i && jumps.some((jump) => jump > times[i - 1] && jump <= t)) { x.push(t); y.push(NaN); }
    x.push(t);
    y.push(column[i]);
  });
  return { x, y };
}

export class MotionView {
  /** @param {SystemPage} page */
  constructor(page) {
    this.page = page;
    this.plots = /** @type {Map<string, Plot>} */ (new Map());
    this.plotBox = element("div", { class: "plots" });
    this.words = element("div", { class: "words" });
    this.footBox = element("div");
    this.chooser = element("div", { class: "chooser", role: "group", "aria-label": "Columns" });
    this.phaseBox = element("div");
    this.node = element("div", {}, this.chooser, this.plotBox, this.phaseBox, this.words, this.footBox);
    this.fillChooser();
    page.include = this.includes();
  }

  get scene() { return this.page.subject.scene; }

  allColumns() {
    const { coordinates } = this.page.subject;
    const conditions = [...(this.scene.valid_while ?? []), ...(this.scene.reports ?? [])].map((/** @type {any} */ one) => one.name);
    return [...coordinates, ...coordinates.map((/** @type {string} */ q) => `${q}_dot`), ...coordinates.map((/** @type {string} */ q) => `${q}_ddot`),
      ...coordinates.map((/** @type {string} */ q) => `p_${q}`), "energy", ...conditions];
  }

  chosen() {
    const wanted = this.page.subject.values.get("_show");
    return wanted ? wanted.split(",").filter((name) => this.allColumns().includes(name)) : [...this.page.subject.coordinates, "energy"];
  }

  includes() {
    return [...new Set(this.chosen().map((name) => groupOf(name, this.scene)).filter((group) => group !== null))];
  }

  fillChooser() {
    const chosen = this.chosen();
    fill(this.chooser, ...this.allColumns().map((name) => {
      const box = element("input", { type: "checkbox", checked: chosen.includes(name), onchange: () => this.choose() });
      box.dataset.column = name;
      return element("label", { class: "toggle" }, box, symbolNode(name));
    }));
  }

  choose() {
    const boxes = [...this.chooser.querySelectorAll("input")].filter((box) => box.checked);
    const names = boxes.map((box) => box.dataset.column ?? "");
    this.page.subject.values.set("_show", names.join(","));
    this.page.include = this.includes();
    this.page.changed();
  }

  async show() {}

  motionCame() {
    const { page } = this;
    const answer = page.answer;
    const groups = this.groupsByUnit(answer);
    for (const [unit, plot] of this.plots) if (!groups.has(unit)) { plot.node.remove(); this.plots.delete(unit); }
    for (const [unit, names] of groups) this.plotOf(unit).set(this.content(answer, names));
    fill(this.plotBox, ...[...groups.keys()].map((unit) => this.plots.get(unit)?.node ?? ""));
    this.showPhase(answer);
    fill(this.words, ...this.sentences(answer));
    fill(this.footBox, foot({ endpoint: "simulate", body: page.motionBody ?? {} }), element("p", { class: "copies" },
      element("button", { type: "button", class: "quiet", onclick: async () => download(`${this.scene.name}.csv`, await askForTable("simulate", page.motionBody ?? {})) }, "download CSV")));
    this.tick(page.stage.clock.time);
  }

  /** @param {unknown} error */
  motionFailed(error) {
    fill(this.words, problemNote(error));
  }

  /** @param {any} answer @returns {Map<string, string[]>} */
  groupsByUnit(answer) {
    const groups = new Map();
    for (const name of this.chosen()) {
      if (!(name in answer.trajectory)) continue;
      const unit = answer.units[name] ?? "1";
      groups.set(unit, [...(groups.get(unit) ?? []), name]);
    }
    return groups;
  }

  /** @param {string} unit */
  plotOf(unit) {
    const known = this.plots.get(unit);
    if (known) return known;
    const plot = new Plot({ title: "over time", x: { label: "t / s" }, y: { label: "" }, onSeek: (t) => { this.page.stage.clock.pause(); this.page.stage.clock.seek(t); } });
    this.plots.set(unit, plot);
    return plot;
  }

  /** @param {any} answer @param {string[]} names */
  content(answer, names) {
    const plot = this.plotOf(answer.units[names[0]] ?? "1");
    const unit = unitText(answer.units[names[0]]);
    const symbols = names.map(symbol).join(", ");
    plot.y.label = unit ? `${symbols} / ${unit}` : symbols;
    const all = this.allColumns();
    const jumps = (answer.strides ?? []).map((/** @type {any} */ one) => one.t);
    const errors = answer.accuracy.max_abs_error ?? {};
    const series = names.map((name) => ({
      ...broken(answer.trajectory.t, answer.trajectory[name], jumps), label: symbol(name), colour: colours[all.indexOf(name) % colours.length],
      error: errors[name], note: errors[name] === undefined ? this.driftOf(answer, name) : plusMinus(errors[name]),
    }));
    const title = plot.node.querySelector("figcaption span");
    if (title) title.textContent = `${symbols} over time`;
    return { series, marks: this.marks(answer), knownUntil: answer.accuracy.horizon ?? Infinity, said: sentence(answer, this.scene) };
  }

  /** @param {any} answer @param {string} name */
  driftOf(answer, name) {
    const kept = answer.diagnostics.conserved.find((/** @type {any} */ one) => one.name === name);
    return kept ? `kept to ${short(kept.max_abs_drift, 1)}` : "";
  }

  /** @param {any} answer */
  marks(answer) {
    const marks = answer.events.map((/** @type {any} */ event) => ({ x: event.t, label: event.name.replaceAll("_", " "), kind: /** @type {"tick"} */ ("tick") }));
    if (answer.stop) marks.push({ x: answer.stop.t, label: answer.stop.reason.replaceAll("_", " "), colour: "vermillion", kind: "line" });
    return marks;
  }

  /** @param {any} answer */
  showPhase(answer) {
    const { coordinates, values } = this.page.subject;
    const name = coordinates.includes(values.get("_phase") ?? "") ? values.get("_phase") : coordinates[0];
    if (!this.phase || this.phaseOf !== name) {
      this.phaseOf = name;
      const unit = (/** @type {string} */ column) => unitText(answer.units[column]);
      this.phase = new Plot({ title: "Phase portrait", isSquare: true, hasLabels: false, x: { label: `${symbol(name)} / ${unit(name)}` }, y: { label: `${symbol(`${name}_dot`)} / ${unit(`${name}_dot`)}` } });
      const select = element("select", { "aria-label": "Coordinate of the phase portrait", onchange: () => { values.set("_phase", select.value); this.page.changed(); } },
        ...coordinates.map((/** @type {string} */ q) => element("option", { value: q, selected: q === name }, symbol(q))));
      fill(this.phaseBox, coordinates.length > 1 ? element("p", { class: "choice" }, element("label", {}, "Phase portrait of ", select)) : "", this.phase.node);
    }
    const jumps = (answer.strides ?? []).map((/** @type {any} */ one) => one.t);
    const y = broken(answer.trajectory.t, answer.trajectory[`${name}_dot`], jumps).y;
    this.phase.set({ series: [{ x: broken(answer.trajectory.t, answer.trajectory[name], jumps).y, y, colour: "blue" }, { x: [], y: [], colour: "vermillion", marker: "dot" }] });
  }

  /** @param {any} answer @returns {HTMLElement[]} */
  sentences(answer) {
    const { accuracy, diagnostics } = answer;
    const worst = Object.entries(accuracy.max_abs_error ?? {}).map(([name, error]) => `${symbol(name)} ${plusMinus(error, answer.units[name])}`);
    const said = [element("p", {}, `Error of every row, ${accuracy.bounded ? "each step proven" : "measured"}: ${worst.join(", ")}.`)];
    if (accuracy.reason) said.push(element("p", {}, accuracy.reason));
    if (accuracy.horizon !== null) said.push(element("p", { class: "known-until" }, `Known until ${short(accuracy.horizon)} s.`));
    if (answer.stop) said.push(element("p", { class: "ending" }, `It stops at ${short(answer.stop.t)} s. ${answer.stop.message}`));
    for (const kept of diagnostics.conserved) {
      said.push(element("p", {}, `${kept.name === "energy" ? "The energy" : symbol(kept.name)} is kept: ${short(kept.initial)} ${unitText(kept.unit)}, to ${short(kept.max_abs_drift, 2)}.`));
    }
    said.push(element("p", { class: "quiet-words" }, `${accuracy.method}, ${diagnostics.steps} steps, ${diagnostics.rhs_evaluations} evaluations.`));
    return said;
  }

  /** @param {number} t */
  tick(t) {
    for (const plot of this.plots.values()) plot.showCursor(t);
    const motion = this.page.motion;
    if (!this.phase || !motion || !this.phase.series[1]) return;
    const state = motion.at(Math.min(motion.end, Math.max(motion.start, t)));
    this.phase.showDot(state[this.phaseOf], state[`${this.phaseOf}_dot`]);
  }

  leave() { this.page.include = []; }
}
