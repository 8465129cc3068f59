// The page of one system: its drawing, its numbers, and beside them one of the views.
import { Problem, ask, read } from "./api.js";
import { element, fill } from "./dom.js";
import { compiled } from "./expression.js";
import { Figure } from "./figure.js";
import { problemNote } from "./foot.js";
import { Latest } from "./latest.js";
import { hashOf, remember } from "./link.js";
import { Motion } from "./motion.js";
import { NumberBoard } from "./number_board.js";
import { prose, short, symbol } from "./numbers.js";
import { Stage } from "./stage.js";
import { Subject } from "./subject.js";
import { views } from "./views.js";

/** What the motion does, in a sentence. @param {any} answer @param {any} scene */
export function sentence(answer, scene) {
  const parts = scene.coordinates.map((/** @type {any} */ q) => {
    const column = answer.trajectory[q.name].filter(Number.isFinite);
    const [low, high] = [
      column.reduce((/** @type {number} */ a, /** @type {number} */ b) => Math.min(a, b)),
      column.reduce((/** @type {number} */ a, /** @type {number} */ b) => Math.max(a, b)),
    ];
    return `${symbol(q.name)} is between ${short(low, 3)} and ${short(high, 3)} ${q.unit}`;
  });
  return `${scene.title ?? scene.name}: ${parts.join(", ")}, over ${short(answer.t_reached, 3)} s.`;
}

export class SystemPage {
  /** @param {HTMLElement} host @param {Subject} subject @param {string[]} path @param {string[] | null} capabilities @param {AbortSignal} left */
  constructor(host, subject, path, capabilities, left) {
    this.host = host;
    this.subject = subject;
    this.path = path;
    this.capabilities = capabilities;
    this.left = left;
    this.stage = new Stage({ onDrag: (values) => this.setMany(values) });
    this.board = new NumberBoard(subject, (name, text) => this.set(name, text));
    this.tabs = element("nav", { class: "views", "aria-label": "What to show" });
    this.section = element("section", { class: "view", "aria-live": "off" });
    this.node = element(
      "div",
      { class: "columns" },
      this.tabs,
      element("div", { class: "left" }, this.stage.node, this.board.node),
      element("div", { class: "right" }, this.section),
    );
    this.motionLatest = new Latest(
      (signal) => this.askMotion(signal),
      (error) => this.failed(error),
    );
    this.viewLatest = new Latest(
      (signal) => this.view?.show(signal) ?? Promise.resolve(),
      (error) => this.viewFailed(error),
    );
    this.stage.clock.onChange((clock) => this.view?.tick?.(clock.time));
    left.addEventListener("abort", () => this.stop());
  }

  /** The same page for a scene that was changed. @param {Subject} subject */
  setSubject(subject) {
    this.subject = subject;
    const board = new NumberBoard(subject, (name, text) => this.set(name, text));
    this.board.node.replaceWith(board.node);
    this.board = board;
    this.answer = null;
    this.open(this.part?.name);
    this.changed();
  }

  stop() {
    this.stage.clock.pause();
    this.motionLatest.stop();
    this.viewLatest.stop();
  }

  /** @param {string | undefined} name */
  open(name) {
    const part = views.find((view) => view.name === name) ?? views[0];
    this.part = part;
    this.showTabs();
    this.view?.leave?.();
    this.view = part.make(this);
    fill(this.section, this.view.node);
    this.showOpenTab();
    this.motionLatest.wish();
    this.viewLatest.wish();
  }

  showTabs() {
    const offered = views.filter((view) => !this.capabilities || this.capabilities.includes(view.needs));
    fill(
      this.tabs,
      ...offered.map((view) =>
        element(
          "a",
          {
            href: this.addressOf(view.name),
            "aria-current": view === this.part ? "page" : null,
          },
          view.title,
        ),
      ),
    );
  }

  /** On a phone the tabs are one line that is moved sideways. */
  showOpenTab() {
    const open = /** @type {HTMLElement | null} */ (this.tabs.querySelector("[aria-current]"));
    if (open) this.tabs.scrollLeft = open.offsetLeft - (this.tabs.clientWidth - open.offsetWidth) / 2;
  }

  /** @param {string} view */
  addressOf(view) {
    return hashOf({ path: [...this.path, view], values: this.subject.values });
  }

  /** Another view of the same subject needs no new page. @param {import("./link.js").Address} address @returns {boolean} */
  turnTo(address) {
    if (this.path.some((part, i) => address.path[i] !== part)) return false;
    const values = this.subject.values;
    const isSame =
      values.size === address.values.size && [...address.values].every(([name, value]) => values.get(name) === value);
    if (!isSame) return false;
    this.open(address.path[this.path.length]);
    return true;
  }

  /** @param {string} name @param {string | null} text null: the default */
  set(name, text) {
    if (text === null) this.subject.values.delete(name);
    else this.subject.values.set(name, text);
    this.changed();
  }

  /** @param {Record<string, number>} values */
  setMany(values) {
    for (const [name, value] of Object.entries(values)) this.subject.values.set(name, String(value));
    this.changed();
  }

  changed() {
    remember({
      path: [...this.path, ...(this.part && this.part !== views[0] ? [this.part.name] : [])],
      values: this.subject.values,
    });
    this.showTabs();
    this.motionLatest.wish();
    this.viewLatest.wish();
  }

  /** Which columns the present view wants beside the state. @type {string[]} */
  include = [];

  /** @param {AbortSignal} signal */
  async askMotion(signal) {
    this.motionBody = this.subject.motionBody(this.include);
    const answer = await ask("simulate", this.motionBody, signal);
    if (this.left.aborted) return;
    this.answer = answer;
    this.board.show(answer.request);
    this.figure = new Figure(this.subject.scene, answer.request.parameters, answer.request.inputs);
    this.motion = new Motion(answer, this.subject.coordinates);
    if (!this.borrowed) this.showMotion();
    this.view?.motionCame?.();
  }

  showMotion() {
    const { answer, figure, motion } = this;
    if (!answer || !figure || !motion) return;
    this.stage.node.hidden = figure.dimension === 0;
    this.stage.setFigure(figure);
    this.stage.setMotion(motion, answer.stop ? answer.stop.message : "", answer.accuracy.horizon);
    this.stage.canvas.setAttribute("aria-label", sentence(answer, this.subject.scene));
  }

  /** A view shows a motion of its own. @param {any} motion @param {Figure} figure @param {string} said */
  borrow(motion, figure, said) {
    this.borrowed = true;
    this.stage.setFigure(figure);
    this.stage.setMotion(motion);
    this.stage.canvas.setAttribute("aria-label", said);
    this.stage.clock.seek(0);
  }

  giveBack() {
    if (!this.borrowed) return;
    this.borrowed = false;
    this.stage.shown.ghost = null;
    this.showMotion();
  }

  /** @param {unknown} error */
  failed(error) {
    const known = error instanceof Problem ? this.board.complain(error.body.errors ?? []) : 0;
    if (known) return;
    this.view?.motionFailed?.(error);
  }

  /** @param {unknown} error */
  viewFailed(error) {
    const known = error instanceof Problem ? this.board.complain(error.body.errors ?? []) : 0;
    if (!known && this.view) fill(this.view.node, problemNote(error));
  }
}

/** @param {any} scene @returns {Record<string, number>} the defaults, as far as they can be computed here */
export function defaultsOf(scene) {
  /** @type {Record<string, number>} */
  const values = {};
  for (let round = 0; round < 4; ++round) {
    for (const one of scene.parameters ?? []) values[one.name] = compiled(one.default)(values);
  }
  return values;
}

/** @param {HTMLElement} main @param {import("./link.js").Address} address @param {string} name @param {string | undefined} part @param {AbortSignal} left */
export async function showSystem(main, address, name, part, left) {
  const scene = await read(`/v1/systems/${encodeURIComponent(name)}/scene`);
  if (left.aborted) return;
  document.title = `${scene.title ?? scene.name} · qdot`;
  const page = new SystemPage(main, new Subject(scene, address.values, false), ["systems", name], null, left);
  fill(
    main,
    element(
      "header",
      { class: "title" },
      element("h1", {}, scene.title ?? scene.name),
      element("p", {}, prose(scene.description ?? "")),
    ),
    page.node,
  );
  main.addEventListener(
    "address",
    (event) => {
      if (page.turnTo(/** @type {CustomEvent} */ (event).detail)) event.preventDefault();
    },
    { signal: left },
  );
  page.open(part);
  const { capabilities } = await read(`/v1/systems/${encodeURIComponent(name)}`);
  page.capabilities = capabilities;
  page.showTabs();
}
