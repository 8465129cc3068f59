// What stands under every view: the lines that ask the same elsewhere.
import { copyButton, element } from "./dom.js";
import { curlLine, pythonLines } from "./api.js";

/** @typedef {{ endpoint: string, body: Record<string, any> }} Question */

/** @param {Question} question */
export function foot({ endpoint, body }) {
  const line = curlLine(endpoint, body);
  return element(
    "footer",
    { class: "foot" },
    element("p", {}, "The same numbers in a shell"),
    element("pre", { class: "curl", tabindex: "0", "data-endpoint": endpoint }, line),
    element(
      "p",
      { class: "copies" },
      "Copy as ",
      copyButton("curl", () => line),
      copyButton("Python", () => pythonLines(endpoint, body)),
      copyButton("link", () => location.href),
    ),
  );
}

/** What the service wants known of its answer, such as an angle that may have been meant in degrees. @param {any} answer */
export function notes(answer) {
  const said = Array.isArray(answer.notes) ? answer.notes.map(String) : [];
  return said.map((/** @type {string} */ text) => element("p", { class: "note" }, text));
}

/** @param {unknown} error a problem of the service, in its words */
export function problemNote(error) {
  const body = /** @type {any} */ (error)?.body;
  if (!body) return element("p", { class: "problem", role: "alert" }, String(/** @type {any} */ (error)?.message ?? error));
  return element(
    "div",
    { class: "problem", role: "alert" },
    element("p", {}, body.errors?.length ? body.title + "." : body.detail || body.title),
    body.errors?.length
      ? element(
          "ul",
          {},
          ...body.errors.map((/** @type {import("./api.js").FieldError} */ one) =>
            element(
              "li",
              {},
              (one.pointer ?? one.parameter) ? element("code", {}, one.pointer ?? one.parameter) : "",
              " ",
              one.detail,
            ),
          ),
        )
      : "",
  );
}
