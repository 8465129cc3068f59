// A drawing that plays: the canvas, its clock, and what the hand does to it.
import { Clock } from "./clock.js";
import { element } from "./dom.js";
import { palette } from "./painter.js";
import { Picture } from "./picture.js";
import { short } from "./numbers.js";

/** @typedef {import("./figure.js").Figure} Figure */
/** @typedef {import("./camera.js").Moving} Moving */

const stillPreferred = matchMedia("(prefers-reduced-motion: reduce)");

/** The picture on each canvas, for those who test what is drawn. @type {WeakMap<HTMLCanvasElement, Picture>} */
export const pictures = new WeakMap();

/** @param {string} label @param {boolean} checked @param {(on: boolean) => void} change */
function toggle(label, checked, change) {
  const box = element("input", { type: "checkbox", checked, onchange: () => change(box.checked) });
  return element("label", { class: "toggle" }, box, label);
}

export class Stage {
  /** @param {{ onDrag?: (values: Record<string, number>) => void }} [options] */
  constructor({ onDrag } = {}) {
    this.onDrag = onDrag;
    this.clock = new Clock();
    /** @type {import("./picture.js").Shown} */
    this.shown = { labels: true, trails: true, velocities: false, forces: false, ghost: null };
    this.canvas = element("canvas", { class: "drawing", role: "img", tabindex: "0", "aria-label": "The drawing of the motion" });
    this.said = element("p", { class: "ending", "aria-live": "polite" });
    this.node = element("div", { class: "stage" }, this.canvas, this.bar(), this.said, this.toggles());
    this.listen();
    this.isStarted = false;
  }

  bar() {
    this.playButton = element("button", { type: "button", class: "play", onclick: () => this.toggle() }, "Play");
    this.scrub = element("input", {
      type: "range",
      min: "0",
      max: "1",
      step: "any",
      value: "0",
      "aria-label": "Time",
      class: "scrub",
      oninput: () => this.scrubbed(),
    });
    this.reading = element("output", { class: "clock" });
    const speeds = [
      ["0.1", "1/10"],
      ["0.25", "1/4"],
      ["1", "true time"],
      ["4", "4 ×"],
    ].map(([value, label]) => element("option", { value, selected: value === "1" }, label));
    const select = element(
      "select",
      {
        "aria-label": "Speed",
        onchange: () => {
          this.clock.speed = Number(select.value);
        },
      },
      ...speeds,
    );
    return element("div", { class: "bar" }, this.playButton, this.scrub, this.reading, select);
  }

  scrubbed() {
    const wanted = Number(this.scrub?.value);
    this.clock.pause();
    this.clock.seek(wanted);
  }

  toggles() {
    const change = (/** @type {"labels" | "trails" | "velocities" | "forces"} */ name) => (/** @type {boolean} */ on) => {
      this.shown[name] = on;
      this.draw();
    };
    return element(
      "div",
      { class: "toggles", role: "group", "aria-label": "What is drawn" },
      toggle("angles", true, change("labels")),
      toggle("trail", true, change("trails")),
      toggle("velocities", false, change("velocities")),
      toggle("forces", false, change("forces")),
    );
  }

  listen() {
    this.clock.onChange(() => this.draw());
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    this.canvas.addEventListener("pointerdown", (event) => this.grab(event));
    // A finger on a body takes the body; elsewhere it moves the page.
    const hold = (/** @type {TouchEvent} */ event) => {
      if (this.onDrag && this.figure?.dimension === 2 && this.bodyAt(event.touches[0]) >= 0) event.preventDefault();
    };
    this.canvas.addEventListener("touchstart", hold, { passive: false });
    new ResizeObserver(() => {
      this.picture?.resize();
      this.draw();
    }).observe(this.canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      if (this.picture) this.picture.painter.colours = palette();
      this.draw();
    });
  }

  toggle() {
    if (this.clock.plays) this.clock.pause();
    else this.clock.play();
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const step = (this.clock.end - this.clock.start) / 400;
    const turn = this.figure?.dimension === 3 && event.shiftKey ? { ArrowLeft: -0.1, ArrowRight: 0.1 }[event.key] : undefined;
    const moves = { ArrowLeft: -step, ArrowRight: step, Home: -Infinity, End: Infinity }[event.key];
    if (event.key === " ") this.toggle();
    else if (turn !== undefined && this.picture) this.turn(turn, 0);
    else if (moves !== undefined) {
      this.clock.pause();
      this.clock.seek(this.clock.time + moves);
    } else return;
    event.preventDefault();
  }

  /** @param {number} azimuth @param {number} elevation */
  turn(azimuth, elevation) {
    const camera = this.picture?.camera;
    if (!camera) return;
    camera.azimuth += azimuth;
    camera.elevation = Math.min(1.5, Math.max(0, camera.elevation + elevation));
    camera.fit(camera.size[0], camera.size[1]);
    this.draw();
  }

  /** A drawing in space is turned; in the plane a body is taken to where the motion shall begin. @param {PointerEvent} event */
  grab(event) {
    const { picture, figure } = this;
    if (!picture || !figure) return;
    const held = figure.dimension === 2 ? this.bodyAt(event) : -1;
    if (figure.dimension === 2 && (held < 0 || !this.onDrag)) return;
    this.canvas.setPointerCapture(event.pointerId);
    if (held >= 0) {
      this.clock.pause();
      this.clock.seek(this.clock.start);
    }
    const move = (/** @type {PointerEvent} */ now) => {
      if (held >= 0) this.drag(held, now);
      else this.turn(-now.movementX * 0.01, now.movementY * 0.01);
    };
    const end = () => this.canvas.removeEventListener("pointermove", move);
    this.canvas.addEventListener("pointermove", move);
    this.canvas.addEventListener("pointerup", end, { once: true });
    this.canvas.addEventListener("pointercancel", end, { once: true });
  }

  /** @param {{ clientX: number, clientY: number }} event @returns {[number, number]} */
  pixelOf(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** The mass under the pointer, or -1. @param {{ clientX: number, clientY: number }} event */
  bodyAt(event) {
    const { picture, figure } = this;
    if (!picture || !figure || !this.motion) return -1;
    const [x, y] = this.pixelOf(event);
    const values = figure.known(this.motion.at(this.clock.time));
    const offset = picture.offsets[this.motion.section(this.clock.time)];
    return figure.masses.findIndex((mass) => {
      const [a, b] = picture.pixel(mass.at, values, offset);
      return Math.hypot(a - x, b - y) < picture.radiusOf(mass.mass) + 10;
    });
  }

  /** @param {number} held @param {PointerEvent} event */
  drag(held, event) {
    const { picture, figure, motion } = this;
    if (!picture || !figure || !motion || !this.onDrag) return;
    const target = picture.camera.unproject(...this.pixelOf(event));
    const values = figure.reach(held, target, motion.at(motion.start));
    if (values) this.onDrag(values);
  }

  /** @param {Figure} figure */
  setFigure(figure) {
    const camera = this.picture?.camera;
    this.figure = figure;
    this.picture = new Picture(this.canvas, figure, palette());
    if (camera) [this.picture.camera.azimuth, this.picture.camera.elevation] = [camera.azimuth, camera.elevation];
    pictures.set(this.canvas, this.picture);
  }

  /** @param {Moving & { tellingInstant?: () => number }} motion @param {string} [ending] why it ends where it ends @param {number | null} [horizon] until when it is known */
  setMotion(motion, ending = "", horizon = null) {
    this.motion = motion;
    this.ending = ending;
    this.horizon = horizon ?? Infinity;
    this.picture?.setMotion(motion);
    if (this.scrub) [this.scrub.min, this.scrub.max] = [String(motion.start), String(motion.end)];
    this.clock.setRange(motion.start, motion.end);
    if (this.isStarted) return;
    this.isStarted = true;
    if (stillPreferred.matches) this.clock.seek(motion.tellingInstant?.() ?? motion.start);
    else this.clock.play();
  }

  draw() {
    const { clock } = this;
    if (this.scrub) this.scrub.value = String(clock.time);
    if (this.reading) this.reading.textContent = `t = ${short(Number(clock.time.toFixed(2)))} s`;
    const label = clock.plays ? "Pause" : clock.time >= clock.end ? "Again" : "Play";
    if (this.playButton && this.playButton.textContent !== label) this.playButton.textContent = label;
    const isLost = clock.time > (this.horizon ?? Infinity);
    const lost = isLost ? `Known until ${short(Number(this.horizon))} s only: from there on this may be another motion. ` : "";
    const said = lost + (clock.time >= clock.end ? (this.ending ?? "") : "");
    if (this.said && this.said.textContent !== said) this.said.textContent = said;
    this.canvas.classList.toggle("lost", isLost);
    this.picture?.draw(clock.time, this.shown);
  }
}
