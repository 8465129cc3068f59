// How far it swings: turning points as places where the effective potential meets the energy.
import { Problem, ask } from "./api.js";
import { element, fill, table } from "./dom.js";
import { compiled } from "./expression.js";
import { foot, notes } from "./foot.js";
import { assumptions, formula } from "./formula.js";
import { quantity, short, symbol, symbolNode, unitText } from "./numbers.js";
import { Plot } from "./plot.js";

/** @typedef {import("./system.js").SystemPage} SystemPage */

const kinds = {
  libration: "swings between two turning points",
  rotation: "never turns",
  separatrix: "creeps towards an unstable equilibrium",
  equilibrium: "rests",
  unbounded: "goes away for good",
};

export class TurningView {
  /** @param {SystemPage} page */
  constructor(page) {
    this.page = page;
    this.node = element("div", {});
    this.hasEnd = true;
  }

  get coordinate() {
    const { coordinates, values } = this.page.subject;
    const wanted = values.get("_coordinate") ?? "";
    const angle = this.page.subject.scene.coordinates.find((/** @type {any} */ q) => q.unit === "rad");
    return coordinates.includes(wanted) ? wanted : (angle?.name ?? coordinates[0]);
  }

  /** Where the energy alone does not tell, extremes are those of a motion and need its end; elsewhere an end may be one field too many. @param {AbortSignal} signal */
  async ask(signal) {
    const question = () => ({
      ...this.page.subject.body("initial"),
      coordinate: this.coordinate,
      ...(this.hasEnd ? { t_end: this.page.subject.duration } : {}),
    });
    try {
      return { body: question(), answer: await ask("turning_points", question(), signal) };
    } catch (error) {
      const isAboutEnd = error instanceof Problem && error.body.errors?.every((one) => (one.pointer ?? "").endsWith("/t_end"));
      if (!isAboutEnd) throw error;
      this.hasEnd = !this.hasEnd;
      return { body: question(), answer: await ask("turning_points", question(), signal) };
    }
  }

  /** @param {AbortSignal} signal */
  async show(signal) {
    const { body, answer } = await this.ask(signal);
    const plot = answer.equation ? this.potential(answer) : null;
    fill(
      this.node,
      this.chooser(),
      this.words(answer),
      ...notes(answer),
      this.numbers(answer),
      this.exactly(answer.exact ?? {}),
      plot?.node,
      this.reasons(answer),
      foot({ endpoint: "turning_points", body }),
    );
    plot?.resize();
  }

  chooser() {
    const { coordinates } = this.page.subject;
    if (coordinates.length < 2) return "";
    const select = element(
      "select",
      { id: "turning-of", onchange: () => this.page.set("_coordinate", select.value) },
      ...coordinates.map((/** @type {string} */ q) =>
        element("option", { value: q, selected: q === this.coordinate }, symbol(q)),
      ),
    );
    return element("p", { class: "choice" }, element("label", { for: "turning-of" }, "Turning points of "), select);
  }

  /** @param {any} answer */
  words(answer) {
    const how = /** @type {Record<string, string>} */ (kinds)[answer.motion];
    if (answer.method === "trajectory")
      return element(
        "p",
        {},
        `The extremes of ${symbol(answer.coordinate)} during the motion, up to ${short(answer.t_reached)} s.`,
      );
    return element(
      "p",
      {},
      symbolNode(answer.coordinate),
      ` ${how ?? ""}: a ${answer.motion}. Found as roots of one equation, without a simulation; the errors are proven.`,
    );
  }

  /** @param {any} answer */
  numbers(answer) {
    const name = answer.coordinate;
    const rows = [
      ["largest", `${name}_max`],
      ["least", `${name}_min`],
    ]
      .filter(([, key]) => answer[key] !== null && answer[key] !== undefined)
      .map(([word, key]) =>
        element(
          "tr",
          {},
          element("th", { scope: "row" }, word),
          element("td", {}, quantity(answer[key], { unit: answer.units[key], error: answer.error[key] })),
          element(
            "td",
            {},
            answer[`${key}_deg`] === undefined
              ? ""
              : quantity(answer[`${key}_deg`], { unit: "deg", error: answer.error[`${key}_deg`] }),
          ),
        ),
      );
    if (answer.period)
      rows.push(
        element(
          "tr",
          {},
          element("th", { scope: "row" }, "period"),
          element("td", {}, quantity(answer.period, { unit: "s", error: answer.error.period })),
          element("td", {}),
        ),
      );
    return table({}, ...rows);
  }

  /** What has a formula: the turning points, or the equation that they are roots of. @param {Record<string, any>} exact */
  exactly(exact) {
    const entries = Object.entries(exact);
    if (!entries.length) return "";
    return element(
      "section",
      { class: "exact" },
      element(
        "dl",
        { class: "terms" },
        ...entries.flatMap(([name, form]) => [
          element("dt", {}, name === "equation" ? "equation" : symbolNode(name)),
          element("dd", { tabindex: "0" }, formula(form)),
        ]),
      ),
      assumptions(Object.values(exact)),
    );
  }

  /** @param {any} answer */
  potential(answer) {
    const [left, right] = answer.equation.text.split(/ = (?=[^=]*$)/);
    const energy = answer.constants[right];
    const values = { ...answer.request.parameters, ...answer.constants };
    const name = answer.coordinate;
    const curve = compiled(left);
    const [low, high] = this.range(answer);
    const x = Array.from({ length: 481 }, (_, i) => low + ((high - low) * i) / 480);
    const ceiling =
      energy +
      6 *
        Math.max(
          1e-12,
          ...[this.start(answer)].map((q) => Math.abs(energy - curve({ ...values, [name]: q }))),
          this.depth(curve, values, name, x, energy),
        );
    const all = x.map((q) => {
      const v = curve({ ...values, [name]: q });
      return v > ceiling ? NaN : v;
    });
    const [first, last] = [all.findIndex(Number.isFinite), all.findLastIndex(Number.isFinite)];
    const [places, y] = [x.slice(first, last + 1), all.slice(first, last + 1)];
    const unit = unitText(answer.units[right] ?? "J");
    const plot = new Plot({
      title: "Effective potential",
      height: 260,
      x: { label: `${symbol(name)} / ${unitText(this.unitOf(name))}` },
      y: { label: `energy / ${unit}` },
    });
    const ends = [answer[`${name}_min`], answer[`${name}_max`]].filter((q) => q !== null && q !== undefined);
    plot.set({
      series: [
        { x: places, y, colour: "blue", label: "V eff" },
        { x: ends, y: ends.map(() => energy), colour: "vermillion", marker: "dot", width: 3 },
      ],
      marks: [{ y: energy, label: `${right} = ${short(energy)} ${unit}`, colour: "vermillion-text" }],
      said: `The effective potential of ${name}, and the energy ${short(energy)} that it meets at ${ends.map((q) => short(q)).join(" and ")}.`,
    });
    return plot;
  }

  /** How deep the curve lies below the energy. @param {(v: Record<string, number>) => number} curve @param {Record<string, number>} values @param {string} name @param {number[]} x @param {number} energy */
  depth(curve, values, name, x, energy) {
    return x.reduce((most, q) => Math.max(most, Math.min(1e300, energy - curve({ ...values, [name]: q })) || 0), 0) / 3;
  }

  /** @param {any} answer */
  start(answer) {
    return answer.request.initial[answer.coordinate];
  }

  /** @param {string} name */
  unitOf(name) {
    return this.page.subject.scene.coordinates.find((/** @type {any} */ q) => q.name === name)?.unit;
  }

  /** @param {any} answer @returns {[number, number]} */
  range(answer) {
    const name = answer.coordinate;
    const [low, high] = [answer[`${name}_min`] ?? this.start(answer), answer[`${name}_max`] ?? this.start(answer)];
    if (this.unitOf(name) === "rad") {
      const middle = (low + high) / 2;
      return [Math.min(low - 0.4, middle - Math.PI), Math.max(high + 0.4, middle + Math.PI)];
    }
    const around = 0.6 * (high - low) || Math.abs(low) || 1;
    return [low - around, high + around];
  }

  /** @param {any} answer */
  reasons(answer) {
    const all = [...new Set(Object.values(answer.reason ?? {}))];
    return all.length ? element("div", {}, ...all.map((text) => element("p", { class: "quiet-words" }, String(text)))) : "";
  }
}
