// All numbers of a motion: parameters, start, inputs, how long and how exact.
import { NumberControl } from "./controls.js";
import { element } from "./dom.js";
import { compiled } from "./expression.js";
import { defaultsOf } from "./system.js";

/** @typedef {import("./subject.js").Subject} Subject */
/** @typedef {(name: string, text: string | null) => void} Change */

/** The unit of a velocity; a scene without units has none. @param {string | undefined} unit */
function rateUnit(unit) {
  if (unit === undefined) return undefined;
  return unit === "1" ? "1/s" : `${unit}/s`;
}

export class NumberBoard {
  /** @param {Subject} subject @param {Change} change */
  constructor(subject, change) {
    this.subject = subject;
    this.change = change;
    /** @type {Map<string, NumberControl>} */
    this.controls = new Map();
    /** @type {Map<string, HTMLInputElement>} */
    this.inputs = new Map();
    const { scene } = subject;
    const defaults = defaultsOf(scene);
    const parameters = (scene.parameters ?? []).map((/** @type {any} */ one) => this.control(one, defaults[one.name]));
    this.node = element(
      "form",
      { class: "numbers", onsubmit: (event) => event.preventDefault() },
      parameters.length ? element("fieldset", {}, element("legend", {}, "Parameters"), ...parameters) : "",
      element("fieldset", {}, element("legend", {}, "Start"), ...this.startControls(defaults)),
      element(
        "fieldset",
        {},
        element("legend", {}, "Motion"),
        ...this.inputFields(),
        this.durationControl(),
        this.accuracyChoice(),
      ),
      element("p", {}, element("button", { type: "button", onclick: () => this.resetAll() }, "All defaults")),
      element(
        "p",
        { class: "hint" },
        "A field takes units and formulas: 30deg, 12 cm, 2*m*g/l. A double click on a slider takes its default back.",
      ),
    );
  }

  resetAll() {
    for (const name of [...this.controls.keys(), ...this.subject.inputs, "accuracy"]) this.subject.values.delete(name);
    for (const [name, field] of this.inputs)
      field.value = this.subject.scene.inputs.find((/** @type {any} */ one) => one.name === name)?.default ?? "0";
    this.change("accuracy", null);
  }

  /** @param {any} declared @param {number} initial */
  control(declared, initial) {
    const control = new NumberControl(declared, Number.isFinite(initial) ? initial : 1, (text) =>
      this.change(declared.name, text),
    );
    this.controls.set(declared.name, control);
    return control.node;
  }

  /** @param {Record<string, number>} defaults */
  startControls(defaults) {
    return (this.subject.scene.coordinates ?? []).flatMap((/** @type {any} */ q) => [
      this.control(q, compiled(q.initial)(defaults)),
      this.control(
        { name: `${q.name}_dot`, unit: rateUnit(q.unit), meaning: "its rate" },
        compiled(q.initial_rate)(defaults),
      ),
    ]);
  }

  inputFields() {
    return (this.subject.scene.inputs ?? []).map((/** @type {any} */ input) => {
      const id = `input-${input.name}`;
      const field = element("input", {
        type: "text",
        id,
        class: "value wide",
        spellcheck: "false",
        autocomplete: "off",
        value: this.subject.values.get(input.name) ?? input.default ?? "0",
        placeholder: "0.8*cos(4*t)",
        onchange: () => this.change(input.name, field.value.trim() || null),
      });
      this.inputs.set(input.name, field);
      return element(
        "div",
        { class: "number-row" },
        element(
          "label",
          { for: id, title: input.meaning ?? "" },
          element("i", {}, input.name),
          `(t)`,
          element("span", { class: "meaning" }, input.meaning ?? ""),
        ),
        field,
        element("span", { class: "unit" }, input.unit ?? ""),
      );
    });
  }

  durationControl() {
    return this.control(
      { name: "t_end", title: "duration", unit: "s", domain: { minimum: 0.1, maximum: 60 } },
      this.subject.duration,
    );
  }

  accuracyChoice() {
    const words = [
      ["fast", "fast, 1e-3 of each column"],
      ["balanced", "balanced, 1e-6"],
      ["accurate", "accurate, 1e-9"],
      ["1e-12", "error 1e-12"],
    ];
    const select = element(
      "select",
      { id: "accuracy", onchange: () => this.change("accuracy", select.value === "balanced" ? null : select.value) },
      ...words.map(([value, label]) => element("option", { value, selected: value === this.subject.accuracy }, label)),
    );
    if (!words.some(([value]) => value === this.subject.accuracy))
      select.prepend(element("option", { value: this.subject.accuracy, selected: true }, `error ${this.subject.accuracy}`));
    return element("div", { class: "number-row" }, element("label", { for: "accuracy" }, "accuracy"), select);
  }

  /** The numbers as the service understood them. @param {any} request */
  show(request) {
    const values = { ...request.parameters, ...request.initial, t_end: request.t_end };
    for (const [name, control] of this.controls) {
      if (!(name in values)) continue;
      const typed = this.subject.values.get(name);
      control.show(values[name], typed);
    }
  }

  /** Shows each complaint at its field. @param {import("./api.js").FieldError[]} errors @returns {number} how many had one */
  complain(errors) {
    let shown = 0;
    for (const error of errors) {
      const name = (error.pointer ?? error.parameter ?? "").split("/").pop() ?? "";
      const control = this.controls.get(name);
      if (control) {
        control.complain(error);
        shown += 1;
      }
    }
    return shown;
  }
}
