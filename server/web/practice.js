// The practice sheet: each part's question, its answer with the line that gives it, and what the sheet prints.
import { ask, read } from "./api.js";
import { element, fill, mathematics, table } from "./dom.js";
import { Figure } from "./figure.js";
import { foot } from "./foot.js";
import { closedForm } from "./formula.js";
import { Motion } from "./motion.js";
import { prose, quantity, short } from "./numbers.js";
import { Stage } from "./stage.js";

/** "/equations_of_motion/0/equation" as "equation of motion 1". @param {string} pointer */
function title(pointer) {
  const words = pointer
    .slice(1)
    .split("/")
    .filter((word, i) => i === 0 || word !== "equation");
  return words
    .map((word) => (/^\d+$/.test(word) ? String(Number(word) + 1) : word))
    .join(" ")
    .replace("equations_of_motion", "equation of motion")
    .replace("modes", "mode")
    .replaceAll("_", " ");
}

/** @param {any} root @param {string} pointer */
const at = (root, pointer) =>
  pointer
    .slice(1)
    .split("/")
    .reduce((place, key) => place?.[key], root);

/** @param {string} name @param {Node | string} shown */
function row(name, shown) {
  return element("tr", {}, element("th", { scope: "row" }, prose(name)), element("td", {}, shown));
}

/** A number, an expression or a list as rows of a table; what an object says of its errors is with its numbers. @param {string} name @param {any} value @param {any} typeset the same as mathematics @param {string} [unit] @returns {HTMLElement[]} */
function rows(name, value, typeset, unit = "") {
  if (value === null || value === undefined) return [];
  if (typeof value === "number") return [row(name, quantity(value, { unit, digits: 12 }))];
  if (typeof value === "string")
    return [
      row(
        name,
        typeof typeset === "string" && typeset.startsWith("<math")
          ? mathematics(typeset)
          : (value.includes(" ") && !/[=*^]/.test(value)) || /^[a-z]+$/.test(value)
            ? value
            : element("code", {}, value),
      ),
    ];
  if (Array.isArray(value) && value.length && value.every((one) => typeof one === "string"))
    return [row(name, prose(value.join(", ")))];
  if (
    Array.isArray(value) &&
    value.length &&
    value.every((one) => one !== null && typeof one === "object" && "from_included" in one)
  )
    return [row(name, value.map((one) => `${short(one.from, 8)} to ${short(one.to, 8)}`).join("; "))];
  if (typeof value === "boolean") return [row(name, value ? "yes" : "no")];
  if (typeof value.text === "string" && typeof value.latex === "string")
    return [row(name, closedForm(value)), ...(value.assumes?.length ? rows(`${name} for`, value.assumes, null) : [])];
  return Object.entries(value)
    .filter(([key]) => !/error$/.test(key))
    .flatMap(([key, one]) => {
      const word = /^\d+$/.test(key) ? String(Number(key) + 1) : key.replaceAll("_", " ");
      return rows(`${name} ${word}`, one, typeset?.[key]);
    });
}

/** @param {any} part @param {any} typeset the same answer as mathematics, of equations */
function result(part, typeset) {
  const units = part.answer?.units ?? {};
  const found = Object.entries(part.result ?? {});
  const isOnly = found.filter(([pointer]) => pointer.startsWith("/equations_of_motion/")).length === 1;
  const all = found.flatMap(([pointer, value]) =>
    rows(isOnly ? title(pointer).replace(/^equation of motion 1$/, "equation of motion") : title(pointer), value, at(typeset, pointer), units[pointer.split("/").pop() ?? ""]),
  );
  return all.length ? table({ class: "answers" }, ...all) : "";
}

/** What the sheet says, beside what is derived. @param {any} sheet */
function sheetNote(sheet) {
  if (!sheet) return "";
  const verdict = sheet.agrees === true ? "The sheet agrees." : sheet.agrees === false ? "The sheet has a misprint." : "";
  return element(
    "aside",
    { class: sheet.agrees === false ? "sheet differs" : "sheet" },
    element("p", {}, element("strong", {}, `On the sheet, ${sheet.place}${/[.]$/.test(sheet.place) ? "" : "."} `), verdict),
    sheet.result ? element("p", {}, element("code", {}, sheet.result)) : "",
    sheet.reason ? element("p", {}, prose(sheet.reason)) : "",
    sheet.erratum ? element("p", {}, prose(sheet.erratum)) : "",
  );
}

const viewOf = /** @type {Record<string, string>} */ ({
  simulate: "motion",
  turning_points: "turning",
  equations: "equations",
  modes: "modes",
  equilibria: "equilibria",
  bifurcations: "bifurcations",
  gait: "gait",
  accuracy: "accuracy",
});

/** @param {any} part */
async function partView(part) {
  const { body, path } = part.request;
  const endpoint = path.split("/").pop() ?? "";
  const name = typeof body.system === "string" ? body.system : "";
  const values = new URLSearchParams(
    Object.entries({ ...body.parameters, ...body.initial }).map(([key, value]) => [key, String(value)]),
  );
  const query = values.toString();
  const typeset = endpoint === "equations" ? await ask("equations", { ...body, form: "mathml" }) : null;
  return element(
    "section",
    { class: "part" },
    part.part ? element("h2", {}, `Part ${part.part}`) : "",
    element("p", { class: "question" }, prose(part.question)),
    result(part, typeset),
    sheetNote(part.sheet),
    name
      ? element(
          "p",
          {},
          element(
            "a",
            { href: `#/systems/${name}/${viewOf[endpoint] ?? "motion"}${query ? "?" + query : ""}` },
            "Open it, and change the numbers",
          ),
        )
      : "",
    foot({ endpoint, body }),
  );
}

/** The drawing of a problem, moving. @param {string} name @param {AbortSignal} left */
async function drawing(name, left) {
  const scene = await read(`/v1/systems/${name}/scene`);
  const answer = await ask("simulate", { system: name, t_end: 8, samples: 481 }, left);
  const stage = new Stage();
  const figure = new Figure(scene, answer.request.parameters, answer.request.inputs);
  left.addEventListener("abort", () => stage.clock.pause());
  return {
    stage,
    start: () => {
      stage.setFigure(figure);
      stage.canvas.setAttribute("aria-label", `${scene.title}, moving`);
      stage.setMotion(new Motion(answer, figure.coordinates), answer.stop?.message ?? "");
    },
  };
}

/** @param {HTMLElement} main @param {number} number @param {AbortSignal} left */
export async function showProblem(main, number, left) {
  const [{ problems }, problem] = await Promise.all([read("/v1/problems"), read(`/v1/problems/${number}`)]);
  const parts = await Promise.all(problem.parts.map(partView));
  if (left.aborted) return;
  document.title = `Problem ${number} · qdot`;
  const box = element("div", {});
  fill(
    main,
    element(
      "nav",
      { class: "views numbers-nav", "aria-label": "Problems" },
      ...problems.map((/** @type {any} */ one) =>
        element(
          "a",
          {
            href: `#/problems/${one.number}`,
            title: one.title,
            "aria-label": `Problem ${one.number}: ${one.title}`,
            "aria-current": one.number === number ? "page" : null,
          },
          one.number,
        ),
      ),
    ),
    element("header", { class: "title" }, element("h1", {}, `${number}. ${problem.title}`)),
    element("div", { class: "columns" }, element("div", { class: "left" }, box), element("div", { class: "right" }, ...parts)),
  );
  const name = problem.parts
    .map((/** @type {any} */ part) => part.request.body.system)
    .find((/** @type {any} */ one) => typeof one === "string");
  if (!name) return;
  const { stage, start } = await drawing(name, left);
  fill(box, stage.node);
  start();
}
