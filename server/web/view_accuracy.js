// What an error costs: error against work for this very motion, and what to ask for.
import { ask } from "./api.js";
import { element, fill } from "./dom.js";
import { foot } from "./foot.js";
import { Motion } from "./motion.js";
import { short } from "./numbers.js";
import { Plot } from "./plot.js";

/** @typedef {import("./system.js").SystemPage} SystemPage */

/** @type {Record<string, { colour: string, marker: any }>} */
const looks = {
  taylor: { colour: "blue", marker: "dot" },
  erk: { colour: "vermillion", marker: "square" },
  adams: { colour: "green", marker: "triangle" },
  bdf: { colour: "purple", marker: "diamond" },
  gauss: { colour: "orange", marker: "cross" },
};

export class AccuracyView {
  /** @param {SystemPage} page */
  constructor(page) {
    this.page = page;
    this.shown = "";
    /** @type {Plot | null} */
    this.plot = null;
    this.results = element("div", {});
    this.wish = element("p", { class: "result", "aria-live": "polite" });
    this.node = element("div", {}, this.slider(), this.wish, this.timing(), this.overlay(), this.results);
  }

  get wanted() {
    return Number(this.page.subject.values.get("_error") ?? 1e-6) || 1e-6;
  }

  /** Times are measured only where they are asked for: other answers are the same whenever they are asked. */
  get isTimed() {
    return this.page.subject.values.has("_timed");
  }

  timing() {
    const box = element("input", {
      type: "checkbox",
      checked: this.isTimed,
      onchange: () => this.page.set("_timed", box.checked ? "1" : null),
    });
    return element("p", {}, element("label", { class: "toggle" }, box, "Measure milliseconds, too, on the service's machine"));
  }

  /** @param {any} point */
  workOf(point) {
    return point.measured ? point.measured.cpu_us / 1000 : point.evaluations;
  }

  slider() {
    const range = element("input", {
      type: "range",
      min: "2",
      max: "13",
      step: "0.5",
      id: "wanted-error",
      value: String(-Math.log10(this.wanted)),
      oninput: () => this.want(10 ** -Number(range.value)),
    });
    this.range = range;
    return element("p", { class: "solver wide" }, element("label", { for: "wanted-error" }, "Wanted error "), range);
  }

  /** @param {number} error */
  want(error) {
    const wanted = Math.min(1e-2, Math.max(1e-13, Number(error.toPrecision(2))));
    this.page.subject.values.set("_error", String(wanted));
    if (this.range) this.range.value = String(-Math.log10(wanted));
    this.page.changed();
    this.showWish();
  }

  /** @param {AbortSignal} signal */
  async show(signal) {
    const body = {
      ...this.page.subject.body("initial"),
      t_end: this.page.subject.duration,
      ...(this.isTimed ? { measure: true } : {}),
    };
    const key = JSON.stringify(body);
    if (key !== this.shown) {
      if (!this.answer)
        fill(this.results, element("p", { class: "quiet-words" }, "Every method at every tolerance, against a reference …"));
      this.answer = await ask("accuracy", body, signal);
      this.shown = key;
      this.plot = this.newPlot();
      fill(
        this.results,
        this.plot.node,
        element(
          "p",
          { class: "quiet-words" },
          `${this.isTimed ? "Processor time is the service's own, the least of three runs, and differs from run to run and from machine to machine." : "Work is counted in evaluations of the accelerations, so that it is the same on every machine."} The heavy line is what nothing beats; the dashed one can be dragged.`,
        ),
        foot({ endpoint: "accuracy", body }),
      );
    }
    this.drawPoints();
    this.showWish();
  }

  newPlot() {
    return new Plot({
      title: "Error against work",
      height: 360,
      x: { label: "largest error", isLogarithmic: true, isReversed: true },
      y: { label: this.isTimed ? "processor time / ms" : "evaluations", isLogarithmic: true },
      onPick: (x) => this.want(x),
      isDraggable: true,
    });
  }

  drawPoints() {
    const usable = this.answer.points.filter((/** @type {any} */ one) => one.error > 0 && one.evaluations > 0);
    const names = [...new Set(usable.map((/** @type {any} */ one) => one.method))];
    const curves = names.map((name) => {
      const mine = usable
        .filter((/** @type {any} */ one) => one.method === name)
        .sort((/** @type {any} */ a, /** @type {any} */ b) => b.error - a.error);
      return {
        x: mine.map((/** @type {any} */ one) => one.error),
        y: mine.map((/** @type {any} */ one) => this.workOf(one)),
        label: String(name),
        width: 1,
        ...(looks[String(name)] ?? { colour: "sky", marker: "dot" }),
      };
    });
    const front = usable
      .filter((/** @type {any} */ one) => one.on_front)
      .sort((/** @type {any} */ a, /** @type {any} */ b) => b.error - a.error);
    const best = this.best();
    this.plot?.set({
      series: [
        {
          x: front.map((/** @type {any} */ one) => one.error),
          y: front.map((/** @type {any} */ one) => this.workOf(one)),
          colour: "ink",
          width: 3,
          alpha: 0.35,
        },
        ...curves,
        ...(best
          ? [{ x: [best.error], y: [this.workOf(best)], colour: "ink", marker: /** @type {"ring"} */ ("ring"), joined: false }]
          : []),
      ],
      marks: [{ x: this.wanted, label: "wanted" }],
      said: this.sentence(),
    });
  }

  /** The cheapest measured point that is good enough. */
  best() {
    const enough = (this.answer?.points ?? []).filter((/** @type {any} */ one) => one.error > 0 && one.error <= this.wanted);
    return enough.sort((/** @type {any} */ a, /** @type {any} */ b) => this.workOf(a) - this.workOf(b))[0];
  }

  sentence() {
    const best = this.best();
    if (!this.answer) return "";
    if (!best) return `No method reached ${short(this.wanted, 2)}.`;
    return `For an error of ${short(this.wanted, 2)}: ${best.method} at rtol ${short(best.rtol, 2)}, ${best.evaluations} evaluations in ${best.steps} steps${best.measured ? `, ${short(best.measured.cpu_us / 1000, 2)} ms` : ""}; its error is ${short(best.error, 2)}.`;
  }

  showWish() {
    fill(this.wish, this.sentence());
    this.drawPoints();
  }

  /** A rough run over the present one: where they part, one sees it. */
  overlay() {
    const box = element("input", { type: "checkbox", onchange: () => this.lay(box.checked) });
    return element(
      "p",
      {},
      element("label", { class: "toggle" }, box, "Lay a run of rtol 1e-3 over the drawing, in the second colour"),
    );
  }

  /** @param {boolean} isOn */
  async lay(isOn) {
    const { page } = this;
    if (!isOn) {
      page.stage.shown.ghost = null;
      page.stage.draw();
      return;
    }
    const { subject } = page;
    const answer = await ask("simulate", {
      ...subject.body("initial"),
      t_end: subject.duration,
      samples: Math.ceil(60 * subject.duration) + 1,
      rtol: 1e-3,
      method: "erk",
      verify: false,
    });
    page.stage.shown.ghost = new Motion(answer, subject.coordinates);
    page.stage.draw();
  }

  leave() {
    this.page.stage.shown.ghost = null;
    this.page.stage.draw();
  }
}
