// What a plot puts on its surface beside lines: markers, names at the ends of curves; and fewer points where a pixel has many.

/** @typedef {import("./surface.js").CanvasSurface | import("./surface.js").SvgSurface} Surface */
/** @typedef {import("./plot.js").Series} Series */
/** @typedef {import("./axis.js").Axis} Axis */

/** @param {Series} series @param {Axis} horizontal @param {Axis} vertical @returns {number[][]} */
export function pixels({ x, y }, horizontal, vertical) {
  return Array.from({ length: x.length }, (_, i) => [horizontal.pixel(x[i]), vertical.pixel(y[i])]);
}

/** Many rows a pixel become the first, the least, the greatest and the last of them. @param {number[][]} points @param {number} width */
export function thinned(points, width) {
  if (points.length < 4 * width) return points;
  const fewer = [];
  for (let i = 0; i < points.length;) {
    const column = Math.floor(points[i][0]);
    let [low, high, j] = [points[i], points[i], i];
    for (; j < points.length && Math.floor(points[j][0]) === column; ++j) {
      if (points[j][1] < low[1]) low = points[j];
      if (points[j][1] > high[1]) high = points[j];
    }
    fewer.push(points[i], low, high, points[j - 1]);
    i = j;
  }
  return fewer;
}

/** @param {Surface} surface @param {number[]} at @param {string} marker @param {string} colour */
export function drawMarker(surface, [x, y], marker, colour) {
  const around = (/** @type {number} */ count, /** @type {number} */ r, /** @type {number} */ turn) =>
    Array.from({ length: count }, (_, i) => [
      x + r * Math.sin(turn + (2 * Math.PI * i) / count),
      y - r * Math.cos(turn + (2 * Math.PI * i) / count),
    ]);
  if (marker === "ring") {
    const ring = around(24, 7, 0);
    surface.line([...ring, ring[0]], { colour, width: 2 });
  } else if (marker === "cross") {
    surface.line(
      [
        [x - 4, y - 4],
        [x + 4, y + 4],
      ],
      { colour, width: 2 },
    );
    surface.line(
      [
        [x - 4, y + 4],
        [x + 4, y - 4],
      ],
      { colour, width: 2 },
    );
  } else if (marker === "square") surface.area(around(4, 5, Math.PI / 4), colour, 1);
  else if (marker === "diamond") surface.area(around(4, 5.5, 0), colour, 1);
  else if (marker === "triangle") surface.area(around(3, 5.5, 0), colour, 1);
  else surface.area(around(16, 4, 0), colour, 1);
}
