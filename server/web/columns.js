// The columns of a motion, and which part of an answer has them.

/** @typedef {import("./subject.js").Subject} Subject */
/** @typedef {import("./motion.js").Motion} Motion */

/** @param {any} scene */
function conditionsOf(scene) {
  return [...(scene.valid_while ?? []), ...(scene.reports ?? [])].map((/** @type {any} */ one) => one.name);
}

/** Every column that can be shown. @param {Subject} subject @returns {string[]} */
export function allColumns({ scene, coordinates, velocities, parameters }) {
  const names = [
    ...coordinates,
    ...velocities,
    ...coordinates.map((/** @type {string} */ q) => `${q}_ddot`),
    ...coordinates.map((/** @type {string} */ q) => `p_${q}`),
    "energy",
    ...conditionsOf(scene),
  ];
  const energies = scene.lagrangian ? [] : ["T", "V"]; // a Lagrangian alone does not tell which is which
  return [...names, ...energies.filter((name) => !names.includes(name) && !parameters.includes(name))];
}

/** Which part of an answer has the column. @param {string} name @param {any} scene @returns {string | null} */
export function includeOf(name, scene) {
  if (name === "energy" || name === "T" || name === "V") return name;
  if (name.startsWith("p_")) return "momenta";
  if (name.endsWith("_ddot")) return "accelerations";
  return conditionsOf(scene).includes(name) ? "validity" : null;
}

/** When a column jumps: a coordinate may go on smoothly through an impact that turns its rate. @param {any} answer @param {string} name @returns {number[]} */
export function jumpTimes(answer, name) {
  return (answer.strides ?? [])
    .filter((/** @type {any} */ one) => !(name in one.state) || one.state[name] !== one.pre_impact[name])
    .map((/** @type {any} */ one) => one.t);
}

/** A curve is broken where the state jumps. @param {number[]} times @param {number[]} column @param {number[]} jumps */
export function broken(times, column, jumps) {
  if (!jumps.length) return { x: times, y: column };
  /** @type {number[]} */
  const x = [];
  /** @type {number[]} */
  const y = [];
  times.forEach((t, i) => {
    if (i && jumps.some((jump) => jump > times[i - 1] && jump <= t)) {
      x.push(t);
      y.push(NaN);
    }
    x.push(t);
    y.push(column[i]);
  });
  return { x, y };
}

/** A state's value between the rows: coordinates and rates of the cubic through them, other columns on a line. @param {Motion} motion @param {string} name @param {number} t */
export function valueAt(motion, name, t) {
  const state = motion.at(Math.min(motion.end, Math.max(motion.start, t)));
  return name in state ? state[name] : motion.column(name, t);
}
