// A schema of /openapi.json in words and tables.
import { element } from "./dom.js";

/** @typedef {Record<string, any>} Schema */

/** What is between backticks is code. @param {string} text @returns {(Node | string)[]} */
export function rich(text) {
  return text.split("`").map((part, i) => (i % 2 ? element("code", {}, part) : part));
}

/** What a reference stands for, with what is said beside it. @param {Schema} api @param {Schema | undefined} thing @returns {Schema} */
export function resolved(api, thing) {
  if (!thing?.$ref) return thing ?? {};
  const target = thing.$ref
    .slice(2)
    .split("/")
    .reduce((/** @type {any} */ place, /** @type {string} */ key) => place?.[key], api);
  const { $ref, ...beside } = thing;
  return { ...resolved(api, target), ...beside };
}

/** @param {Schema} schema @returns {string} */
export function typeName(schema) {
  if (schema.$ref) return schema.$ref.split("/").pop() ?? "";
  if (schema.enum) return schema.enum.map((/** @type {any} */ word) => JSON.stringify(word)).join(" | ");
  if ("const" in schema) return JSON.stringify(schema.const);
  const ways = schema.anyOf ?? schema.oneOf;
  if (ways && !schema.properties) return ways.map(typeName).join(" or ");
  if (schema.type === "array") return `array of ${typeName(schema.items ?? {})}`;
  return [schema.type ?? "any"].flat().join(" or ");
}

/** "> 0 and ≤ 1" @param {Schema} schema */
function bounds(schema) {
  const number = [schema, ...(schema.anyOf ?? [])].find((way) => /imum/.test(Object.keys(way).join())) ?? {};
  const signs = [
    ["minimum", "≥"],
    ["exclusiveMinimum", ">"],
    ["maximum", "≤"],
    ["exclusiveMaximum", "<"],
  ];
  const parts = signs.filter(([key]) => key in number).map(([key, sign]) => `${sign} ${number[key]}`);
  if (schema.maxItems) parts.push(`at most ${schema.maxItems}`);
  return parts.join(" and ");
}

/** One field: its name and type on a line, what it means below. @param {Schema} api @param {string} name @param {Schema} schema @param {boolean} isRequired */
export function field(api, name, schema, isRequired) {
  const unit = schema["x-unit"] && schema["x-unit"] !== "1" ? schema["x-unit"] : "";
  const facts = [
    typeName(schema),
    unit,
    bounds(schema),
    "default" in schema ? `default ${JSON.stringify(schema.default)}` : "",
    isRequired ? "required" : "",
  ];
  const meaning = schema.description ?? resolved(api, schema).description ?? "";
  const aliases = schema["x-aliases"]
    ? ` Other programs call it ${schema["x-aliases"].join(", ")}; such a name is refused here, with the hint to write ${name}.`
    : "";
  return [
    element("dt", {}, element("code", {}, name), element("span", { class: "facts" }, facts.filter(Boolean).join(", "))),
    element("dd", {}, ...rich(meaning + aliases)),
  ];
}

/** @param {string} title @param {HTMLElement[]} fields */
export function fieldList(title, fields) {
  return element("div", {}, element("p", { class: "quiet-words" }, title), element("dl", { class: "fields" }, ...fields));
}

/** The members of an object, and those of its ways. @param {Schema} api @param {Schema | undefined} schema */
export function membersOf(api, schema) {
  const whole = resolved(api, schema);
  const parts = [
    [whole, whole.description ?? "Members"],
    ...(whole.oneOf ?? []).filter((/** @type {Schema} */ way) => way.title).map((/** @type {Schema} */ way) => [way, way.title]),
  ];
  return parts.flatMap(([part, title]) => {
    const required = new Set(part.required ?? []);
    const named = Object.entries(part.properties ?? {}).flatMap(([name, one]) =>
      field(api, name, /** @type {Schema} */ (one), required.has(name)),
    );
    const patterns = Object.entries(part.patternProperties ?? {}).flatMap(([pattern, one]) =>
      field(api, `/${pattern}/`, /** @type {Schema} */ (one), false),
    );
    return named.length + patterns.length ? [fieldList(title, [...named, ...patterns])] : [];
  });
}
