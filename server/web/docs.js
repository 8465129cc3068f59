"use strict";
// Shows /openapi.json: each address with its fields, its answer and a form that sends a request.

let api;

/** An element with attributes and children; texts become text, never markup. */
function element(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    else node.setAttribute(key, value);
  }
  node.append(...children);
  return node;
}

/** What a reference stands for, with what is said beside it. */
function resolved(thing) {
  if (!thing || !thing.$ref) return thing;
  const target = thing.$ref.slice(2).split("/").reduce((place, key) => place[key], api);
  const { $ref, ...beside } = thing;
  return { ...resolved(target), ...beside };
}

function typeName(schema) {
  if (schema.$ref) return schema.$ref.split("/").pop();
  if (schema.enum) return schema.enum.map((word) => JSON.stringify(word)).join(" | ");
  if ("const" in schema) return JSON.stringify(schema.const);
  const ways = schema.anyOf || schema.oneOf;
  if (ways && !schema.properties) return ways.map(typeName).join(" or ");
  if (schema.type === "array") return "array of " + typeName(schema.items || {});
  return [schema.type || "any"].flat().join(" or ");
}

/** "> 0 and <= 1" */
function bounds(schema) {
  const number = [schema, ...(schema.anyOf || [])].find((way) => /imum/.test(Object.keys(way).join())) || {};
  const parts = [];
  for (const [key, sign] of [["minimum", "≥"], ["exclusiveMinimum", ">"], ["maximum", "≤"], ["exclusiveMaximum", "<"]]) {
    if (key in number) parts.push(`${sign} ${number[key]}`);
  }
  if (schema.maxItems) parts.push(`at most ${schema.maxItems}`);
  return parts.join(" and ");
}

function fieldRow(name, schema, required) {
  const aliases = schema["x-aliases"];
  return element("tr", {},
    element("th", { scope: "row" }, element("code", {}, name), required ? " (required)" : ""),
    element("td", {}, typeName(schema), schema["x-unit"] && schema["x-unit"] !== "1" ? `, ${schema["x-unit"]}` : ""),
    element("td", {}, bounds(schema)),
    element("td", {}, "default" in schema ? element("code", {}, JSON.stringify(schema.default)) : ""),
    element("td", {}, schema.description || resolved(schema).description || "",
      aliases ? element("span", { class: "about" }, ` Other programs call it ${aliases.join(", ")}; such a name is refused here, with the hint to write ${name}.`) : ""));
}

function fieldTable(caption, rows) {
  const heads = ["Name", "Type", "Bounds", "Default", "Meaning"].map((text) => element("th", { scope: "col" }, text));
  return element("table", {}, element("caption", {}, caption),
    element("thead", {}, element("tr", {}, ...heads)), element("tbody", {}, ...rows));
}

function membersOf(schema) {
  const whole = resolved(schema) || {};
  const tables = [];
  const add = (part, title) => {
    const required = new Set(part.required || []);
    const rows = Object.entries(part.properties || {}).map(([name, s]) => fieldRow(name, s, required.has(name)));
    for (const [pattern, s] of Object.entries(part.patternProperties || {})) rows.push(fieldRow(`/${pattern}/`, s, false));
    if (rows.length) tables.push(fieldTable(title, rows));
  };
  add(whole, whole.description || "Members");
  for (const way of whole.oneOf || []) if (way.title) add(way, way.title);
  return tables;
}

/** The request of a form: path, method and body. */
function requestOf(path, method, inputs) {
  let target = path;
  for (const [name, input] of inputs.captures) target = target.replace(`{${name}}`, encodeURIComponent(input.value));
  const query = inputs.query ? inputs.query.value.trim() : "";
  if (query) target += "?" + query;
  return { target, method: method.toUpperCase(), body: inputs.body ? inputs.body.value : undefined };
}

function curlOf({ target, method, body }) {
  const quoted = (text) => `'${text.replaceAll("'", "'\\''")}'`;
  const data = body === undefined ? "" : ` -d ${quoted(body)}`;
  return `curl${method === "POST" ? data : ""} ${quoted(location.origin + target)}`;
}

async function send(request, output) {
  output.replaceChildren(element("p", {}, "Waiting …"));
  const headers = {};
  if (request.body !== undefined) headers["Content-Type"] = "application/json";
  let status, text;
  try {
    const response = await fetch(request.target, { method: request.method, headers, body: request.body });
    status = `${response.status} ${response.headers.get("Content-Type") || ""}`;
    text = await response.text();
    if (/json$/.test(response.headers.get("Content-Type"))) text = JSON.stringify(JSON.parse(text), null, 2);
  } catch (error) {
    status = "No answer";
    text = String(error);
  }
  const longest = 100000;
  if (text.length > longest) text = text.slice(0, longest) + "\n… (shortened here)";
  output.replaceChildren(element("p", {}, element("strong", {}, status)), element("pre", { tabindex: "0" }, text),
    element("p", {}, "The same in a shell:"), element("pre", { tabindex: "0" }, curlOf(request)));
}

/** A labelled control, appended to the form. */
function control(form, label, node) {
  form.append(element("label", {}, label, element("br"), node));
  return node;
}

function tryIt(path, method, operation) {
  const form = element("form");
  const output = element("div", { "aria-live": "polite" });
  const inputs = { captures: [] };
  for (const parameter of (operation.parameters || []).map(resolved)) {
    if (parameter.in === "path") inputs.captures.push([parameter.name, control(form, parameter.description, element("input", { required: "" }))]);
  }
  const content = operation.requestBody && operation.requestBody.content["application/json"];
  if (content) {
    const examples = Object.values(content.examples || {});
    const show = (example) => { inputs.body.value = JSON.stringify(example.value, null, 2); };
    const select = control(form, "Example", element("select", { onchange: () => show(examples[select.selectedIndex]) },
      ...examples.map((example) => element("option", {}, example.summary))));
    inputs.body = control(form, "Request", element("textarea", { spellcheck: "false", rows: "8" }));
    if (examples.length) show(examples[0]);
  } else if ((operation.parameters || []).length > 1) {
    inputs.query = control(form, "Query, such as system=name&t_end=2", element("input", { size: "60", spellcheck: "false" }));
  }
  form.append(element("p", {}, element("button", {}, "Send")), output);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    send(requestOf(path, method, inputs), output);
  });
  return form;
}

function questionOf(operation) {
  const body = operation.requestBody;
  if (body) return membersOf(body.content["application/json"].schema);
  const rows = (operation.parameters || []).map(resolved).map((p) =>
    fieldRow(p.name, { description: p.description, ...p.schema }, p.required));
  return rows.length ? [fieldTable("Parameters", rows)] : [];
}

function answersOf(operation) {
  return Object.entries(operation.responses).map(([status, response]) => {
    const whole = resolved(response);
    const types = Object.keys(whole.content || {}).join(", ");
    return element("li", {}, element("strong", {}, status), ` ${whole.description}`, types ? ` (${types})` : "");
  });
}

function operationView(path, method, operation) {
  const view = element("details", { id: operation.operationId },
    element("summary", {}, element("span", { class: "method" }, method.toUpperCase()), element("code", {}, path), ` ${operation.summary}`));
  // Filled when it is first opened: there are thousands of rows in all.
  view.addEventListener("toggle", () => {
    if (view.childElementCount > 1) return;
    const json = (operation.responses["200"].content || {})["application/json"];
    view.append(element("p", {}, operation.description),
      element("h4", {}, "Try it"), tryIt(path, method, operation),
      element("h4", {}, "Request"), ...questionOf(operation),
      element("h4", {}, "Answer"), ...(json ? membersOf(json.schema) : []), element("ul", {}, ...answersOf(operation)));
  });
  return view;
}

function show() {
  document.getElementById("about").replaceChildren(
    `${api.info.summary} Version ${api.info.version}. ${api.info.description} `,
    element("a", { href: "/openapi.json" }, "OpenAPI 3.1"));
  const main = document.getElementById("operations");
  for (const tag of api.tags) {
    main.append(element("h2", {}, tag.name), element("p", {}, tag.description));
    for (const [path, methods] of Object.entries(api.paths)) {
      for (const [method, operation] of Object.entries(methods).reverse()) {
        if (operation.tags.includes(tag.name)) main.append(operationView(path, method, operation));
      }
    }
  }
  const wanted = location.hash && document.getElementById(location.hash.slice(1));
  if (wanted) { wanted.open = true; wanted.scrollIntoView(); }
}

fetch("/openapi.json").then((response) => response.json()).then((document_) => { api = document_; show(); })
  .catch((error) => { document.getElementById("about").textContent = `/openapi.json cannot be read: ${error}`; });
