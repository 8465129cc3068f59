// A scene of one's own: its text, the service's messages at their places, and the same page as any system has.
import { Problem, ask, read } from "./api.js";
import { element, fill } from "./dom.js";
import { Editor } from "./editor.js";
import { problemNote } from "./foot.js";
import { TextMistake, nearest, placesIn } from "./json_places.js";
import { Latest } from "./latest.js";
import { packed, unpacked } from "./link.js";
import { Subject } from "./subject.js";
import { SystemPage } from "./system.js";
import { templates, written } from "./templates.js";

/** The messages of the service at their places in the text. @param {import("./api.js").FieldError[]} errors @param {string} text */
export function remarksOf(errors, text) {
  const places = placesIn(text);
  return errors.map((error) => {
    const pointer = decodeURIComponent((error.pointer ?? "").replace(/^#/, "")).replace(/^\/system/, "");
    const place = nearest(places, pointer);
    const isName = error.code === "unknown_field" && place.keyStart !== undefined;
    const start = isName ? Number(place.keyStart) : place.start;
    const end = isName ? text.indexOf(":", start) : place.end;
    return { start, end, text: error.detail, replacement: replacement(error, text.slice(start, end)) };
  });
}

/** What to write instead: a whole name, or the expression with the one name mended. @param {import("./api.js").FieldError} error @param {string} old */
function replacement(error, old) {
  if (!error.did_you_mean) return undefined;
  const wrong = /'([A-Za-z_]\w*)'/.exec(error.detail)?.[1];
  if (wrong && old.startsWith('"') && old !== `"${wrong}"`)
    return old.replace(new RegExp(`\\b${wrong}\\b`, "g"), error.did_you_mean);
  return old.startsWith('"') ? JSON.stringify(error.did_you_mean) : error.did_you_mean;
}

class OwnScene {
  /** @param {HTMLElement} main @param {import("./link.js").Address} address @param {string | undefined} part @param {AbortSignal} left */
  constructor(main, address, part, left) {
    this.main = main;
    this.address = address;
    this.part = part;
    this.left = left;
    this.editor = new Editor("", () => this.latest.wish());
    this.heading = element("h1", {}, "Your own scene");
    this.problem = element("div", {});
    this.shown = "";
    this.latest = new Latest(
      (signal) => this.check(signal),
      (error) => fill(this.problem, problemNote(error)),
    );
    left.addEventListener("abort", () => this.latest.stop());
  }

  chooser() {
    const select = element(
      "select",
      { id: "template", onchange: () => this.take(select.value) },
      element("option", { value: "" }, "a template …"),
      ...Object.keys(templates).map((name) => element("option", { value: name }, name)),
    );
    return element("p", { class: "choice" }, element("label", { for: "template" }, "Begin with "), select);
  }

  /** @param {string} name */
  take(name) {
    if (!templates[name]) return;
    this.address.values.clear();
    this.editor.set(written(templates[name]));
    this.latest.wish();
  }

  /** @param {AbortSignal} signal */
  async check(signal) {
    const text = this.editor.area.value;
    fill(this.problem);
    try {
      placesIn(text);
    } catch (error) {
      if (!(error instanceof TextMistake)) throw error;
      this.editor.show([{ start: error.offset, end: error.offset + 1, text: error.message }]);
      return;
    }
    const scene = JSON.parse(text);
    try {
      await ask("simulate", { system: scene, t_end: 0.01, samples: 2, verify: false }, signal);
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      if (error.body.errors?.length) this.editor.show(remarksOf(error.body.errors, text));
      else fill(this.problem, problemNote(error));
      if (error.body.status === 422 && !error.body.reason) return;
    }
    this.editor.show([]);
    if (text === this.shown) return;
    this.shown = text;
    await this.showScene(scene, text);
  }

  /** @param {any} scene @param {string} text */
  async showScene(scene, text) {
    this.address.values.set("scene", await packed(text));
    fill(this.heading, scene.title ?? scene.name);
    document.title = `${scene.title ?? scene.name} · qdot`;
    const subject = new Subject(scene, this.address.values, true);
    if (this.page) {
      this.page.setSubject(subject);
      return;
    }
    const needs = [
      "simulate",
      "equations",
      "modes",
      "turning_points",
      "equilibria",
      "bifurcations",
      "accuracy",
      "energy",
      ...(scene.impact ? ["gait"] : []),
    ];
    this.page = new SystemPage(this.main, subject, ["scene"], needs, this.left);
    this.page.node
      .querySelector(".right")
      ?.prepend(
        element(
          "details",
          { class: "own-editor", open: true },
          element("summary", {}, "The scene"),
          this.chooser(),
          this.editor.node,
          this.problem,
        ),
      );
    this.page.section.before(this.page.tabs);
    this.box?.replaceWith(this.page.node);
    this.page.open(this.part);
    this.main.addEventListener(
      "address",
      (event) => {
        if (this.page?.turnTo(/** @type {CustomEvent} */ (event).detail)) event.preventDefault();
      },
      { signal: this.left },
    );
  }

  async open() {
    const letters = this.address.values.get("scene");
    let text = written(templates.Pendulum);
    if (letters) text = await unpacked(letters).catch(() => text);
    this.editor.set(text);
    this.box = element(
      "div",
      { class: "columns" },
      element("div", { class: "left" }),
      element("div", { class: "right" }, element("div", { class: "own-editor" }, this.chooser(), this.editor.node, this.problem)),
    );
    fill(
      this.main,
      element(
        "header",
        { class: "title" },
        this.heading,
        element("p", {}, "Say where things are; the rest follows. The address of this page carries the scene."),
      ),
      this.box,
    );
    this.latest.wish();
    this.editor.schema = await read("/v1/scene-schema");
  }
}

/** @param {HTMLElement} main @param {import("./link.js").Address} address @param {string | undefined} part @param {AbortSignal} left */
export async function showOwnScene(main, address, part, left) {
  document.title = "Your own scene · qdot";
  await new OwnScene(main, address, part, left).open();
}
