// One instant of a motion: the figure of a scene through a camera.
import { allForces, longest, velocities } from "./arrows.js";
import { Camera, frameOffsets } from "./camera.js";
import { distance } from "./figure.js";
import { symbol } from "./numbers.js";
import { Painter } from "./painter.js";
import { drawAxis, drawGround, hasGround, placeWall } from "./surroundings.js";

/** @typedef {import("./figure.js").Figure} Figure */
/** @typedef {import("./figure.js").Place} Place */
/** @typedef {import("./motion.js").Values} Values */
/** @typedef {import("./camera.js").Moving} Moving */
/** @typedef {{ labels?: boolean, trails?: boolean, velocities?: boolean, forces?: boolean, ghost?: Moving | null }} Shown */

/** The angle coordinates and the segments that turn by them. @param {Figure} figure */
function turnedBy(figure) {
  const found = [];
  const sample = figure.samples[0];
  for (const { name, unit } of figure.scene.coordinates ?? []) {
    if (unit !== "rad") continue;
    const turned = { ...sample, [name]: sample[name] + 0.2 };
    const angle = (/** @type {import("./figure.js").Segment} */ { from, to }) => {
      const [a, b] = [sample, turned].map((values) => {
        const p = from(values);
        return to(values).map((x, i) => x - p[i]);
      });
      const cosine = a.reduce((sum, x, i) => sum + x * b[i], 0) / (Math.hypot(...a) * Math.hypot(...b));
      return distance(from(sample), from(turned)) < 1e-9 ? Math.acos(Math.min(1, cosine)) : NaN;
    };
    const segment = figure.segments.find((part) => Math.abs(angle(part) - 0.2) < 1e-6);
    if (segment) found.push({ name, segment });
  }
  return found;
}

export class Picture {
  /** @param {HTMLCanvasElement} canvas @param {Figure} figure @param {Record<string, string>} colours */
  constructor(canvas, figure, colours) {
    this.canvas = canvas;
    this.figure = figure;
    this.camera = new Camera(figure);
    this.painter = new Painter(/** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d")), colours);
    this.angles = turnedBy(figure);
    this.heaviest = Math.max(0, ...figure.masses.map((mass) => mass.mass));
    /** @type {number[][]} */
    this.offsets = [[]];
    /** @type {{ velocity: number, force: number } | null} the largest of the motion */
    this.largest = null;
  }

  /** @param {Moving} motion */
  setMotion(motion) {
    this.motion = motion;
    this.offsets = frameOffsets(this.figure, motion);
    if (this.figure.wall) placeWall(this.figure, motion);
    this.camera.watch(motion, this.offsets);
    this.hasGround = hasGround(this.figure, motion, this.camera);
    this.largest = null;
    this.resize();
  }

  /** The canvas has as many pixels as the screen shows. */
  resize() {
    const { width, height } = this.canvas.getBoundingClientRect();
    if (!width) return;
    const density = Math.min(3, window.devicePixelRatio || 1);
    this.canvas.width = Math.round(width * density);
    this.canvas.height = Math.round(height * density);
    this.painter.context.setTransform(density, 0, 0, density, 0, 0);
    this.camera.fit(width, height);
  }

  /** @param {Place} place @param {Values} values @param {number[]} offset */
  pixel(place, values, offset) {
    return this.camera.project(place(values).map((x, i) => x + (offset[i] ?? 0)));
  }

  /** @param {number} t @param {Shown} [shown] */
  draw(t, shown = {}) {
    if (!this.motion) return;
    const { painter, camera } = this;
    painter.context.clearRect(0, 0, camera.size[0], camera.size[1]);
    const values = this.figure.known(this.motion.at(t));
    const offset = this.offsets[this.motion.section(t)] ?? [];
    if (this.hasGround) drawGround(this.painter, this.camera);
    if (this.figure.dimension === 3 && this.figure.supports.length) drawAxis(this.painter, this.camera);
    if (shown.trails) this.drawTrails(t);
    if (shown.ghost) this.drawGhost(shown.ghost, t);
    if (shown.labels) this.drawAngles(values, offset);
    this.drawBodies(values, offset);
    if (shown.velocities || shown.forces) this.drawArrows(values, offset, shown);
  }

  /** @param {Values} values @param {number[]} offset */
  drawBodies(values, offset) {
    const { figure, painter, camera } = this;
    for (const disk of figure.disks) {
      painter.disk(this.pixel(disk.centre, values, offset), disk.radius(values) * camera.scale, disk.angle(values) + camera.turn);
    }
    for (const line of figure.solids.flatMap((solid) => solid.lines)) {
      const pixels = line.map((place) => this.pixel(place, values, offset));
      painter.path(pixels, painter.colours.blue, 2);
    }
    for (const segment of figure.segments) this.drawSegment(segment, values, offset);
    for (const support of figure.supports)
      painter.support(this.pixel(support, values, offset), this.supportKind(support, values));
    for (const mass of figure.masses) {
      const place = this.pixel(mass.at, values, offset);
      painter.mass(place, this.radiusOf(mass.mass));
    }
  }

  /** Its area goes with the mass. @param {number} mass */
  radiusOf(mass) {
    const most = Math.max(5, Math.min(13, 0.035 * Math.min(...this.camera.size)));
    return this.heaviest > 0 ? Math.max(3, most * Math.sqrt(mass / this.heaviest)) : 4;
  }

  /** @param {import("./figure.js").Segment} segment @param {Values} values @param {number[]} offset */
  drawSegment(segment, values, offset) {
    const { painter } = this;
    const [a, b] = [this.pixel(segment.from, values, offset), this.pixel(segment.to, values, offset)];
    if (segment.kind === "rod") painter.rod(a, b, Math.max(5, Math.min(9, this.camera.size[0] / 60)));
    else if (segment.kind === "spring") painter.spring(a, b, Math.max(4, Math.min(9, this.camera.size[0] / 50)));
    else if (segment.kind === "string") painter.string(a, b, this.isSlack(segment.name, Number(values.t)));
    else painter.path([a, this.onward(a, b, segment, values)], painter.colours.ink, 2);
  }

  /** A segment on whose end a disk stands is a surface, and goes on. @param {number[]} a @param {number[]} b @param {import("./figure.js").Segment} segment @param {Values} values */
  onward(a, b, segment, values) {
    const end = segment.to(values);
    const disk = this.figure.disks.find(
      (one) =>
        Math.abs(distance(one.centre(values), end) - one.radius(values)) < 1e-9 &&
        distance(one.centre(values), segment.from(values)) > 1e-9,
    );
    if (!disk) return b;
    const more = 1 + (4 * disk.radius(values) * this.camera.scale) / Math.max(1, Math.hypot(b[0] - a[0], b[1] - a[1]));
    return [a[0] + more * (b[0] - a[0]), a[1] + more * (b[1] - a[1])];
  }

  /** @param {string} condition @param {number} t */
  isSlack(condition, t) {
    const motion = /** @type {any} */ (this.motion);
    return motion?.columns?.[condition] !== undefined && motion.column(condition, t) < 0;
  }

  /** @param {Place} support @param {Values} values @returns {"ceiling" | "pin" | "wall"} */
  supportKind(support, values) {
    const { figure, camera } = this;
    if (figure.wall && support(values)[figure.wall.axis] === figure.wall.place) return "wall";
    const hangs = figure.dimension === 2 && figure.gravity.some((g) => g !== 0) && !figure.disks.length;
    return hangs && camera.seen.length > 0 ? "ceiling" : "pin";
  }

  /** @param {number} t */
  drawTrails(t) {
    const motion = /** @type {Moving} */ (this.motion);
    const span = Math.min(2.5, motion.end - motion.start);
    const begin = Math.max(motion.start, t - span);
    const count = Math.ceil((t - begin) * 100);
    const times = Array.from({ length: count + 1 }, (_, i) => begin + ((t - begin) * i) / Math.max(1, count));
    const states = times.map((time) => ({
      values: this.figure.known(motion.at(time)),
      offset: this.offsets[motion.section(time)],
    }));
    const moving = this.figure.masses.length
      ? this.figure.masses.map((mass) => mass.at)
      : this.figure.segments.slice(-1).map((part) => part.to);
    for (const place of moving)
      this.painter.trail(
        states.map(({ values, offset }) => this.pixel(place, values, offset)),
        this.painter.colours.sky,
      );
  }

  /** The second motion; where it parts from the first is marked. @param {Moving} ghost @param {number} t */
  drawGhost(ghost, t) {
    if (t > ghost.end) return;
    const { painter } = this;
    const values = this.figure.known(ghost.at(t));
    const own = this.figure.known(/** @type {Moving} */ (this.motion).at(t));
    const offset = frameOffsets(this.figure, ghost)[ghost.section(t)];
    painter.context.globalAlpha = 0.55;
    for (const segment of this.figure.segments) {
      painter.path(
        [this.pixel(segment.from, values, offset), this.pixel(segment.to, values, offset)],
        painter.colours.vermillion,
        1.5,
        [4, 4],
      );
    }
    for (const mass of this.figure.masses)
      painter.mass(this.pixel(mass.at, values, offset), this.radiusOf(mass.mass), painter.colours.vermillion);
    painter.context.globalAlpha = 1;
    for (const mass of this.figure.masses) {
      const [a, b] = [this.pixel(mass.at, own, this.offsets[0]), this.pixel(mass.at, values, offset)];
      if (Math.hypot(a[0] - b[0], a[1] - b[1]) > 1) painter.path([a, b], painter.colours.vermillion, 1);
    }
  }

  /** Each angle as an arc with its letter, from where the angle is 0. @param {Values} values @param {number[]} offset */
  drawAngles(values, offset) {
    const { painter, camera } = this;
    for (const { name, segment } of this.angles) {
      const count = Math.max(2, Math.min(120, Math.ceil(Math.abs(values[name]) * 20)));
      const foot = segment.from(values);
      const length = distance(foot, segment.to(values));
      const reach = Math.min(0.45 * length, 46 / camera.scale);
      const at = (/** @type {number} */ part, /** @type {number} */ far) => {
        const end = segment.to({ ...values, [name]: values[name] * part });
        return camera.project(foot.map((x, i) => x + ((end[i] - x) * far) / length + (offset[i] ?? 0)));
      };
      painter.path([at(0, 0), at(0, reach * 1.5)], painter.colours.line, 1, [4, 3]);
      painter.path(
        Array.from({ length: count + 1 }, (_, i) => at(i / count, reach)),
        painter.colours.green,
        1.5,
      );
      painter.text(symbol(name), at(0.5, reach + 15 / camera.scale), painter.colours.green);
    }
  }

  /** @param {Values} values @param {number[]} offset @param {Shown} shown */
  drawArrows(values, offset, shown) {
    const { figure, motion } = this;
    if (!motion) return;
    this.largest ??= { velocity: longest(velocities, figure, motion), force: longest(allForces, figure, motion) };
    if (shown.velocities) this.showArrows(velocities(figure, values), this.largest.velocity, offset, this.painter.colours.green);
    if (shown.forces) this.showArrows(allForces(figure, values, motion), this.largest.force, offset, this.painter.colours.purple);
  }

  /** @param {import("./arrows.js").Arrow[]} arrows @param {number} most @param {number[]} offset @param {string} colour */
  showArrows(arrows, most, offset, colour) {
    const factor = (0.22 * Math.min(...this.camera.size)) / (most * this.camera.scale || 1);
    for (const { at, vector, label } of arrows) {
      const foot = at.map((x, i) => x + (offset[i] ?? 0));
      this.painter.arrow(
        this.camera.project(foot),
        this.camera.project(foot.map((x, i) => x + factor * vector[i])),
        colour,
        label,
      );
    }
  }
}
