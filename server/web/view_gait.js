// Periodic gaits: how they walk, and whether a small stumble dies out.
import { ask } from "./api.js";
import { element, fill, table } from "./dom.js";
import { Figure } from "./figure.js";
import { foot } from "./foot.js";
import { Motion } from "./motion.js";
import { quantity, short, symbol, unitText } from "./numbers.js";
import { Plot } from "./plot.js";

/** @typedef {import("./system.js").SystemPage} SystemPage */

export class GaitView {
  /** @param {SystemPage} page */
  constructor(page) {
    this.page = page;
    this.node = element("div", {});
  }

  get chosen() {
    return this.page.subject.values.get("_gait") ?? "long";
  }

  /** @param {AbortSignal} signal */
  async show(signal) {
    const body = this.page.subject.body("parameters");
    const answer = await ask("gait", body, signal);
    if (!answer.gaits.length) {
      fill(
        this.node,
        element("p", {}, typeof answer.reason === "string" ? answer.reason : "There is no gait."),
        foot({ endpoint: "gait", body }),
      );
      return;
    }
    const circle = this.circle(answer.gaits);
    fill(this.node, this.table(answer), circle.node, foot({ endpoint: "gait", body }));
    circle.resize();
    await this.walk(answer, signal);
  }

  /** @param {any} answer */
  table(answer) {
    const row = (/** @type {string} */ title, /** @type {(gait: any) => (Node | string)} */ cell) =>
      element(
        "tr",
        {},
        element("th", { scope: "row" }, title),
        ...answer.gaits.map((/** @type {any} */ gait) => element("td", {}, cell(gait))),
      );
    const pick = (/** @type {any} */ gait) =>
      element(
        "label",
        {},
        element("input", {
          type: "radio",
          name: "gait",
          checked: gait.kind === this.chosen,
          onchange: () => this.page.set("_gait", gait.kind),
        }),
        `${gait.kind}, ${gait.stable ? "stable" : "unstable"}`,
      );
    return table(
      {},
      row("gait", pick),
      row("step time / s", (gait) => quantity(gait.step_time, { error: gait.error.step_time })),
      row("step length / m", (gait) => quantity(gait.step_length, { error: gait.error.step_length })),
      ...Object.keys(answer.gaits[0].state).map((name) =>
        row(`${symbol(name)} / ${unitText(answer.units[name])}`, (gait) =>
          quantity(gait.state[name], { error: gait.error.state[name] }),
        ),
      ),
      row("multipliers", (gait) =>
        gait.multipliers
          .filter((/** @type {any} */ m) => m.im >= 0)
          .map((/** @type {any} */ m) => short(m.re, 4) + (m.im ? ` ± ${short(m.im, 4)} i` : ""))
          .join(", "),
      ),
    );
  }

  /** A stumble dies out where all multipliers are inside the unit circle. @param {any[]} gaits */
  circle(gaits) {
    const plot = new Plot({
      title: "Multipliers and the unit circle",
      isSquare: true,
      hasEqualScales: true,
      x: { label: "real part" },
      y: { label: "imaginary part" },
    });
    const angles = Array.from({ length: 121 }, (_, i) => (2 * Math.PI * i) / 120);
    const named = gaits.map((gait, i) => ({
      x: gait.multipliers.map((/** @type {any} */ m) => m.re),
      y: gait.multipliers.map((/** @type {any} */ m) => m.im),
      joined: false,
      colour: i ? "blue" : "vermillion",
      marker: /** @type {"dot" | "cross"} */ (i ? "dot" : "cross"),
      label: gait.kind,
    }));
    plot.set({
      series: [{ x: angles.map(Math.cos), y: angles.map(Math.sin), colour: "soft", width: 1 }, ...named],
      said: gaits
        .map(
          (gait) =>
            `${gait.kind}: multipliers of size ${gait.multipliers.map((/** @type {any} */ m) => short(Math.hypot(m.re, m.im), 3)).join(" and ")}`,
        )
        .join("; "),
    });
    return plot;
  }

  /** The chosen gait walks, and the other one beside it. @param {any} answer @param {AbortSignal} signal */
  async walk(answer, signal) {
    const { scene, coordinates } = this.page.subject;
    const motionOf = async (/** @type {any} */ gait) => {
      const body = { ...this.page.subject.body("parameters"), initial: gait.state, t_end: 8, samples: 481 };
      return new Motion(await ask("simulate", body, signal), coordinates);
    };
    const first = answer.gaits.find((/** @type {any} */ gait) => gait.kind === this.chosen) ?? answer.gaits[0];
    const other = answer.gaits.find((/** @type {any} */ gait) => gait !== first);
    const motion = await motionOf(first);
    const ghost = other ? await motionOf(other) : null;
    this.page.borrow(motion, new Figure(scene, answer.request.parameters, {}), `The ${first.kind} gait walks down the slope`);
    this.page.stage.shown.ghost = ghost;
    this.page.stage.clock.play();
  }

  leave() {
    this.page.giveBack();
  }
}
