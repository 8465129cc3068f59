// Shows /openapi.json: each address once, with its fields, its answer, and forms that send a request.
import { quoted, read } from "./api.js";
import { copyButton, element, fill } from "./dom.js";
import { field, fieldList, membersOf, resolved, rich } from "./schema_text.js";

/** @typedef {Record<string, any>} Operation */
/** @typedef {{ target: string, method: string, body?: string, type?: string }} Request */

/** What stands in the place of a name in an address, to begin with. @type {Record<string, string>} */
const captures = {
  "/v1/systems/{name}": "cart_pendulum",
  "/v1/systems/{name}/scene": "cart_pendulum",
  "/v1/problems/{number}": "8",
  "/errors/{name}": "invalid-request",
  "/page/{file}": "style.css",
};

/** @param {Request} request */
function curlOf({ target, method, body, type }) {
  // Line ends stay only with --data-binary.
  const data = type ? ` -H ${quoted(`Content-Type: ${type}`)} --data-binary` : " -d";
  return `curl ${quoted(location.origin + target)}${method === "POST" ? `${data} ${quoted(body ?? "")}` : ""}`;
}

/** A body as the query of the GET twin, where it has one: names flat, lists with commas. @param {any} body */
function queryOf(body) {
  const entries = Object.entries(body).flatMap(([name, value]) =>
    value !== null && typeof value === "object" && !Array.isArray(value) ? Object.entries(value) : [[name, value]],
  );
  if (
    entries.some(
      ([, value]) =>
        (typeof value === "object" && !Array.isArray(value)) ||
        (Array.isArray(value) && value.some((one) => typeof one === "object")),
    )
  )
    return null;
  return entries.map(([name, value]) => `${name}=${value}`).join("&");
}

/** Spaces and signs as an address has them; = and & stay what they are. @param {string} query */
function encoded(query) {
  return query
    .split("&")
    .map((part) => {
      const [name, ...value] = part.split("=");
      return [name, ...(value.length ? [value.join("=")] : [])]
        .map((text) => encodeURIComponent(text).replaceAll("%2C", ",").replaceAll("%2F", "/"))
        .join("=");
    })
    .join("&");
}

/** @param {Request} request @param {HTMLElement} output */
async function send(request, output) {
  fill(output, element("p", {}, "Waiting …"));
  let [status, text] = ["No answer", ""];
  try {
    const headers = request.body === undefined ? undefined : { "Content-Type": request.type ?? "application/json" };
    const response = await fetch(request.target, { method: request.method, headers, body: request.body });
    const type = response.headers.get("Content-Type") ?? "";
    status = `${response.status} ${type}`;
    text = await response.text();
    if (/[/+]json$/.test(type)) text = JSON.stringify(JSON.parse(text), null, 2);
  } catch (error) {
    text = String(error);
  }
  const longest = 100000;
  if (text.length > longest) text = `${text.slice(0, longest)}\n… (shortened here)`;
  const line = curlOf(request);
  fill(
    output,
    element("p", { class: "status" }, status),
    element("pre", { tabindex: "0", class: "answer" }, text),
    element(
      "p",
      {},
      "The same in a shell ",
      copyButton("copy", () => line),
    ),
    element("pre", { tabindex: "0", class: "shell" }, line),
  );
}

/** @param {(HTMLElement | string)[]} parts @param {() => Request} request @param {string} label */
function form(parts, request, label) {
  const output = element("div", { "aria-live": "polite" });
  return element(
    "form",
    {
      onsubmit: (event) => {
        event.preventDefault();
        send(request(), output);
      },
    },
    ...parts,
    element("p", {}, element("button", {}, label)),
    output,
  );
}

/** @param {string} label @param {HTMLElement} control */
const labelled = (label, control) => element("label", { class: "stacked" }, label, control);

/** Lines of a batch: some of the questions that the document has examples of. @param {any} api @param {string} path @param {string} type */
function linesForm(api, path, type) {
  const lines = ["modes", "turning_points", "energy"].flatMap((name, id) => {
    const { examples = {} } = api.paths[`/v1/${name}`]?.post?.requestBody.content["application/json"] ?? {};
    const example = /** @type {any} */ (Object.values(examples)[0])?.value;
    return example ? [JSON.stringify({ id: id + 1, [name]: example })] : [];
  });
  const text = element("textarea", { class: "code-box", spellcheck: "false", rows: "5" });
  text.value = lines.join("\n");
  const request = () => ({ target: path, method: "POST", body: `${text.value.trim()}\n`, type });
  return form([labelled("Lines", text)], request, "Send as POST");
}

/** @param {any} api @param {string} path @param {Operation} operation */
function bodyForm(api, path, operation) {
  const content = operation.requestBody.content["application/json"];
  if (!content) return linesForm(api, path, Object.keys(operation.requestBody.content)[0]);
  const examples = /** @type {{ summary: string, value: any }[]} */ (Object.values(content.examples ?? {}));
  const text = element("textarea", { class: "code-box", spellcheck: "false", rows: "8" });
  const show = (/** @type {number} */ i) => {
    text.value = JSON.stringify(examples[i]?.value ?? {}, null, 2);
  };
  const select = element(
    "select",
    { onchange: () => show(select.selectedIndex) },
    ...examples.map((example) => element("option", {}, example.summary)),
  );
  show(0);
  return form(
    [examples.length > 1 ? labelled("Example", select) : "", labelled("Body", text)],
    () => ({ target: path, method: "POST", body: text.value }),
    "Send as POST",
  );
}

/** @param {any} api @param {string} path @param {Operation} operation @param {string} query */
function queryForm(api, path, operation, query) {
  const parameters = (operation.parameters ?? []).map((/** @type {any} */ one) => resolved(api, one));
  const capture = parameters.find((/** @type {any} */ one) => one.in === "path");
  const parts = [];
  const name = element("input", { class: "value wide-field", required: true, value: captures[path] ?? "", autocomplete: "off" });
  if (capture) parts.push(labelled(capture.description, name));
  const field = element("input", { class: "value wide-field", value: query, spellcheck: "false", autocomplete: "off" });
  const hasQuery = parameters.some((/** @type {any} */ one) => one.in === "query" && one.name !== "pretty");
  if (hasQuery) parts.push(labelled("Query", field));
  const target = () => {
    const place = capture ? path.replace(`{${capture.name}}`, encodeURIComponent(name.value)) : path;
    return hasQuery && field.value.trim() ? `${place}?${encoded(field.value.trim())}` : place;
  };
  return form(parts, () => ({ target: target(), method: "GET" }), "Send as GET");
}

/** @param {any} api @param {string} path @param {Record<string, Operation>} methods */
function details(api, path, { get, post }) {
  const content = /** @type {any} */ (Object.values(post?.requestBody?.content ?? {})[0]);
  const example = /** @type {any} */ (Object.values(content?.examples ?? {})[0])?.value;
  const query = example ? queryOf(example) : "";
  const operation = post ?? get;
  const answers = operation.responses["200"].content ?? {};
  const json = answers["application/json"] ?? answers["application/x-ndjson"];
  const parameters = (get?.parameters ?? []).map((/** @type {any} */ one) => resolved(api, one));
  const asked = content
    ? membersOf(api, content.schema.contentSchema ?? content.schema)
    : parameters.length
      ? [
          fieldList(
            "Parameters",
            parameters.flatMap((/** @type {any} */ one) =>
              field(api, one.name, { description: one.description, ...one.schema }, one.required),
            ),
          ),
        ]
      : [];
  return [
    element("p", {}, ...rich(operation.description)),
    ...(post ? [bodyForm(api, path, post)] : []),
    ...(get && query !== null ? [queryForm(api, path, get, query)] : []),
    asked.length ? element("h3", {}, "Request") : "",
    ...asked,
    element("h3", {}, "Answer"),
    ...(json ? membersOf(api, json.schema.contentSchema ?? json.schema) : []),
    element("ul", { class: "statuses" }, ...statuses(api, operation)),
  ];
}

/** @param {any} api @param {Operation} operation */
function statuses(api, operation) {
  return Object.entries(operation.responses).map(([status, response]) => {
    const whole = resolved(api, /** @type {any} */ (response));
    const types = Object.keys(whole.content ?? {}).join(", ");
    return element(
      "li",
      {},
      element("strong", {}, status),
      ` ${whole.description}`,
      types ? element("span", { class: "quiet-words" }, ` ${types}`) : "",
    );
  });
}

/** @param {any} api @param {string} path @param {Record<string, Operation>} methods */
function entry(api, path, methods) {
  const operation = methods.post ?? methods.get;
  const names = ["get", "post"]
    .filter((method) => method in methods)
    .map((method) => method.toUpperCase())
    .join(", ");
  const view = element(
    "details",
    { class: "address", id: (methods.get ?? operation).operationId },
    element(
      "summary",
      {},
      element("code", {}, path),
      element("span", { class: "summary" }, operation.summary),
      element("span", { class: "method" }, names),
    ),
  );
  // Filled when it is first opened: there are thousands of fields in all.
  view.addEventListener("toggle", () => {
    if (view.open && view.childElementCount === 1)
      view.append(element("div", { class: "inside" }, ...details(api, path, methods).filter((one) => one !== "")));
  });
  return view;
}

/** @param {any} api */
function show(api) {
  const main = /** @type {HTMLElement} */ (document.getElementById("operations"));
  /** @type {Record<string, Operation>[]} */
  const all = Object.values(api.paths);
  const tagOf = (/** @type {Record<string, Operation>} */ methods) => (methods.get ?? methods.post).tags[0];
  // What is for people comes first, what is for those who run the service last.
  const tags = [...api.tags].sort((a, b) => Number(a.name === "operations") - Number(b.name === "operations"));
  fill(
    main,
    ...tags.flatMap((tag) => [
      element("h2", {}, tag.name),
      element("p", {}, ...rich(tag.description)),
      ...Object.entries(api.paths)
        .filter((_, i) => tagOf(all[i]) === tag.name)
        .map(([path, methods]) => entry(api, path, /** @type {any} */ (methods))),
    ]),
  );
  fill(
    /** @type {HTMLElement} */ (document.getElementById("about")),
    `${api.info.summary} Version ${api.info.version}. ${api.info.description} `,
    element("a", { href: "/openapi.json" }, "OpenAPI 3.1"),
  );
  const wanted = location.hash ? document.getElementById(location.hash.slice(1)) : null;
  if (wanted instanceof HTMLDetailsElement) {
    wanted.open = true;
    wanted.scrollIntoView();
  }
}

read("/openapi.json")
  .then(show)
  .catch((error) => {
    fill(/** @type {HTMLElement} */ (document.getElementById("about")), `/openapi.json cannot be read: ${error}`);
  });
