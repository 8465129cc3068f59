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

/** The longest arrow of a motion. @param {(figure: Figure, values: Values) => Arrow[]} arrows @param {Figure} figure @param {Moving} motion */
export function longest(arrows, figure, motion) {
  let most = 0;
  for (let i = 0; i <= 60; ++i) {
    const values = figure.known(motion.at(motion.start + ((motion.end - motion.start) * i) / 60));
    for (const { vector } of arrows(figure, values)) most = Math.max(most, Math.hypot(...vector));
  }
  return most || 1;
}
