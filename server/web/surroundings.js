// What a scene does not say but stands in: the wall of a spring, the ground that is hit, the vertical in space.

/** @typedef {import("./figure.js").Figure} Figure */
/** @typedef {import("./camera.js").Camera} Camera */
/** @typedef {import("./camera.js").Moving} Moving */
/** @typedef {import("./painter.js").Painter} Painter */

/** The wall of a horizontal spring stands clear of everything. @param {Figure} figure @param {Moving} motion */
export function placeWall(figure, motion) {
  const wall = /** @type {{ axis: number, place: number }} */ (figure.wall);
  let [low, high] = [Infinity, -Infinity];
  for (let i = 0; i <= 200; ++i) {
    const values = figure.known(motion.at(motion.start + ((motion.end - motion.start) * i) / 200));
    for (const mass of figure.masses) {
      low = Math.min(low, mass.at(values)[wall.axis]);
      high = Math.max(high, mass.at(values)[wall.axis]);
    }
  }
  wall.place = low - Math.max(0.6 * (high - low), 0.15);
}

/** Bodies that are on y = 0 whenever the state jumps have hit the ground. @param {Figure} figure @param {Moving} motion @param {Camera} camera */
export function hasGround(figure, motion, camera) {
  if (figure.dimension !== 2 || !motion.jumps.length) return false;
  const size = camera.seen.reduce((most, p) => Math.max(most, Math.abs(p[1])), 0);
  return motion.jumps.every((jump) => {
    const values = figure.known({ t: jump.t, ...jump.pre_impact });
    return figure.masses.some((mass) => Math.abs(mass.at(values)[1]) < 1e-6 * size);
  });
}

/** @param {Painter} painter @param {Camera} camera */
export function drawGround(painter, camera) {
  const reach = (2 * camera.size[0]) / camera.scale;
  const middle = camera.unproject(camera.size[0] / 2, camera.size[1] / 2)[0];
  painter.hatched(camera.project([middle - reach, 0]), camera.project([middle + reach, 0]));
}

/** The vertical through the support, and the circle that the motion keeps in. @param {Painter} painter @param {Camera} camera */
export function drawAxis(painter, camera) {
  const { figure } = camera;
  const foot = figure.supports[0](figure.samples[0]);
  const low = camera.seen.reduce((least, p) => Math.min(least, p[2]), foot[2]);
  const radius = camera.seen.reduce((most, p) => Math.max(most, Math.hypot(p[0] - foot[0], p[1] - foot[1])), 0);
  const circle = Array.from({ length: 61 }, (_, i) => {
    const angle = (2 * Math.PI * i) / 60;
    return camera.project([foot[0] + radius * Math.cos(angle), foot[1] + radius * Math.sin(angle), low]);
  });
  painter.path(circle, painter.colours.line, 1);
  painter.path([camera.project([foot[0], foot[1], low]), camera.project(foot)], painter.colours.line, 3);
}
