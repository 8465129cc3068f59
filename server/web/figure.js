// What a scene looks like: its rods, springs, strings, disks and masses as functions of its state. A spring or string is
// recognized by its length: the segment between two places that is as long as the scene says, whatever the state.
import { compiled } from "./expression.js";
import { outline } from "./solids.js";

/** @typedef {import("./motion.js").Values} Values */
/** @typedef {(values: Values) => number[]} Place */
/** @typedef {{ kind: "rod" | "link" | "string" | "spring", name: string, from: Place, to: Place, mass?: number, force?: (v: Values) => number }} Segment */
/** @typedef {{ name: string, at: Place, mass: number }} Mass */
/** @typedef {{ name: string, centre: Place, radius: (v: Values) => number, angle: (v: Values) => number }} Disk */
/** @typedef {{ centre: Place, lines: Place[][] }} Solid a rigid body: chains of places that it carries */

/** @param {number[]} a @param {number[]} b */
export const distance = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));
/** @param {number} a @param {number} b */
const close = (a, b) => Math.abs(a - b) <= 1e-9 * (1 + Math.abs(a) + Math.abs(b));
/** @param {number[]} a @param {number[]} b */
const same = (a, b) => a.every((x, i) => close(x, b[i]));

export class Figure {
  /** @param {any} scene @param {Values} parameters @param {Record<string, string>} [inputs] */
  constructor(scene, parameters, inputs = {}) {
    this.scene = scene;
    this.parameters = parameters;
    this.coordinates = (scene.coordinates ?? []).map((/** @type {any} */ q) => q.name);
    /** @type {Values} */
    this.constants = { ...parameters };
    for (const held of scene.held_lengths ?? []) this.constants[held.name] = compiled(held.value)(this.constants);
    this.inputs = (scene.inputs ?? []).map((/** @type {any} */ input) => ({
      name: input.name,
      value: compiled(inputs[input.name] ?? input.default ?? 0),
    }));
    /** @type {Map<string, Place>} */
    this.points = new Map((scene.points ?? []).map((/** @type {any} */ point) => [point.name, this.vector(point.components)]));
    this.samples = this.sampleStates();
    this.addBodies();
    this.dimension = this.places.length ? this.places[0](this.samples[0]).length : 0;
    this.gravity = scene.gravity ? this.vector(scene.gravity)(this.known({ t: 0 })) : [];
    this.addSegments();
    this.addSupports();
  }

  /** All names that an expression may use. @param {Values} state @returns {Values} */
  known(state) {
    /** @type {Values} */
    const values = { ...this.constants, ...state };
    for (const input of this.inputs) values[input.name] = input.value(values);
    return values;
  }

  /** @param {string[]} components @returns {Place} */
  vector(components) {
    const parts = components.map(compiled);
    return (values) => parts.map((part) => part(values));
  }

  /** @param {string | string[] | { point?: string }} position @returns {Place} */
  place(position) {
    if (Array.isArray(position)) return this.vector(position);
    const name = typeof position === "string" ? position : (position?.point ?? "");
    return this.points.get(name) ?? (() => [NaN, NaN]);
  }

  /** States that have nothing in common, to see what always holds. @returns {Values[]} */
  sampleStates() {
    const canBeNegative = (/** @type {any} */ q) => !String(q.domain ?? "").includes(">");
    return [0, 1, 2, 3, 4].map((k) => {
      /** @type {Values} */
      const state = { t: 0.37 * k };
      (this.scene.coordinates ?? []).forEach((/** @type {any} */ q, /** @type {number} */ i) => {
        const { name } = q;
        state[name] = (0.31 + 0.17 * i + 0.23 * k * (1 + 0.3 * i)) * (k === 4 && canBeNegative(q) ? -1 : 1);
        state[`${name}_dot`] = 0.1 * k;
      });
      return this.known(state);
    });
  }

  addBodies() {
    /** @type {Mass[]} */
    this.masses = [];
    /** @type {Disk[]} */
    this.disks = [];
    /** @type {Segment[]} */
    this.segments = [];
    /** @type {Solid[]} */
    this.solids = [];
    for (const body of this.scene.bodies ?? []) {
      const mass = compiled(body.mass)(this.constants);
      if (body.kind === "particle") this.masses.push({ name: body.name ?? "", at: this.place(body.position), mass });
      if (body.kind === "rod") {
        this.segments.push({ kind: "rod", name: body.name ?? "", from: this.place(body.start), to: this.place(body.end), mass });
      }
      if (body.centre && (body.kind !== "disk" || body.orientation)) {
        const centre = this.place(body.centre);
        this.solids.push({ centre, lines: outline(body, centre, this.constants) });
      } else if (body.kind === "disk") {
        this.disks.push({
          name: body.name ?? "",
          centre: this.place(body.centre),
          radius: compiled(body.radius),
          angle: compiled(body.angle ?? 0),
        });
      }
    }
    // Of a Lagrangian alone the masses are not known: its points are what moves.
    if (!this.scene.bodies?.length) for (const [name, at] of this.points) this.masses.push({ name, at, mass: 0 });
  }

  /** @returns {Place[]} every place that has a name or a body */
  get places() {
    return [
      ...this.points.values(),
      ...this.masses.map((mass) => mass.at),
      ...this.disks.map((disk) => disk.centre),
      ...this.solids.map((solid) => solid.centre),
      ...this.segments.flatMap((segment) => [segment.from, segment.to]),
    ];
  }

  /** @param {Place} a @param {Place} b */
  coincide(a, b) {
    return this.samples.every((values) => same(a(values), b(values)));
  }

  addSegments() {
    const rods = [...this.segments];
    const isRod = (/** @type {Place} */ a, /** @type {Place} */ b) =>
      rods.some(
        (rod) =>
          (this.coincide(rod.from, a) && this.coincide(rod.to, b)) || (this.coincide(rod.from, b) && this.coincide(rod.to, a)),
      );
    for (const chain of this.scene.lines ?? []) {
      for (let i = 1; i < chain.length; ++i) {
        const [from, to] = [this.place(chain[i - 1]), this.place(chain[i])];
        if (!isRod(from, to)) this.segments.push({ kind: "link", name: "", from, to });
      }
    }
    for (const spring of this.scene.springs ?? []) this.addSpring(spring);
    for (const condition of this.scene.valid_while ?? []) if (condition.reaction?.sign === -1) this.markString(condition);
    if (!this.scene.lines) this.addRadii();
  }

  /** @param {Segment} segment @param {(v: Values) => number} length */
  hasLength(segment, length) {
    return this.samples.every((values) => close(distance(segment.from(values), segment.to(values)), length(values)));
  }

  /** @param {any} spring */
  addSpring(spring) {
    if (spring.angle !== undefined) return; // a torsion spring has no two ends
    if (spring.between) return this.addSpringBetween(spring);
    const [length, rest, stiffness] = [spring.length, spring.rest_length ?? 0, spring.stiffness].map(compiled);
    const force = (/** @type {Values} */ v) => stiffness(v) * (length(v) - rest(v));
    const known =
      this.segments.find((segment) => segment.kind === "link" && this.hasLength(segment, length)) ?? this.pairOfLength(length);
    if (known) {
      Object.assign(known, { kind: "spring", name: spring.name ?? "", force });
      if (!this.segments.includes(known)) this.segments.push(known);
      return;
    }
    this.addWallSpring(spring.name ?? "", length, force);
  }

  /** @param {any} spring */
  addSpringBetween(spring) {
    const [from, to] = spring.between.map((/** @type {any} */ place) => this.place(place));
    const [rest, stiffness] = [spring.rest_length ?? 0, spring.stiffness].map(compiled);
    const force = (/** @type {Values} */ v) => stiffness(v) * (distance(from(v), to(v)) - rest(v));
    const known = this.segments.find(
      (part) =>
        part.kind === "link" &&
        ((this.coincide(part.from, from) && this.coincide(part.to, to)) ||
          (this.coincide(part.from, to) && this.coincide(part.to, from))),
    );
    if (known) Object.assign(known, { kind: "spring", name: spring.name ?? "", force });
    else this.segments.push({ kind: "spring", name: spring.name ?? "", from, to, force });
  }

  /** Two places that are always this far from each other. @param {(v: Values) => number} length @returns {Segment | undefined} */
  pairOfLength(length) {
    const places = [...this.places, () => Array(this.places[0]?.(this.samples[0]).length ?? 2).fill(0)];
    for (const from of places) {
      for (const to of places) {
        const segment = { kind: /** @type {"spring"} */ ("spring"), name: "", from, to };
        if (from !== to && !this.coincide(from, to) && this.hasLength(segment, length)) return segment;
      }
    }
    return undefined;
  }

  /** A spring whose length is one component of a place leads to a wall. @param {string} name @param {(v: Values) => number} length @param {(v: Values) => number} force */
  addWallSpring(name, length, force) {
    for (const { at } of [...this.masses, ...this.disks.map((disk) => ({ at: disk.centre }))]) {
      const axis = at(this.samples[0]).findIndex((_, i) =>
        this.samples.every((values) => close(at(values)[i] - length(values), at(this.samples[0])[i] - length(this.samples[0]))),
      );
      if (axis < 0) continue;
      this.wall = { axis, place: -1 };
      const from = (/** @type {Values} */ values) => at(values).map((x, i) => (i === axis ? (this.wall?.place ?? -1) : x));
      this.segments.push({ kind: "spring", name, from, to: at, force });
      return;
    }
  }

  /** The segment that keeps the held length of a tension is a string. @param {any} condition */
  markString(condition) {
    const length = () => this.constants[condition.reaction.length];
    const segment = this.segments.find((part) => part.kind === "link" && this.hasLength(part, length));
    if (segment) Object.assign(segment, { kind: "string", name: condition.name });
  }

  /** Without lines, a mass that keeps its distance from a place that rests is joined to it. */
  addRadii() {
    for (const { at } of this.masses) {
      if (this.segments.some((segment) => this.coincide(segment.to, at) || this.coincide(segment.from, at))) continue;
      const origin = () => Array(this.dimension).fill(0);
      const radius = distance(at(this.samples[0]), origin());
      const isKept = this.samples.every((values) => close(distance(at(values), origin()), radius));
      if (isKept && radius > 0) this.segments.push({ kind: "link", name: "", from: origin, to: at });
    }
  }

  /** Ends of segments that rest and are no bodies are held by something. */
  addSupports() {
    /** @type {Place[]} */
    this.supports = [];
    for (const place of this.segments.flatMap((segment) => [segment.from, segment.to])) {
      const rests = this.samples.every((values) => same(place(values), place(this.samples[0])));
      const isBody = this.masses.some((mass) => this.coincide(mass.at, place));
      if (rests && !isBody && !this.supports.some((known) => this.coincide(known, place))) this.supports.push(place);
    }
  }

  /** The centre of mass of the particles, which no jump moves. @param {Values} values */
  centre(values) {
    const heavy = this.masses.filter((mass) => mass.mass > 0);
    const total = heavy.reduce((sum, mass) => sum + mass.mass, 0);
    const centre = Array(this.dimension).fill(0);
    for (const mass of heavy)
      mass.at(values).forEach((x, i) => {
        centre[i] += (x * mass.mass) / total;
      });
    return centre;
  }

  /** The coordinates that bring a mass near a place, from a state nearby: damped least squares. @param {number} held @param {number[]} target @param {Values} state */
  reach(held, target, state) {
    const names = this.coordinates;
    const now = { ...state };
    for (let round = 0; round < 20; ++round) {
      const here = this.masses[held].at(this.known(now));
      const miss = here.map((x, i) => target[i] - x);
      const slopes = names.map((/** @type {string} */ name) => {
        const there = this.masses[held].at(this.known({ ...now, [name]: now[name] + 1e-6 }));
        return there.map((x, i) => (x - here[i]) / 1e-6);
      });
      // A step of q = J' (J J' + c)^-1 miss, for the two directions of the plane.
      const dot = (/** @type {number} */ i, /** @type {number} */ j) =>
        slopes.reduce((/** @type {number} */ sum, /** @type {number[]} */ s) => sum + s[i] * s[j], 0);
      const damping = 1e-4 * (dot(0, 0) + dot(1, 1)) + 1e-12;
      const [a, b, d] = [dot(0, 0) + damping, dot(0, 1), dot(1, 1) + damping];
      const determinant = a * d - b * b;
      const pull = [(d * miss[0] - b * miss[1]) / determinant, (a * miss[1] - b * miss[0]) / determinant];
      names.forEach((/** @type {string} */ name, /** @type {number} */ k) => {
        const step = slopes[k][0] * pull[0] + slopes[k][1] * pull[1];
        now[name] += Math.max(-0.5, Math.min(0.5, step));
      });
    }
    const reached = Object.fromEntries(names.map((/** @type {string} */ name) => [name, Number(now[name].toPrecision(4))]));
    return Object.values(reached).every(Number.isFinite) ? reached : null;
  }
}
