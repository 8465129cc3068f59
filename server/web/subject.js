// What is asked about: a system of the catalogue or a scene of one's own, with the numbers that were changed.

/** @typedef {Record<string, any>} Body */

const plainNumber = /^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$/;

/** A number as it was typed; anything else is for the service to read. @param {string} text */
export function typed(text) {
  return plainNumber.test(text) ? Number(text) : text;
}

export class Subject {
  /** @param {any} scene @param {Map<string, string>} values @param {boolean} isInline */
  constructor(scene, values, isInline) {
    this.scene = scene;
    this.values = values;
    this.isInline = isInline;
    this.parameters = (scene.parameters ?? []).map((/** @type {any} */ one) => one.name);
    this.coordinates = (scene.coordinates ?? []).map((/** @type {any} */ one) => one.name);
    this.velocities = this.coordinates.map((/** @type {string} */ name) => `${name}_dot`);
    this.inputs = (scene.inputs ?? []).map((/** @type {any} */ one) => one.name);
    this.hasConditions = Boolean(scene.valid_while?.length || scene.reports?.length);
  }

  /** @param {string[]} names @returns {Body | undefined} those that were changed */
  changed(names) {
    const entries = names.filter((name) => this.values.has(name)).map((name) => [name, typed(this.values.get(name) ?? "")]);
    return entries.length ? Object.fromEntries(entries) : undefined;
  }

  /** @param {"system" | "parameters" | "initial"} last how much of it a question uses @returns {Body} */
  body(last) {
    /** @type {Body} */
    const body = { system: this.isInline ? this.scene : this.scene.name };
    const add = (/** @type {string} */ name, /** @type {Body | undefined} */ values) => {
      if (values) body[name] = values;
    };
    if (last !== "system") add("parameters", this.changed(this.parameters));
    if (last === "initial") add("initial", this.changed([...this.coordinates, ...this.velocities]));
    if (last !== "system") {
      const inputs = this.inputs.filter((/** @type {string} */ name) => this.values.has(name));
      add(
        "inputs",
        inputs.length ? Object.fromEntries(inputs.map((/** @type {string} */ name) => [name, this.values.get(name)])) : undefined,
      );
    }
    return body;
  }

  /** How long the motion is shown, in seconds. */
  get duration() {
    const wanted = Number(this.values.get("t_end"));
    return wanted > 0 && wanted <= 10000 ? wanted : 10;
  }

  get accuracy() {
    return this.values.get("accuracy") ?? "balanced";
  }

  /** A motion in rows close enough to be drawn. @param {string[]} include */
  motionBody(include) {
    const body = { ...this.body("initial"), t_end: this.duration, samples: Math.min(10001, Math.ceil(60 * this.duration) + 1) };
    const wanted = this.hasConditions && !include.includes("validity") ? [...include, "validity"] : include;
    const accuracy = /^[0-9.e-]+$/.test(this.accuracy) ? { max_error: Number(this.accuracy) } : { accuracy: this.accuracy };
    return { ...body, ...accuracy, ...(wanted.length ? { include: wanted } : {}) };
  }
}
