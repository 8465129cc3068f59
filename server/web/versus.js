// One column against another: the phase portrait, unless something else is wanted.
import { broken, valueAt } from "./columns.js";
import { element, fill } from "./dom.js";
import { symbol, unitText } from "./numbers.js";
import { Plot } from "./plot.js";

/** @typedef {import("./system.js").SystemPage} SystemPage */

const fine = 3; // instants drawn between two rows

export class Versus {
  /** @param {SystemPage} page @param {string[]} columns */
  constructor(page, columns) {
    this.page = page;
    this.columns = columns;
    this.shown = "";
    /** @type {Plot | null} */
    this.plot = null;
    this.box = element("div");
    this.node = element("div", {}, this.chooser(), this.box);
  }

  get names() {
    const { values, coordinates } = this.page.subject;
    const wanted = (/** @type {string} */ key, /** @type {string} */ usual) =>
      this.columns.includes(values.get(key) ?? "") ? String(values.get(key)) : usual;
    const x = wanted("_x", coordinates[0]);
    return [x, wanted("_y", coordinates.includes(x) ? `${x}_dot` : x)];
  }

  chooser() {
    const select = (/** @type {string} */ key, /** @type {number} */ which, /** @type {string} */ label) => {
      const node = element(
        "select",
        { "aria-label": label, onchange: () => this.page.set(key, node.value) },
        ...this.columns.map((name) => element("option", { value: name, selected: name === this.names[which] }, symbol(name))),
      );
      return node;
    };
    return element(
      "p",
      { class: "choice" },
      select("_y", 1, "Column upwards"),
      " against ",
      select("_x", 0, "Column to the right"),
    );
  }

  /** Only columns of the answer can be shown. @param {any} answer @param {(unit: string | undefined) => number} factor */
  show(answer, factor) {
    const [x, y] = this.names;
    const { motion } = this.page;
    if (!motion || !answer.trajectory[x] || !answer.trajectory[y]) {
      fill(this.box);
      this.plot = null;
      return;
    }
    this.factors = [factor(answer.units[x]), factor(answer.units[y])];
    const label = (/** @type {string} */ name, /** @type {number} */ by) => {
      const unit = unitText(by === 1 ? answer.units[name] : answer.units[name].replace("rad", "deg"));
      return unit ? `${symbol(name)} / ${unit}` : symbol(name);
    };
    const labels = [label(x, this.factors[0]), label(y, this.factors[1])];
    if (!this.plot || this.shown !== labels.join()) {
      const title = y === `${x}_dot` ? `Phase portrait of ${symbol(x)}` : `${symbol(y)} against ${symbol(x)}`;
      this.plot = new Plot({ title, isSquare: true, hasLabels: false, x: { label: labels[0] }, y: { label: labels[1] } });
      this.shown = labels.join();
      fill(this.box, this.plot.node);
    }
    const [xs, ys] = [x, y].map((name, i) => this.curve(name, this.factors?.[i] ?? 1));
    this.plot.set({ series: [{ x: xs, y: ys, colour: "blue" }], said: `${symbol(y)} against ${symbol(x)}.` });
  }

  /** A column with instants between its rows, broken where the state jumps. @param {string} name @param {number} factor */
  curve(name, factor) {
    const motion = /** @type {import("./motion.js").Motion} */ (this.page.motion);
    const { times } = motion;
    const steps = times.length > 3000 ? 1 : fine;
    const all = times.flatMap((t, i) =>
      i + 1 < times.length ? Array.from({ length: steps }, (_, k) => t + ((times[i + 1] - t) * k) / steps) : [t],
    );
    return broken(
      all,
      all.map((t) => factor * valueAt(motion, name, t)),
      motion.jumpTimes,
    ).y;
  }

  /** @param {number} t */
  tick(t) {
    const { motion } = this.page;
    if (!this.plot || !motion || !this.factors) return;
    const [x, y] = this.names;
    this.plot.showDot(this.factors[0] * valueAt(motion, x, t), this.factors[1] * valueAt(motion, y, t));
  }
}
