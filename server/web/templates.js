// Scenes to begin with, one idea each.

const gravity = { name: "g", unit: "m/s^2", default: "9.81", domain: ">= 0", meaning: "gravitational acceleration" };
const mass = { name: "m", unit: "kg", default: "0.5", domain: "> 0", meaning: "mass" };
const length = { name: "l", unit: "m", default: "0.5", domain: "> 0", meaning: "length" };

/** @type {Record<string, any>} */
export const templates = {
  Pendulum: {
    name: "pendulum",
    title: "Pendulum",
    parameters: [mass, length, gravity],
    coordinates: [{ name: "theta", unit: "rad", initial: "1", meaning: "angle from the downward vertical" }],
    points: [
      { name: "pivot", components: ["0", "0"] },
      { name: "bob", components: ["l*sin(theta)", "-l*cos(theta)"] },
    ],
    bodies: [{ kind: "particle", mass: "m", position: "bob" }],
    gravity: ["0", "-g"],
    lines: [["pivot", "bob"]],
  },
  "Bead on a rotating hoop": {
    name: "bead_on_hoop",
    title: "Bead on a rotating hoop",
    parameters: [
      mass,
      { name: "r", unit: "m", default: "0.3", domain: "> 0", meaning: "radius of the hoop" },
      { name: "Omega", unit: "rad/s", default: "1.2*sqrt(g/r)", meaning: "rate of the hoop" },
      gravity,
    ],
    coordinates: [{ name: "theta", unit: "rad", initial: "0.1", meaning: "angle from the lowest point" }],
    points: [
      { name: "centre", components: ["0", "0", "0"] },
      { name: "bead", components: ["r*sin(theta)*cos(Omega*t)", "r*sin(theta)*sin(Omega*t)", "-r*cos(theta)"] },
    ],
    bodies: [{ kind: "particle", mass: "m", position: "bead" }],
    gravity: ["0", "0", "-g"],
    lines: [["centre", "bead"]],
  },
  "Sliding ladder": {
    name: "sliding_ladder",
    title: "Ladder that slides down a wall",
    parameters: [{ ...mass, default: "8" }, { ...length, default: "3" }, gravity],
    coordinates: [{ name: "theta", unit: "rad", initial: "0.1", meaning: "angle from the wall" }],
    points: [
      { name: "top", components: ["0", "l*cos(theta)"] },
      { name: "foot", components: ["l*sin(theta)", "0"] },
    ],
    bodies: [{ kind: "rod", mass: "m", start: "top", end: "foot" }],
    gravity: ["0", "-g"],
    valid_while: [
      { name: "height", unit: "1", expression: "cos(theta)", reason: "on_the_floor", message: "The ladder lies on the floor." },
    ],
  },
  "Two masses, three springs": {
    name: "two_masses",
    title: "Two masses between three springs",
    parameters: [
      mass,
      { name: "k", unit: "N/m", default: "20", domain: ">= 0", meaning: "stiffness of each spring" },
      { name: "a", unit: "m", default: "0.4", domain: "> 0", meaning: "distance at rest" },
    ],
    coordinates: [
      { name: "x", unit: "m", initial: "0.1", meaning: "displacement of the first mass" },
      { name: "y", unit: "m", initial: "0", meaning: "displacement of the second mass" },
    ],
    points: [
      { name: "left", components: ["0", "0"] },
      { name: "first", components: ["a + x", "0"] },
      { name: "second", components: ["2*a + y", "0"] },
      { name: "right", components: ["3*a", "0"] },
    ],
    bodies: [
      { kind: "particle", mass: "m", position: "first" },
      { kind: "particle", mass: "m", position: "second" },
    ],
    springs: [
      { stiffness: "k", length: "x", rest_length: "0" },
      { stiffness: "k", length: "y - x", rest_length: "0" },
      { stiffness: "k", length: "y", rest_length: "0" },
    ],
    lines: [["left", "first", "second", "right"]],
  },
  "Double pendulum with friction": {
    name: "double_pendulum",
    title: "Double pendulum with friction",
    parameters: [
      mass,
      length,
      { name: "c", unit: "N*m*s", default: "0.005", domain: ">= 0", meaning: "friction in the pivots" },
      gravity,
    ],
    coordinates: [
      { name: "alpha", unit: "rad", initial: "2", meaning: "upper angle" },
      { name: "beta", unit: "rad", initial: "2.5", meaning: "lower angle" },
    ],
    points: [
      { name: "pivot", components: ["0", "0"] },
      { name: "upper", components: ["l*sin(alpha)", "-l*cos(alpha)"] },
      { name: "lower", components: ["l*sin(alpha) + l*sin(beta)", "-l*cos(alpha) - l*cos(beta)"] },
    ],
    bodies: [
      { kind: "particle", mass: "m", position: "upper" },
      { kind: "particle", mass: "m", position: "lower" },
    ],
    gravity: ["0", "-g"],
    dissipation: "c/2*(alpha_dot^2 + (beta_dot - alpha_dot)^2)",
    lines: [["pivot", "upper", "lower"]],
  },
};

/** Short values stay on one line, as one writes by hand. @param {any} value @param {string} [indent] @returns {string} */
export function written(value, indent = "") {
  const flat = JSON.stringify(value, null, 1)
    .replace(/\n\s*/g, " ")
    .replaceAll("{ ", "{")
    .replaceAll(" }", "}")
    .replaceAll("[ ", "[")
    .replaceAll(" ]", "]");
  if (typeof value !== "object" || value === null || (indent && indent.length + flat.length < 130)) return flat;
  const inner = indent + "  ";
  if (Array.isArray(value)) return `[\n${value.map((one) => inner + written(one, inner)).join(",\n")}\n${indent}]`;
  return `{\n${Object.entries(value)
    .map(([key, one]) => `${inner}${JSON.stringify(key)}: ${written(one, inner)}`)
    .join(",\n")}\n${indent}}`;
}
