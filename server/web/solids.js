// Rigid bodies as lines: a circle with a radius, the edges of a box, three axes where only moments are known.
import { compiled } from "./expression.js";

/** @typedef {import("./motion.js").Values} Values */
/** @typedef {import("./figure.js").Place} Place */
/** @typedef {(values: Values, v: number[]) => number[]} Turning body components to those of space */

const round = 32;
/** @param {number} radius @param {number} height */
const circle = (radius, height) =>
  Array.from({ length: round + 1 }, (_, i) => {
    const angle = (2 * Math.PI * i) / round;
    return [radius * Math.cos(angle), radius * Math.sin(angle), height];
  });

/** @param {number} a @param {number} b @param {number} c */
function box(a, b, c) {
  const rim = (/** @type {number} */ z) =>
    [
      [-a, -b],
      [a, -b],
      [a, b],
      [-a, b],
      [-a, -b],
    ].map(([x, y]) => [x / 2, y / 2, z / 2]);
  const posts = rim(0)
    .slice(1)
    .map(([x, y]) => [
      [x, y, -c / 2],
      [x, y, c / 2],
    ]);
  return c > 0 ? [rim(-c), rim(c), ...posts] : [rim(0)];
}

/** Three great circles. @param {number} r */
const ball = (r) => {
  const rim = circle(r, 0);
  return [rim, rim.map(([x, y]) => [0, x, y]), rim.map(([x, y]) => [y, 0, x])];
};

/** What is drawn of a shape, in the body's axes. @type {Record<string, (size: (name: string) => number) => number[][][]>} */
const shapes = {
  disk: (size) => [circle(size("radius"), 0), [[0, 0, 0], [size("radius"), 0, 0]]],
  ring: (size) => [circle(size("radius"), 0), [[0, 0, 0], [size("radius"), 0, 0]]],
  sphere: (size) => ball(size("radius")),
  shell: (size) => ball(size("radius")),
  cylinder: (size) => {
    const [r, h] = [size("radius"), size("length") / 2];
    const sides = [0, 1, 2, 3].map((k) => [r * Math.cos((k * Math.PI) / 2), r * Math.sin((k * Math.PI) / 2)]);
    return [circle(r, h), circle(r, -h), ...sides.map(([x, y]) => [[x, y, -h], [x, y, h]])];
  },
  box: (size) => box(size("width"), size("height"), size("depth")),
};

/** Axes as long as the body's radii of gyration. @param {number[]} moments @param {number} mass */
function axes(moments, mass) {
  return moments.map((moment, i) => {
    const length = Math.sqrt(Math.max(0, moment) / Math.max(mass, 1e-300));
    const end = [0, 0, 0];
    end[i] = length;
    return [[0, 0, 0], end];
  });
}

/** v turned about an axis of any length. @param {number[]} axis @param {number} angle @param {number[]} v */
function turnedAbout(axis, angle, v) {
  const length = Math.hypot(...axis);
  const n = axis.map((x) => x / length);
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const share = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
  const cross = [n[1] * v[2] - n[2] * v[1], n[2] * v[0] - n[0] * v[2], n[0] * v[1] - n[1] * v[0]];
  return v.map((x, i) => n[i] * share + c * (x - n[i] * share) + s * cross[i]);
}

/** Turns of a sequence: capital letters in order, small ones the other way round. @param {any} orientation */
function turnsOf(orientation) {
  if (orientation.rotations) return orientation.rotations;
  const turns = [...orientation.sequence].map((letter, i) => ({
    axis: ["x", "y", "z"].map((name) => Number(name === letter.toLowerCase())),
    angle: orientation.angles[i],
  }));
  return orientation.sequence === orientation.sequence.toLowerCase() ? turns.reverse() : turns;
}

/** @param {any} body @returns {Turning} */
function turning(body) {
  if (body.angle !== undefined) {
    const angle = compiled(body.angle);
    return (values, v) => turnedAbout([0, 0, 1], angle(values), v).slice(0, 2);
  }
  const turns = turnsOf(body.orientation).map((/** @type {any} */ turn) => ({
    axis: turn.axis.map(compiled),
    angle: compiled(turn.angle),
  }));
  return (values, v) =>
    turns.reduceRight(
      (/** @type {number[]} */ u, /** @type {any} */ turn) =>
        turnedAbout(
          turn.axis.map((/** @type {(v: Values) => number} */ x) => x(values)),
          turn.angle(values),
          u,
        ),
      v,
    );
}

/** The lines of a body, each a chain of places. @param {any} body @param {Place} centre @param {Values} constants @returns {Place[][]} */
export function outline(body, centre, constants) {
  if (!body.angle && !body.orientation) return [];
  const size = (/** @type {string} */ name) => compiled(body[name] ?? 0)(constants);
  const moments = body.principal_moments ?? [body.inertia ?? 0];
  const lines = shapes[body.kind]
    ? shapes[body.kind](size)
    : axes(
        moments.map((/** @type {any} */ moment) => compiled(moment)(constants)),
        size("mass"),
      );
  const turn = turning(body);
  return lines.map((line) =>
    line.map((point) => (/** @type {Values} */ values) => {
      const at = centre(values);
      return turn(values, point).map((x, i) => x + at[i]);
    }),
  );
}
