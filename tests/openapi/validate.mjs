// Do recorded exchanges fit the document? node validate.mjs openapi.json exchanges.ndjson ...
//
// Each line of a recording is one exchange: {method, target, request, status, type, answer}. Of the answers every member
// has to be in the document: its objects are closed here, though clients must expect new members. A request that was
// answered has to fit the document, and one that was refused for its form alone must not.
// Prints one line a mistake and, last, the number of answers that were validated.

import { createReadStream, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { createInterface } from "node:readline";

const require = createRequire(process.env.QDOT_NODE_MODULES + "/");
const Ajv = require("ajv/dist/2020").default;

const shownMistakes = 20;
// What a table says of one field alone; other refusals need the system or several fields.
const formCodes = new Set(["unknown_field", "wrong_type", "not_allowed", "exclusive"]);

/** Closes each object that lists its members. `branch`: part of a schema that says more of the same object. */
function close(schema, branch = false) {
  if (schema === null || typeof schema !== "object") return schema;
  if (Array.isArray(schema)) return schema.map((part) => close(part));
  const result = { ...schema };
  for (const key of ["properties", "patternProperties"]) {
    if (schema[key]) result[key] = Object.fromEntries(Object.entries(schema[key]).map(([name, s]) => [name, close(s)]));
  }
  for (const key of ["items", "additionalProperties"]) if (schema[key]) result[key] = close(schema[key]);
  for (const key of ["oneOf", "anyOf", "allOf"]) if (schema[key]) result[key] = schema[key].map((s) => close(s, true));
  const closable = schema.properties && !branch && schema.additionalProperties === undefined;
  return closable ? { ...result, unevaluatedProperties: false } : result;
}

const document_ = JSON.parse(readFileSync(process.argv[2], "utf8"));
const schemas = document_.components.schemas;
for (const name of Object.keys(schemas)) if (name !== "Scene") schemas[name] = close(schemas[name]);
delete schemas.SystemName.enum;  // some of the recorded servers had more systems

const ajv = new Ajv({ strict: true, strictTypes: false, strictRequired: false, strictTuples: false,
  allowMatchingProperties: true, validateFormats: false });
// Its own keywords, and the members of the document, which is a schema to Ajv.
ajv.addVocabulary(["discriminator", "x-unit", "x-unit-of", "x-aliases", ...Object.keys(document_)]);
ajv.addSchema(document_, "document");
const compiled = new Map();

/** Why `value` does not fit the schema at a place of the document; empty when it does. */
function misfit(place, value) {
  const pointer = "document#/" + place.map((part) => encodeURIComponent(part.replaceAll("~", "~0").replaceAll("/", "~1"))).join("/");
  if (!compiled.has(pointer)) compiled.set(pointer, ajv.compile({ $ref: pointer }));
  const validate = compiled.get(pointer);
  return validate(value) ? "" : ajv.errorsText(validate.errors.slice(0, 3));
}

const templates = Object.keys(document_.paths).map((path) => ({
  path, pattern: new RegExp("^" + path.replaceAll(".", "\\.").replace(/\{\w+\}/g, "[^/]+") + "$") }));

function problemMisfit({ status, type, answer }) {
  if (status < 400) return `${status} is not in the document`;
  if (status === 404 && type === "text/html") return "";  // to a browser
  if (type !== "application/problem+json") return `a problem of type ${type}`;
  return misfit(["components", "schemas", "Problem"], JSON.parse(answer));
}

function answerMisfit(exchange, path) {
  const { method, status, type, answer } = exchange;
  const operation = path && document_.paths[path][(method === "HEAD" ? "GET" : method).toLowerCase()];
  if (status === 204 && method === "OPTIONS") return "";
  if (!operation || method === "HEAD") return method === "HEAD" && status < 400 ? "" : problemMisfit({ ...exchange, ...(method === "HEAD" && { answer: "{}" }) });
  const declared = operation.responses[status];
  if (!declared) return `status ${status} is not in the document`;
  const place = declared.$ref ? declared.$ref.slice(2).split("/") : ["paths", path, method.toLowerCase(), "responses", String(status)];
  const response = place.reduce((at, key) => at[key], document_);
  if (!response.content) return answer ? `a body with status ${status}` : "";
  if (!response.content[type]) {
    // Another form of an answer is described at its own address.
    const own = { "text/csv": ".csv", "application/x-ndjson": ".ndjson" }[type];
    return own && document_.paths[path + own] ? "" : `${type} is not in the document`;
  }
  const value = /[/+]json$/.test(type) ? JSON.parse(answer) : answer;
  return misfit([...place, "content", type, "schema"], value);
}

function parsed(text) {
  try { return JSON.parse(text); } catch { return undefined; }
}

function requestMisfit({ method, request, status, answer }, path) {
  const operation = path && document_.paths[path][method.toLowerCase()];
  const body = method === "POST" && operation && parsed(request);
  if (!body) return "";
  const place = ["paths", path, "post", "requestBody", "content", "application/json", "schema"];
  if (!operation.requestBody.content["application/json"]) return "";  // lines
  const why = misfit(place, body);
  const fields = schemas[place.reduce((at, key) => at[key], document_).$ref.split("/").pop()].properties;
  if (status === 200) return why && `answered, but it does not fit: ${why}`;
  const errors = status === 422 ? JSON.parse(answer).errors || [] : [];
  const isForm = (name, code) => formCodes.has(code) && (code !== "unknown_field" || !(name in fields));
  const refused = errors.find(({ pointer, code }) => /^#\/\w+$/.test(pointer) && isForm(pointer.slice(2), code));
  return refused && !why ? `refused for ${refused.pointer} (${refused.code}), but it fits` : "";
}

let answers = 0;
let mistakes = 0;
for (const file of process.argv.slice(3)) {
  for await (const line of createInterface({ input: createReadStream(file), crlfDelay: Infinity })) {
    const exchange = JSON.parse(line);
    const path = (templates.find(({ pattern }) => pattern.test(exchange.target.split(/[?#]/)[0])) || {}).path;
    ++answers;
    for (const why of [answerMisfit(exchange, path), requestMisfit(exchange, path)]) {
      if (why && ++mistakes <= shownMistakes) {
        console.log(`${exchange.method} ${exchange.target.slice(0, 150)} ${(exchange.request || "").slice(0, 200)}\n  -> ${exchange.status}: ${why}`);
      }
    }
  }
}
console.log(`${answers} answers validated, ${mistakes} mistakes`);
process.exitCode = mistakes ? 1 : 0;
