// Elements of the page. Texts become text, never markup: a scene may name its things as it likes.

/** @typedef {Node | string | number | null | undefined | false} Child */
/** @typedef {Record<string, string | number | boolean | null | undefined | ((event: any) => void)>} Attributes */

/** @param {Element} node @param {Attributes} attributes */
function setAttributes(node, attributes) {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") node.addEventListener(key.slice(2), value);
    else node.setAttribute(key, value === true ? "" : String(value));
  }
}

/** @param {Child[]} children @returns {(Node | string)[]} */
function present(children) {
  return children.flatMap((child) =>
    child === null || child === undefined || child === false ? [] : [child instanceof Node ? child : String(child)],
  );
}

/**
 * An HTML element; an attribute `onclick` is a listener.
 * @template {keyof HTMLElementTagNameMap} Name
 * @param {Name} name @param {Attributes} [attributes] @param {...Child} children
 * @returns {HTMLElementTagNameMap[Name]}
 */
export function element(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  setAttributes(node, attributes);
  node.append(...present(children));
  return node;
}

/** Each cell of a full row says the head of its column, for a phone, where the cells of a row stand below each other. @param {Child[]} heads @param {Child[]} rows */
function nameCells(heads, rows) {
  const names = heads.map((head) => (head instanceof Node ? head.textContent : String(head)) ?? "");
  for (const row of rows) {
    const cells = row instanceof HTMLTableRowElement && row.cells.length === names.length ? [...row.cells] : [];
    cells.forEach((cell, i) => (cell.dataset.head = names[i]));
  }
}

/**
 * A table that is moved sideways in its frame where it is too wide for the page; with heads, a phone stacks its cells.
 * @param {{class?: string, heads?: Child[]}} options @param {...Child} rows
 */
export function table({ class: name = "", heads = [] }, ...rows) {
  nameCells(heads, rows);
  const head = element("thead", {}, element("tr", {}, ...heads.map((text) => element("th", { scope: "col" }, text))));
  return element(
    "div",
    { class: "table-frame", tabindex: "0" },
    element("table", { class: heads.length ? `${name} stack`.trim() : name }, heads.length ? head : null, element("tbody", {}, ...rows)),
  );
}

/** Replaces what a node holds. @param {Element} node @param {...Child} children */
export function fill(node, ...children) {
  node.replaceChildren(...present(children));
}

const mathElements = new Set([
  "math",
  "mrow",
  "mi",
  "mn",
  "mo",
  "mfrac",
  "msup",
  "msub",
  "msubsup",
  "mover",
  "msqrt",
  "mroot",
  "mtext",
  "mtable",
  "mtr",
  "mtd",
  "mspace",
  "mstyle",
  "munder",
  "munderover",
]);
const mathAttributes = new Set(["accent", "display", "mathvariant", "stretchy", "fence", "separator"]);
const mathSpace = "http://www.w3.org/1998/Math/MathML";

/** Brackets around what is no higher than a line stay small, and a function keeps clear of its argument. @param {Element} copy */
function space(copy) {
  for (const operator of copy.children) {
    if (operator.localName !== "mo") continue;
    if (/^[()]$/.test(operator.textContent ?? "") && !copy.querySelector("mfrac")) operator.setAttribute("stretchy", "false");
    const isBeforeFunction =
      operator.textContent === "\u2062" && (operator.nextElementSibling?.firstElementChild?.textContent ?? "").length > 1;
    if (isBeforeFunction && operator.nextElementSibling?.firstElementChild?.localName === "mi")
      operator.setAttribute("rspace", "0.17em");
    if (operator.textContent === "\u2061" && !operator.nextElementSibling?.querySelector(":scope > mo"))
      operator.setAttribute("rspace", "0.17em");
  }
}

/** @param {Element} source @returns {Element} */
function mathCopy(source) {
  const copy = document.createElementNS(mathSpace, mathElements.has(source.localName) ? source.localName : "mrow");
  for (const { name, value } of source.attributes) if (mathAttributes.has(name)) copy.setAttribute(name, value);
  for (const child of source.childNodes) {
    if (child instanceof Element) copy.append(mathCopy(child));
    else if (child.nodeType === Node.TEXT_NODE) copy.append(child.textContent ?? "");
  }
  space(copy);
  return copy;
}

/** An equation of the service: only elements and attributes of mathematics are taken over. @param {string} markup */
export function mathematics(markup) {
  const parsed = new DOMParser().parseFromString(markup, "application/xml");
  const root = parsed.documentElement;
  if (root.localName !== "math") return element("code", {}, markup);
  return mathCopy(root);
}

/** A button that copies a text and says so. @param {string} label @param {() => string} text */
export function copyButton(label, text) {
  const button = element(
    "button",
    {
      type: "button",
      class: "quiet",
      onclick: async () => {
        await navigator.clipboard.writeText(text());
        button.textContent = "copied";
        setTimeout(() => {
          button.textContent = label;
        }, 1500);
      },
    },
    label,
  );
  return button;
}

/** Gives a text or its bytes to the browser's downloads. @param {string} name @param {Blob} blob */
export function download(name, blob) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
