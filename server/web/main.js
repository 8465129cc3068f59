// From the address to its view.
import { onAsking, onConnection } from "./api.js";
import { element } from "./dom.js";
import { problemNote } from "./foot.js";
import { addressOf } from "./link.js";
import { showProblem } from "./practice.js";
import { showOwnScene } from "./own_scene.js";
import { showStart } from "./start.js";
import { showSystem } from "./system.js";

const main = /** @type {HTMLElement} */ (document.getElementById("main"));
const connection = /** @type {HTMLElement} */ (document.getElementById("connection"));
/** @type {AbortController | null} */
let current = null;

let slow = 0;
onAsking((count) => {
  const { dataset } = document.documentElement;
  clearTimeout(slow);
  if (count) {
    dataset.asking = String(count);
    slow = window.setTimeout(() => {
      dataset.slow = "";
    }, 300);
  } else {
    delete dataset.asking;
    delete dataset.slow;
  }
});

onConnection((text) => {
  if (connection.textContent !== text) connection.textContent = text;
});

/** @param {string[]} path @param {import("./link.js").Address} address @param {AbortSignal} left */
function view([room, name, part], address, left) {
  if (room === "systems" && name) return showSystem(main, address, name, part, left);
  if (room === "scene") return showOwnScene(main, address, name, left);
  if (room === "problems") return showProblem(main, Number(name) || 1, left);
  return showStart(main, left);
}

/** A view that is already there may know how to show another part of itself. */
async function navigate() {
  const address = addressOf();
  if (!main.dispatchEvent(new CustomEvent("address", { detail: address, cancelable: true }))) return;
  current?.abort();
  current = new AbortController();
  const { signal } = current;
  document.title = "qdot";
  try {
    await view(address.path, address, signal);
  } catch (error) {
    if (!signal.aborted) main.replaceChildren(element("h1", {}, "This cannot be shown"), problemNote(error));
  }
  markHere(address.path[0] ?? "");
}

/** @param {string} room */
function markHere(room) {
  for (const link of document.querySelectorAll("header nav a")) {
    const isHere = link.getAttribute("href") === (room === "problems" ? "#/problems" : room === "scene" ? "#/scene" : "#/");
    if (isHere) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
}

window.addEventListener("hashchange", () => {
  navigate();
  window.scrollTo(0, 0);
});
navigate();
