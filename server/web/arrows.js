// Velocities and forces as arrows, each with one scale for the whole motion.
import { distance } from "./figure.js";
import { symbol } from "./numbers.js";

/** @typedef {import("./figure.js").Figure} Figure */
/** @typedef {import("./motion.js").Values} Values */
/** @typedef {import("./camera.js").Moving} Moving */
/** @typedef {{ at: number[], vector: number[], label: string }} Arrow */

/** The velocity of each mass. @param {Figure} figure @param {Values} values @returns {Arrow[]} */
export function velocities(figure, values) {
  const h = 1e-5;
  const shifted = (/** @type {number} */ sign) => {
    /** @type {Values} */
    const moved = { ...values, t: values.t + sign * h };
    for (const name of figure.coordinates) moved[name] += sign * h * values[`${name}_dot`];
    return moved;
  };
  const [before, after] = [shifted(-1), shifted(1)];
  return figure.masses.map(({ at }) => {
    const [a, b] = [at(before), at(after)];
    return { at: at(values), vector: a.map((x, i) => (b[i] - x) / (2 * h)), label: "v" };
  });
}

/** The pull of a spring on its second end. @param {import("./figure.js").Segment} segment @param {Values} values @returns {Arrow} */
function pull(segment, values) {
  const [from, to, force] = [segment.from(values), segment.to(values), segment.force?.(values) ?? 0];
  const length = distance(from, to) || 1;
  return { at: to, vector: to.map((x, i) => (force * (from[i] - x)) / length), label: "" };
}

/** Weights, springs and applied forces. @param {Figure} figure @param {Values} values @returns {Arrow[]} */
export function forces(figure, values) {
  const heavy = figure.gravity.length ? figure.masses.filter(({ mass }) => mass > 0) : [];
  const weights = heavy.map(({ at, mass }) => ({ at: at(values), vector: figure.gravity.map((g) => g * mass), label: "" }));
  const springs = figure.segments.filter(({ kind }) => kind === "spring").map((segment) => pull(segment, values));
  const applied = (figure.scene.forces ?? []).map((/** @type {any} */ force) => ({
    at: figure.place(force.point)(values),
    vector: figure.vector(force.vector)(values),
    label: symbol(force.name ?? ""),
  }));
  return [...weights, ...springs, ...applied];
}

/** Where a held length ends in a body or a string, and the way it grows there. @param {Figure} figure @param {Values} values @param {string} length */
function endOf(figure, values, length) {
  const h = 1e-6;
  const longer = { ...values, [length]: values[length] + h };
  const strings = figure.segments.filter(({ kind }) => kind === "string").flatMap(({ from, to }) => [to, from]);
  const places = [...strings, ...figure.masses.map(({ at }) => at), ...figure.disks.map(({ centre }) => centre)];
  for (const place of places) {
    const [here, there] = [place(values), place(longer)];
    const way = there.map((x, i) => (x - here[i]) / h);
    if (Math.hypot(...way) > 0.5) return { here, way };
  }
  return null;
}

/** The forces that keep lengths: a string pulls its end back along itself, a platform pushes what lies on it. @param {Figure} figure @param {Values} values @param {Moving} motion @returns {Arrow[]} */
export function reactions(figure, values, motion) {
  const conditions = [...(figure.scene.valid_while ?? []), ...(figure.scene.reports ?? [])];
  return conditions.flatMap((/** @type {any} */ { name, reaction }) => {
    const size = reaction && motion.columns?.[name] ? motion.column?.(name, values.t) : undefined;
    const end = size === undefined ? null : endOf(figure, values, reaction.length);
    if (size === undefined || !end) return [];
    return [
      { at: end.here, vector: end.way.map((x) => (reaction.sign ?? 1) * size * x), label: symbol(name).replaceAll("_", " ") },
    ];
  });
}

/** All forces of a moment. @param {Figure} figure @param {Values} values @param {Moving} motion */
export const allForces = (figure, values, motion) => [...forces(figure, values), ...reactions(figure, values, motion)];

/** The longest arrow of a motion. @param {(figure: Figure, values: Values, motion: Moving) => Arrow[]} arrows @param {Figure} figure @param {Moving} motion */
export function longest(arrows, figure, motion) {
  let most = 0;
  for (let i = 0; i <= 60; ++i) {
    const values = figure.known(motion.at(motion.start + ((motion.end - motion.start) * i) / 60));
    for (const { vector } of arrows(figure, values, motion)) most = Math.max(most, Math.hypot(...vector));
  }
  return most || 1;
}
