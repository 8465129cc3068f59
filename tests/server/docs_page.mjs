// Runs docs.js without a browser: opens every operation of /docs and sends its form as it stands.
//     node docs_page.mjs http://127.0.0.1:8080
// Prints one JSON line a form: what the page says of it.
import { setTimeout } from "node:timers/promises";
import vm from "node:vm";

const origin = process.argv[2];

class Element {
  constructor(name) { Object.assign(this, { name, attributes: {}, children: [], listeners: {}, value: "", selectedIndex: 0 }); }
  setAttribute(key, value) { this.attributes[key] = String(value); }
  append(...children) { this.children.push(...children); }
  replaceChildren(...children) { this.children = children; }
  addEventListener(event, listener) { this.listeners[event] = listener; }
  get childElementCount() { return this.children.filter((child) => child instanceof Element).length; }
  get text() { return this.children.map((child) => child.text ?? String(child)).join(""); }
  all(name) { return this.children.flatMap((child) => (child instanceof Element ? [...(child.name === name ? [child] : []), ...child.all(name)] : [])); }
}

const byId = { about: new Element("p"), operations: new Element("main") };
const context = {
  document: { createElement: (name) => new Element(name), getElementById: (id) => byId[id] },
  location: { origin, hash: "" },
  fetch: (target, options) => fetch(new URL(target, origin), options),
};

async function until(done) {
  const deadline = Date.now() + 60000;
  while (!done()) {
    if (Date.now() > deadline) throw new Error("The page waits for something that does not come.");
    await setTimeout(2);
  }
}

// What a reader would write where the form begins empty.
const captures = { "/v1/systems/{name}": "cart_pendulum", "/v1/problems/{number}": "8", "/errors/{name}": "deadline" };
const queries = {
  getGait: "system=compass_walker",
  getBifurcations: "system=whirling_pendulum&parameter=Omega&from=0&to=10",
  getSimulate: "system=cart_pendulum&t_end=1",
  getAccuracy: "system=cart_pendulum&t_end=1",
  getTurningPoints: "system=orbiting_pendulum",
};

async function send(view) {
  view.listeners.toggle();
  const path = view.all("code")[0].text;
  const { id } = view.attributes;
  for (const input of view.all("form")[0].all("input")) {
    if ("required" in input.attributes) input.value = captures[path];
    else if (/^get[A-Z]/.test(id)) input.value = queries[id] ?? "system=cart_pendulum";
  }
  view.all("form")[0].listeners.submit({ preventDefault() {} });
  await until(() => view.all("pre").length > 0);
  const [status] = view.all("strong").map((element) => element.text);
  console.log(JSON.stringify({ operation: id, status, shell: view.all("pre").at(-1).text }));
}

vm.runInNewContext(await (await fetch(`${origin}/docs/docs.js`)).text(), context);
await until(() => byId.operations.children.length > 0);
console.log(JSON.stringify({ about: byId.about.text }));
for (const view of byId.operations.all("details")) await send(view);
