// The first view: every system as a small drawing that moves, the ten problems, and the way to a scene of one's own.
import { ask, read } from "./api.js";
import { element } from "./dom.js";
import { Figure } from "./figure.js";
import { Motion } from "./motion.js";
import { palette } from "./painter.js";
import { Picture } from "./picture.js";
import { pictures } from "./stage.js";

const stillPreferred = matchMedia("(prefers-reduced-motion: reduce)");
/** Starts that show what a system does, where its default start shows little of it. @type {Record<string, any>} */
const livelier = {
  forced_spring_pendulum: { inputs: { F: "2*cos(4*t)" } },
  whirling_pendulum: { initial: { theta: 1.3 } },
  rolling_disk_platform: { parameters: { r: 0.2 }, initial: { q: 0.3, q_dot: 0.8 } },
};

/** One small drawing. */
class Vignette {
  /** @param {any} system */
  constructor(system) {
    this.system = system;
    this.canvas = element("canvas", { class: "vignette", role: "img", "aria-label": `${system.title}, moving` });
    this.node = element(
      "a",
      { class: "system-link", href: `#/systems/${system.name}` },
      this.canvas,
      element("span", { class: "system-title" }, system.title),
      element("span", { class: "system-problem" }, system.problem ? `Problem ${system.problem}` : ""),
    );
    this.time = 0;
  }

  async load() {
    const scene = await read(`/v1/systems/${this.system.name}/scene`);
    const body = { system: this.system.name, t_end: 8, samples: 241, verify: false, ...(livelier[this.system.name] ?? {}) };
    const answer = await ask("simulate", body);
    const figure = new Figure(scene, answer.request.parameters, answer.request.inputs);
    this.motion = new Motion(answer, figure.coordinates);
    this.picture = new Picture(this.canvas, figure, palette());
    pictures.set(this.canvas, this.picture);
    this.picture.setMotion(this.motion);
    this.time = stillPreferred.matches ? this.motion.tellingInstant() : this.motion.start;
    this.draw();
  }

  /** @param {number} seconds */
  advance(seconds) {
    if (!this.motion) return;
    this.time += seconds;
    if (this.time > this.motion.end + 0.6) this.time = this.motion.start;
    this.draw();
  }

  draw() {
    this.picture?.draw(Math.min(this.time, this.motion?.end ?? 0), { trails: true });
  }
}

/** Plays what can be seen, until the view is left. @param {Vignette[]} vignettes @param {AbortSignal} left */
function play(vignettes, left) {
  const seen = new Set();
  const watcher = new IntersectionObserver((entries) =>
    entries.forEach((entry) => {
      if (entry.isIntersecting) seen.add(entry.target);
      else seen.delete(entry.target);
    }),
  );
  vignettes.forEach((vignette) => watcher.observe(vignette.canvas));
  const resize = new ResizeObserver(() =>
    vignettes.forEach((vignette) => {
      vignette.picture?.resize();
      vignette.draw();
    }),
  );
  vignettes.slice(0, 1).forEach((vignette) => resize.observe(vignette.canvas));
  let last = performance.now();
  const frame = (/** @type {number} */ now) => {
    if (left.aborted) {
      watcher.disconnect();
      resize.disconnect();
      return;
    }
    const passed = Math.min(0.1, (now - last) / 1000);
    last = now;
    if (!stillPreferred.matches) for (const vignette of vignettes) if (seen.has(vignette.canvas)) vignette.advance(passed);
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
}

/** @param {HTMLElement} main @param {AbortSignal} left */
export async function showStart(main, left) {
  const [{ systems }, { problems }, { systems: classics }] = await Promise.all([
    read("/v1/systems"),
    read("/v1/problems"),
    read("/v1/systems?collection=classics"),
  ]);
  if (left.aborted) return;
  const vignettes = systems.map((/** @type {any} */ system) => new Vignette(system));
  main.replaceChildren(
    element(
      "section",
      { class: "start-words" },
      element("h1", {}, "Mechanics that says how wrong it is"),
      element(
        "p",
        {},
        "Say where the bodies are. The equations of motion, frequencies, equilibria and turning points are derived from it, and every number comes with its error.",
      ),
    ),
    element(
      "section",
      { "aria-label": "Systems" },
      element(
        "div",
        { class: "systems" },
        ...vignettes.map((/** @type {Vignette} */ one) => one.node),
        element(
          "a",
          { class: "system-link own", href: "#/scene" },
          element("span", { class: "own-sign" }, "+"),
          element("span", { class: "system-title" }, "Your own scene"),
          element("span", { class: "system-problem" }, "a few lines that say where things are"),
        ),
      ),
    ),
    element(
      "section",
      { class: "problem-list" },
      element("h2", {}, "The practice sheet"),
      element(
        "ol",
        {},
        ...problems.map((/** @type {any} */ one) =>
          element("li", { value: one.number }, element("a", { href: `#/problems/${one.number}` }, one.title)),
        ),
      ),
    ),
    element(
      "section",
      { class: "problem-list" },
      element("h2", {}, "Classics of textbooks"),
      element(
        "ul",
        {},
        ...classics.map((/** @type {any} */ one) =>
          element("li", {}, element("a", { href: `#/systems/${one.name}` }, one.title)),
        ),
      ),
    ),
  );
  play(vignettes, left);
  await Promise.all(vignettes.map((/** @type {Vignette} */ one) => one.load()));
}
