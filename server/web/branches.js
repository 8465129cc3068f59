// Branches of equilibria or gaits, as a diagram draws them.

/** @typedef {{ stability: string, x: number[], y: number[] }} Piece */

/** Pieces of a branch with one stability each; a piece ends at the critical value where there is one. @param {any} branch @param {string} parameter @param {string} column @param {any[]} critical @returns {Piece[]} */
export function pieces(branch, parameter, column, critical) {
  /** @type {Piece[]} */
  const found = [];
  branch.stability.forEach((/** @type {string} */ stability, /** @type {number} */ i) => {
    const [x, y] = [branch[parameter][i], branch[column][i]];
    const last = found[found.length - 1];
    const [before, above] = last ? [last.x[last.x.length - 1], last.y[last.y.length - 1]] : [x, y];
    const turns = Math.abs(y - above) > 3; // an angle that goes round
    if (last && last.stability === stability && !turns) {
      last.x.push(x);
      last.y.push(y);
      return;
    }
    const between = critical.find(
      (one) =>
        Math.min(before, x) <= one.value &&
        one.value <= Math.max(before, x) &&
        one.state?.[column] !== undefined &&
        Math.abs(one.state[column] - y) <= Math.abs(above - y) + 1e-9,
    );
    const [meetX, meetY] = between ? [between.value, between.state[column]] : [x, y];
    if (last && !turns) {
      last.x.push(meetX);
      last.y.push(meetY);
    }
    found.push({ stability, x: last && !turns ? [meetX, x] : [x], y: last && !turns ? [meetY, y] : [y] });
  });
  return found;
}

/** The columns in which the branches differ; where none does, the first. @param {any} answer @param {string[]} coordinates @returns {string[]} */
export function tellingColumns(answer, coordinates) {
  const present = coordinates.filter((name) => answer.branches?.[0]?.[name]);
  const varies = (/** @type {string} */ name) => {
    const all = answer.branches.flatMap((/** @type {any} */ branch) => branch[name]);
    return all.some((/** @type {number} */ value) => Math.abs(value - all[0]) > 1e-9 * (1 + Math.abs(value)));
  };
  const telling = present.filter(varies);
  return telling.length ? telling : present.slice(0, 1);
}
