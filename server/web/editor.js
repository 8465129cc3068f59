// A text with line numbers: messages stand at their lines, and names of the schema are offered.
import { begunName, completions } from "./completion.js";
import { element, fill } from "./dom.js";
import { lineOf } from "./json_places.js";

/** @typedef {{ start: number, end: number, text: string, replacement?: string }} Remark */

export class Editor {
  /** @param {string} text @param {(text: string) => void} change */
  constructor(text, change) {
    this.change = change;
    /** @type {any} the schema of scenes, once it is there */
    this.schema = null;
    this.gutter = element("div", { class: "gutter", "aria-hidden": "true" });
    this.area = element("textarea", {
      class: "code",
      id: "scene-text",
      spellcheck: "false",
      autocomplete: "off",
      autocapitalize: "off",
      wrap: "off",
      rows: "22",
      "aria-describedby": "remarks",
      oninput: () => this.typed(),
      onscroll: () => {
        this.gutter.scrollTop = this.area.scrollTop;
      },
      onkeydown: (event) => this.key(event),
    });
    this.offers = element("ul", { class: "offers", role: "listbox", "aria-label": "Names that may come here", hidden: true });
    this.remarks = element("ol", { class: "remarks", id: "remarks", "aria-live": "polite" });
    this.node = element(
      "div",
      {},
      element(
        "label",
        { for: "scene-text", class: "quiet-words" },
        "The scene. Ctrl and space offer names; Escape, then Tab leaves.",
      ),
      element("div", { class: "editor" }, this.gutter, this.area),
      this.offers,
      this.remarks,
    );
    this.set(text);
  }

  /** @param {string} text */
  set(text) {
    this.area.value = text;
    this.number([]);
  }

  typed() {
    this.number([]);
    this.offers.hidden = true;
    this.change(this.area.value);
  }

  /** @param {number[]} wrong */
  number(wrong) {
    const count = Math.min(5000, this.area.value.split("\n").length);
    fill(
      this.gutter,
      ...Array.from({ length: count }, (_, i) => element("div", { class: wrong.includes(i + 1) ? "wrong" : null }, i + 1)),
    );
    this.gutter.scrollTop = this.area.scrollTop;
  }

  /** @param {Remark[]} remarks */
  show(remarks) {
    const text = this.area.value;
    const lines = remarks.map((remark) => lineOf(text, remark.start).line);
    this.number(lines);
    fill(
      this.remarks,
      ...remarks.map((remark, i) => {
        const { replacement } = remark;
        return element(
          "li",
          { class: "remark" },
          element("button", { type: "button", class: "quiet", onclick: () => this.goTo(remark) }, `line ${lines[i]}`),
          " ",
          remark.text,
          " ",
          replacement !== undefined &&
            element("button", { type: "button", onclick: () => this.replace(remark, replacement) }, `write ${replacement}`),
        );
      }),
    );
  }

  /** @param {Remark} remark */
  goTo({ start, end }) {
    this.area.focus();
    this.area.setSelectionRange(start, end);
    const line = lineOf(this.area.value, start).line;
    this.area.scrollTop = Math.max(0, (line - 6) * parseFloat(getComputedStyle(this.area).lineHeight));
  }

  /** @param {Remark} remark @param {string} replacement */
  replace({ start, end }, replacement) {
    this.area.focus();
    this.area.setRangeText(replacement, start, end, "end");
    this.typed();
  }

  /** Tab writes two spaces, unless Escape came before it: the keyboard must find its way out. @param {KeyboardEvent} event */
  key(event) {
    if (event.key === "Tab" && !event.shiftKey && !this.isLeaving) {
      event.preventDefault();
      this.insert("  ");
    } else if (event.key === " " && event.ctrlKey) {
      event.preventDefault();
      this.offer();
    } else if (event.key === "Escape") {
      this.offers.hidden = true;
      this.isLeaving = true;
      return;
    }
    if (event.key !== "Shift") this.isLeaving = false;
  }

  /** @param {string} text */
  insert(text) {
    this.area.setRangeText(text, this.area.selectionStart, this.area.selectionEnd, "end");
    this.typed();
  }

  offer() {
    if (!this.schema) return;
    const before = this.area.value.slice(0, this.area.selectionStart);
    const typed = begunName(before);
    const words = completions(this.schema, before).slice(0, 24);
    fill(
      this.offers,
      ...words.map(({ word, meaning }) =>
        element(
          "li",
          { role: "option" },
          element(
            "button",
            {
              type: "button",
              class: "quiet",
              title: meaning,
              onclick: () => {
                this.area.focus();
                this.insert(typed === undefined ? `"${word}": ` : `${word.slice(typed.length)}": `);
              },
            },
            word,
          ),
          element("span", { class: "meaning" }, meaning),
        ),
      ),
    );
    this.offers.hidden = words.length === 0;
    this.offers.querySelector("button")?.focus();
  }
}
