// Practice: a question about this system, an answer as it is written on paper, and what a careful teacher says of it.
import { ask } from "./api.js";
import { element, fill } from "./dom.js";
import { foot, problemNote } from "./foot.js";
import { formula } from "./formula.js";
import { prose, short, symbol, symbolNode } from "./numbers.js";

/** @typedef {import("./system.js").SystemPage} SystemPage */
/** @typedef {{ name: string, title: string, hint: string, expect: (page: SystemPage) => any, rule?: any }} Question */

/** A formula or an equation: of letters, so that no number of the page is asked for. @param {SystemPage} page @param {string} kind @param {string} of */
const ofSystem = (page, kind, of) => ({ [kind]: page.subject.body("system"), of });

/** What can be asked of a system. @param {SystemPage} page @returns {Question[]} */
function questionsOf(page) {
  const { coordinates, scene } = page.subject;
  const can = (/** @type {string} */ endpoint) => !page.capabilities || page.capabilities.includes(endpoint);
  const angle = scene.coordinates.find((/** @type {any} */ q) => q.unit === "rad")?.name;
  const energies = scene.lagrangian ? ["L"] : ["T", "V", "L"];
  /** @type {Question[]} */
  const all = energies.map((of) => ({
    name: of,
    title: `${{ T: "the kinetic energy", V: "the potential energy", L: "the Lagrangian" }[of]} ${of}`,
    hint: "1/2 m l^2 theta'^2, or LaTeX",
    expect: (asked) => ofSystem(asked, "expression", of),
  }));
  for (const of of coordinates)
    all.push({
      name: `equation_${of}`,
      title: `the equation of motion of ${symbol(of)}`,
      hint: `${of}'' = …, in any form`,
      expect: (asked) => ofSystem(asked, "equation", of),
    });
  if (can("modes"))
    all.push({
      name: "omega",
      title: "the angular frequencies ω of small oscillations",
      hint: "2.1, 3.4 rad/s, in any order",
      expect: (asked) => ({ modes: asked.subject.body("parameters"), at: "/modes/*/omega" }),
      rule: { any_order: true },
    });
  if (can("turning_points") && coordinates.length === 1 && angle)
    all.push({
      name: "max",
      title: `the largest ${symbol(angle)}`,
      hint: "55deg, or radians",
      expect: (asked) => ({ turning_points: asked.subject.body("initial"), at: `/${angle}_max` }),
    });
  return all;
}

/** A complaint of the reader, which may begin small. @param {string} text */
const sentence = (text) => text.slice(0, 1).toUpperCase() + text.slice(1) + (/[.!?]$/.test(text) ? "" : ".");

export class PracticeView {
  /** @param {SystemPage} page */
  constructor(page) {
    this.page = page;
    this.shown = "";
    this.result = element("div", { class: "verdict", "aria-live": "polite" });
    this.answer = element("textarea", {
      id: "practice-answer",
      rows: "3",
      class: "practice",
      spellcheck: "false",
      autocomplete: "off",
      maxlength: "4000",
      onkeydown: (/** @type {KeyboardEvent} */ event) => {
        if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) this.check();
      },
    });
    this.chooser = element("p", { class: "choice" });
    this.node = element(
      "div",
      {},
      element(
        "form",
        {
          onsubmit: (event) => {
            event.preventDefault();
            this.check();
          },
        },
        this.chooser,
        element("label", { for: "practice-answer", class: "hint" }, "Your answer"),
        this.answer,
        element("p", {}, element("button", {}, "Check")),
      ),
      this.result,
    );
  }

  /** @returns {Question} */
  get question() {
    const wanted = this.page.subject.values.get("_question");
    const all = questionsOf(this.page);
    return all.find(({ name }) => name === wanted) ?? all[0];
  }

  async show() {
    const { question } = this;
    const key = JSON.stringify([question.name, question.expect(this.page), this.page.capabilities]);
    if (key === this.shown) return;
    this.shown = key;
    const select = element(
      "select",
      { id: "practice-question", onchange: () => this.page.set("_question", select.value) },
      ...questionsOf(this.page).map(({ name, title }) =>
        element("option", { value: name, selected: name === question.name }, title),
      ),
    );
    fill(this.chooser, element("label", { for: "practice-question" }, "Write down "), select);
    this.answer.placeholder = question.hint;
    fill(this.result);
  }

  async check() {
    const submitted = this.answer.value.trim();
    if (!submitted) return this.answer.focus();
    const { question } = this;
    const rule = question.rule ? { rule: question.rule } : {};
    const body = { items: [{ id: question.name, expect: question.expect(this.page), submitted, ...rule }] };
    try {
      const { items } = await ask("check", body);
      fill(this.result, ...this.verdict(items[0]), foot({ endpoint: "check", body }));
    } catch (error) {
      fill(this.result, problemNote(error));
    }
  }

  /** @param {any} item */
  verdict(item) {
    const word =
      item.correct === null ? (item.format_errors.length ? "It cannot be read" : "No verdict") : item.correct ? "Right" : "Wrong";
    const kind = item.correct === null ? "unclear" : item.correct ? "right" : "wrong";
    const said = [item.diagnosis?.text, ...item.feedback, ...item.format_errors.map(sentence)].filter(Boolean);
    return [
      element("p", { class: `result ${kind}` }, element("strong", {}, `${word}. `), prose(said.join(" "))),
      item.understood?.latex ? element("p", {}, "Read as ", ...[item.understood].flat().flatMap((one) => this.readAs(one))) : "",
      item.counterexample?.state ? this.counterexample(item.counterexample) : "",
    ];
  }

  /** One formula, or the equations of all coordinates. @param {{ text: string | string[], latex: string | string[] }} understood */
  readAs({ text, latex }) {
    const texts = [text].flat();
    return [latex].flat().flatMap((one, i) => [i ? ", " : "", formula({ text: texts[i], latex: one })]);
  }

  /** A state at which it is seen, with what the answer gives there. @param {any} counterexample */
  counterexample({ state, ...given }) {
    const entries = [...Object.entries(state), ...Object.entries(given)];
    return element(
      "p",
      { class: "quiet-words" },
      "It is seen at ",
      ...entries.flatMap(([name, value], i) => [
        i ? ", " : "",
        name === "value" ? "where it gives " : symbolNode(name),
        name === "value" ? "" : " = ",
        short(Number(value), 4),
      ]),
      ".",
    );
  }
}
