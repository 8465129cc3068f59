// A computed motion between its rows: each coordinate is the cubic that has the rows' values and velocities.

/** @typedef {Record<string, number>} Values */
/** @typedef {{ t: number, values: Values }} Knot */

/** @param {number} a @param {number} va @param {number} b @param {number} vb @param {number} h @param {number} s in [0, 1] */
function hermite(a, va, b, vb, h, s) {
  const u = 1 - s;
  return u * u * ((1 + 2 * s) * a + s * h * va) + s * s * ((1 + 2 * u) * b - u * h * vb);
}

/** The rate of the same cubic. @param {number} a @param {number} va @param {number} b @param {number} vb @param {number} h @param {number} s in [0, 1] */
function hermiteRate(a, va, b, vb, h, s) {
  const u = 1 - s;
  return u * (1 - 3 * s) * va + s * (3 * s - 2) * vb + (6 * s * u * (b - a)) / h;
}

/** @param {number[]} sorted @param {number} x the last index whose entry is not beyond x, at least 0 */
export function lastIndexUpTo(sorted, x) {
  let [low, high] = [0, sorted.length - 1];
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (sorted[middle] <= x) low = middle;
    else high = middle - 1;
  }
  return low;
}

export class Motion {
  /** @param {any} answer of /v1/simulate @param {string[]} coordinates */
  constructor(answer, coordinates) {
    this.answer = answer;
    this.coordinates = coordinates;
    this.columns = answer.trajectory;
    /** @type {number[]} */
    this.times = answer.trajectory.t;
    /** @type {any[]} where the state jumps */
    this.jumps = (answer.strides ?? []).filter((/** @type {any} */ jump) => jump.t <= this.end);
    this.jumpTimes = this.jumps.map((jump) => jump.t);
  }

  get start() {
    return this.times[0];
  }
  get end() {
    return this.times[this.times.length - 1];
  }

  /** @param {number} i @returns {Knot} */
  row(i) {
    /** @type {Values} */
    const values = {};
    for (const name of this.coordinates) {
      values[name] = this.columns[name][i];
      values[`${name}_dot`] = this.columns[`${name}_dot`][i];
    }
    return { t: this.times[i], values };
  }

  /** How many jumps there were up to t. @param {number} t */
  section(t) {
    return this.jumpTimes.length && t >= this.jumpTimes[0] ? lastIndexUpTo(this.jumpTimes, t) + 1 : 0;
  }

  /** Rows or jumps on both sides of t. @param {number} t @returns {[Knot, Knot]} */
  knotsAround(t) {
    const i = Math.min(lastIndexUpTo(this.times, t), this.times.length - 1);
    let left = this.row(i);
    let right = this.row(Math.min(i + 1, this.times.length - 1));
    const section = this.section(t);
    const before = this.jumps[section - 1];
    const after = this.jumps[section];
    if (before && before.t >= left.t) left = { t: before.t, values: before.state };
    if (after && after.t <= right.t) right = { t: after.t, values: after.pre_impact };
    return [left, right];
  }

  /** Coordinates, velocities and t. @param {number} t @returns {Values} */
  at(t) {
    const [left, right] = this.knotsAround(t);
    const h = right.t - left.t;
    const s = h > 0 ? Math.min(1, Math.max(0, (t - left.t) / h)) : 0;
    /** @type {Values} */
    const values = { t };
    for (const name of this.coordinates) {
      const rate = `${name}_dot`;
      const [a, va, b, vb] = [left.values[name], left.values[rate], right.values[name], right.values[rate]];
      values[name] = s === 0 ? a : s === 1 ? b : hermite(a, va, b, vb, h, s);
      values[rate] = s === 0 ? va : s === 1 ? vb : hermiteRate(a, va, b, vb, h, s);
    }
    return values;
  }

  /** A column between its rows, on a line. @param {string} name @param {number} t */
  column(name, t) {
    const i = lastIndexUpTo(this.times, t);
    const j = Math.min(i + 1, this.times.length - 1);
    const s = j > i ? (t - this.times[i]) / (this.times[j] - this.times[i]) : 0;
    return this.columns[name][i] + s * (this.columns[name][j] - this.columns[name][i]);
  }

  /** The instant at which the motion is furthest from where it starts: what to show where nothing moves. */
  tellingInstant() {
    const name = this.coordinates[0];
    const column = this.columns[name];
    let best = 0;
    for (let i = 0; i < column.length; ++i) if (Math.abs(column[i] - column[0]) > Math.abs(column[best] - column[0])) best = i;
    return this.times[best];
  }
}

/** A small oscillation about a state, for modes: q = q0 + a shape cos(omega t). */
export class ModeMotion {
  /** @param {Values} state @param {Values} shape @param {number} size @param {number} omega @param {string[]} coordinates */
  constructor(state, shape, size, omega, coordinates) {
    Object.assign(this, { jumps: [], answer: null });
    this.state = state;
    this.shape = shape;
    this.size = size;
    this.omega = omega;
    this.coordinates = coordinates;
    this.start = 0;
    this.end = omega > 0 ? ((2 * Math.PI) / omega) * 4 : 4;
  }

  section() {
    return 0;
  }

  /** @param {number} t @returns {Values} */
  at(t) {
    /** @type {Values} */
    const values = { t: 0 };
    for (const name of this.coordinates) {
      const amplitude = this.size * (this.shape[name] ?? 0);
      values[name] = (this.state[name] ?? 0) + amplitude * Math.cos(this.omega * t);
      values[`${name}_dot`] = -amplitude * this.omega * Math.sin(this.omega * t);
    }
    return values;
  }

  tellingInstant() {
    return 0;
  }
}
