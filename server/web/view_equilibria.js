// Where it can rest, and whether it stays there; and the parameter that makes a place an equilibrium.
import { ask } from "./api.js";
import { element, fill, table } from "./dom.js";
import { Figure } from "./figure.js";
import { foot, problemNote } from "./foot.js";
import { assumptions, formula } from "./formula.js";
import { quantity, short, symbol, symbolNode } from "./numbers.js";
import { typed } from "./subject.js";

/** @typedef {import("./system.js").SystemPage} SystemPage */

const svgSpace = "http://www.w3.org/2000/svg";
/** @param {string} name @param {Record<string, string | number>} attributes @param {...(Node | string)} children */
function svg(name, attributes, ...children) {
  const node = document.createElementNS(svgSpace, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, String(value));
  node.append(...children);
  return node;
}

/** A state that rests, for the drawing. */
class Rest {
  /** @param {Record<string, number>} state */
  constructor(state) {
    Object.assign(this, { start: 0, end: 1, jumps: [] });
    this.state = state;
  }
  section() {
    return 0;
  }
  at() {
    return { ...this.state, t: 0 };
  }
}

export class EquilibriaView {
  /** @param {SystemPage} page */
  constructor(page) {
    this.page = page;
    this.found = element("div", {});
    this.solved = element("div", {});
    this.node = element("div", {}, this.found, this.solver());
  }

  get coordinates() {
    return this.page.subject.coordinates;
  }

  /** @param {AbortSignal} signal */
  async show(signal) {
    const body = this.page.subject.body("parameters");
    const answer = await ask("equilibria", body, signal);
    const count = answer.equilibria.length;
    fill(
      this.found,
      element(
        "p",
        {},
        `${count === 0 ? "No equilibrium" : count === 1 ? "One equilibrium" : `${count} equilibria`}${answer.complete ? ", and it is proven that there are no others." : "."}`,
      ),
      answer.reason
        ? element("p", {}, String(typeof answer.reason === "string" ? answer.reason : Object.values(answer.reason).join(" ")))
        : "",
      this.coordinates.length === 1 && this.unitOf(this.coordinates[0]) === "rad" ? this.dial(answer) : "",
      this.table(answer),
      foot({ endpoint: "equilibria", body }),
    );
  }

  /** @param {string} name */
  unitOf(name) {
    return this.page.subject.scene.coordinates.find((/** @type {any} */ q) => q.name === name)?.unit;
  }

  /** Angles on a circle, down where the angle is 0. @param {any} answer */
  dial(answer) {
    const name = this.coordinates[0];
    const place = (/** @type {number} */ angle, /** @type {number} */ r) => [110 + r * Math.sin(angle), 90 + r * Math.cos(angle)];
    const marks = answer.equilibria.map((/** @type {any} */ one) => {
      const angle = one.state[name];
      const [x, y] = place(angle, 60);
      const [tx, ty] = place(angle, 79);
      return svg(
        "g",
        {},
        svg("circle", { cx: x, cy: y, r: 7, class: `rest ${one.stability}` }),
        svg(
          "text",
          { x: tx, y: ty + 4, "text-anchor": Math.abs(Math.sin(angle)) < 0.2 ? "middle" : Math.sin(angle) > 0 ? "start" : "end" },
          `${short((angle * 180) / Math.PI, 3)}°`,
        ),
      );
    });
    const said = answer.equilibria
      .map((/** @type {any} */ one) => `${short((one.state[name] * 180) / Math.PI, 3)}° ${one.stability}`)
      .join(", ");
    return element(
      "div",
      { class: "dial-row" },
      svg(
        "svg",
        { viewBox: "0 0 220 184", class: "dial", role: "img", "aria-label": `Equilibria: ${said}` },
        svg("circle", { cx: 110, cy: 90, r: 60, class: "ring" }),
        ...marks,
      ),
      element("p", { class: "quiet-words" }, "● stable   ○ unstable"),
    );
  }

  /** @param {any} answer */
  table(answer) {
    const heads = [
      ...this.coordinates.map((/** @type {string} */ name) => symbolNode(name)),
      "stability",
      "eigenvalues / s⁻¹",
      "drawing",
    ];
    return table(
      { heads },
      ...answer.equilibria.map((/** @type {any} */ one) =>
        element(
          "tr",
          {},
          ...this.coordinates.map((/** @type {string} */ name) =>
            element("td", {}, quantity(one.state[name], { unit: answer.units[name], error: one.error?.[name] || undefined })),
          ),
          element(
            "td",
            { class: one.stability },
            one.stability,
            one.nonlinear ? `, ${typeof one.nonlinear === "string" ? one.nonlinear : (one.nonlinear.stability ?? "")}` : "",
          ),
          element("td", { class: "number" }, this.eigenvalues(one.eigenvalues ?? [])),
          element("td", {}, element("button", { type: "button", class: "quiet", onclick: () => this.rest(one, answer) }, "show")),
        ),
      ),
    );
  }

  /** @param {{ re: number, im: number }[]} values */
  eigenvalues(values) {
    const texts = values
      .filter(({ im }) => im >= 0)
      .map(({ re, im }) => {
        if (im === 0) return short(re, 4);
        return `${re === 0 ? "" : short(re, 4) + " "}± ${short(im, 4)} i`;
      });
    return texts.join(", ");
  }

  /** @param {any} one @param {any} answer */
  rest(one, answer) {
    const figure = new Figure(this.page.subject.scene, answer.request.parameters, answer.request.inputs ?? {});
    this.page.borrow(new Rest(one.state), figure, `The ${one.stability} equilibrium`);
    this.page.stage.clock.pause();
  }

  solver() {
    const { scene } = this.page.subject;
    const names = (scene.parameters ?? []).map((/** @type {any} */ one) => one.name);
    if (!names.length) return "";
    const parameter = element(
      "select",
      { id: "solve-for" },
      ...names.map((/** @type {string} */ name) =>
        element("option", { value: name, selected: /^(Omega|omega)/.test(name) }, symbol(name)),
      ),
    );
    /** @type {{ name: string, field: HTMLInputElement }[]} */
    const fields = this.coordinates.map((/** @type {string} */ name) => ({
      name,
      field: element("input", {
        type: "text",
        class: "value",
        value: this.unitOf(name) === "rad" ? "30deg" : "",
        "aria-label": `${name} of the equilibrium`,
        autocomplete: "off",
      }),
    }));
    const solve = async () => {
      const at = Object.fromEntries(
        fields.filter(({ field }) => field.value.trim()).map(({ name, field }) => [name, typed(field.value.trim())]),
      );
      const body = { ...this.page.subject.body("parameters"), solve_for: parameter.value, at };
      try {
        this.showSolved(await ask("equilibria", body), body, parameter.value);
      } catch (error) {
        fill(this.solved, problemNote(error));
      }
    };
    return element(
      "section",
      {},
      element("h2", {}, "Which parameter makes it rest there?"),
      element(
        "form",
        {
          class: "solver",
          onsubmit: (event) => {
            event.preventDefault();
            solve();
          },
        },
        element("label", { for: "solve-for" }, "Find "),
        parameter,
        ...fields.flatMap(({ name, field }) => [element("span", {}, " at ", symbolNode(name), " = "), field]),
        element("button", {}, "Find"),
      ),
      this.solved,
    );
  }

  /** @param {any} answer @param {any} body @param {string} name */
  showSolved(answer, body, name) {
    const value = answer[name];
    const reason = typeof answer.reason === "string" ? answer.reason : Object.values(answer.reason ?? {}).join(" ");
    fill(
      this.solved,
      element(
        "p",
        { class: "result" },
        symbolNode(name),
        " = ",
        quantity(value, {
          unit: answer.units?.[name],
          error: typeof answer.error === "number" ? answer.error : answer.error?.[name],
        }),
        value === null || value === undefined ? ` ${reason}` : `, ${answer.stability}`,
      ),
      answer.exact ? element("p", { class: "result" }, symbolNode(name), " = ", formula(answer.exact)) : "",
      assumptions([answer.exact]),
      foot({ endpoint: "equilibria", body }),
    );
  }

  leave() {
    this.page.giveBack();
  }
}
