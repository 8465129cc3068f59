// A sweep: one number of an answer while a parameter or an initial value runs over a range.
import { ask, askForTable } from "./api.js";
import { download, element, fill } from "./dom.js";
import { foot, problemNote } from "./foot.js";
import { short, symbol, unitText } from "./numbers.js";
import { Plot } from "./plot.js";
import { typed } from "./subject.js";

/** @typedef {import("./system.js").SystemPage} SystemPage */
/** @typedef {{ title: string, ask: string, pointer: string }} Collected */

/** What is often asked for; the pointer may be any other of the same answer. @param {SystemPage} page @returns {Collected[]} */
function collectable(page) {
  const { coordinates, scene } = page.subject;
  const can = (/** @type {string} */ endpoint) => !page.capabilities || page.capabilities.includes(endpoint);
  const angle = scene.coordinates.find((/** @type {any} */ q) => q.unit === "rad")?.name ?? coordinates[0];
  /** @type {Collected[]} */
  const all = [];
  if (can("modes"))
    coordinates.forEach((/** @type {string} */ _, /** @type {number} */ i) =>
      all.push({ title: `ω of mode ${i + 1}`, ask: "modes", pointer: `/modes/${i}/omega` }),
    );
  if (can("turning_points")) all.push({ title: `largest ${symbol(angle)}`, ask: "turning_points", pointer: `/${angle}_max` });
  if (can("equilibria"))
    all.push({ title: `${symbol(angle)} at rest`, ask: "equilibria", pointer: `/equilibria/0/state/${angle}` });
  if (can("gait")) all.push({ title: "step time", ask: "gait", pointer: "/gaits/0/step_time" });
  all.push({ title: "energy", ask: "energy", pointer: "/E" });
  for (const q of coordinates)
    all.push({ title: `acceleration of ${symbol(q)}`, ask: "energy", pointer: `/accelerations/${q}_ddot` });
  return all;
}

const usesInitial = new Set(["turning_points", "energy"]);

export class SweepView {
  /** @param {SystemPage} page */
  constructor(page) {
    this.page = page;
    this.shown = "";
    this.controls = element("form", {
      class: "solver sweep",
      onsubmit: (event) => event.preventDefault(),
    });
    this.results = element("div", {});
    this.node = element("div", {}, this.controls, this.results);
  }

  /** @param {string} name @param {string} otherwise */
  value(name, otherwise) {
    return this.page.subject.values.get(name) ?? otherwise;
  }

  get collected() {
    const all = collectable(this.page);
    return all[Number(this.value("_collect", "0"))] ?? all[0];
  }

  get pointer() {
    return this.value("_pointer", this.collected.pointer);
  }

  /** What may run: parameters, and where a question begins at a state its initial values. */
  get variables() {
    const { parameters, coordinates, velocities } = this.page.subject;
    return usesInitial.has(this.collected.ask) ? [...parameters, ...coordinates, ...velocities] : parameters;
  }

  get variable() {
    const wanted = this.value("_vary", "");
    return this.variables.includes(wanted) ? wanted : this.variables[0];
  }

  range() {
    const { request } = this.page.answer;
    const present = request.parameters[this.variable] ?? request.initial[this.variable] ?? 1;
    const [from, to] = present > 0 ? [present / 2, 2 * present] : [-1, 1];
    return {
      from: typed(this.value("_from", String(Number(from.toPrecision(3))))),
      to: typed(this.value("_to", String(Number(to.toPrecision(3))))),
      count: 101,
    };
  }

  /** @param {AbortSignal} signal */
  async show(signal) {
    const { answer, subject } = this.page;
    if (!answer || !this.variable) return;
    const { ask: endpoint } = this.collected;
    const question = subject.body(usesInitial.has(endpoint) ? "initial" : "parameters");
    for (const group of [question.parameters, question.initial]) delete group?.[this.variable];
    const body = { ask: { [endpoint]: question }, vary: { [this.variable]: this.range() }, collect: { value: this.pointer } };
    const key = JSON.stringify([body, this.page.capabilities]);
    if (key === this.shown) return;
    this.fillControls();
    try {
      this.showAnswer(await ask("sweep", body, signal), body);
      this.shown = key;
    } catch (error) {
      if (signal.aborted) throw error;
      fill(this.results, problemNote(error), foot({ endpoint: "sweep", body }));
    }
  }

  motionCame() {
    if (!this.shown) this.page.viewLatest.wish();
  }

  fillControls() {
    const { page } = this;
    const focused = document.activeElement?.id;
    const { from, to } = this.range();
    const drop = (/** @type {string[]} */ names) => names.forEach((name) => page.subject.values.delete(name));
    const what = element(
      "select",
      {
        id: "sweep-of",
        onchange: () => {
          drop(["_pointer"]);
          page.set("_collect", what.value);
        },
      },
      ...collectable(page).map(({ title }, i) =>
        element("option", { value: i, selected: String(i) === this.value("_collect", "0") }, title),
      ),
    );
    const over = element(
      "select",
      {
        id: "sweep-over",
        onchange: () => {
          drop(["_from", "_to"]);
          page.set("_vary", over.value);
        },
      },
      ...this.variables.map((/** @type {string} */ name) =>
        element("option", { value: name, selected: name === this.variable }, symbol(name)),
      ),
    );
    const field = (
      /** @type {string} */ id,
      /** @type {string} */ name,
      /** @type {any} */ value,
      /** @type {string} */ label,
    ) => {
      const input = element("input", {
        id,
        type: "text",
        class: id === "sweep-pointer" ? "value wide" : "value",
        value: String(value),
        "aria-label": label,
        autocomplete: "off",
        onchange: () => page.set(name, input.value.trim() || null),
      });
      return input;
    };
    fill(
      this.controls,
      element("label", { for: "sweep-of" }, "Plot "),
      what,
      element("label", { for: "sweep-over" }, " over "),
      over,
      " from ",
      field("sweep-from", "_from", from, "first value"),
      " to ",
      field("sweep-to", "_to", to, "last value"),
      element("label", { for: "sweep-pointer" }, " at "),
      field("sweep-pointer", "_pointer", this.pointer, "JSON pointer into each answer"),
    );
    if (focused) document.getElementById(focused)?.focus();
  }

  /** @param {any} answer @param {any} body */
  showAnswer(answer, body) {
    const { columns, units, failed } = answer;
    const [name] = Object.keys(body.vary);
    const labelled = (/** @type {string} */ shown, /** @type {string | undefined} */ unit) =>
      [shown, unitText(unit)].filter(Boolean).join(" / ");
    const plot = new Plot({
      title: `${this.pointer} over ${symbol(name)}`,
      height: 320,
      hasLabels: false,
      x: { label: labelled(symbol(name), units[name]) },
      y: { label: labelled(this.pointer.split("/").pop() ?? "", units.value) },
      onPick: (x) => this.page.set(name, String(Number(x.toPrecision(4)))),
    });
    const y = columns.value.map((/** @type {any} */ value) => (typeof value === "number" ? value : NaN));
    const known = y.filter(Number.isFinite);
    const said = known.length
      ? `${this.pointer} is between ${short(Math.min(...known))} and ${short(Math.max(...known))} ${unitText(units.value)} as ${name} runs from ${short(columns[name][0])} to ${short(columns[name].at(-1))}.`
      : `${this.pointer} has no number in this range.`;
    plot.set({ series: [{ x: columns[name], y, colour: "blue" }], said });
    fill(
      this.results,
      element("p", { "aria-live": "polite" }, said),
      plot.node,
      failed.length
        ? element("p", { class: "quiet-words" }, `${failed.length} of ${answer.rows} rows have no value: ${failed[0].reason}`)
        : "",
      foot({ endpoint: "sweep", body }),
      element(
        "p",
        { class: "copies" },
        element(
          "button",
          { type: "button", class: "quiet", onclick: async () => download("sweep.csv", await askForTable("sweep", body)) },
          "download CSV",
        ),
      ),
    );
    plot.resize();
  }
}
