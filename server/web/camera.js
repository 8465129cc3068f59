// Where the world is on the canvas. The window holds the whole motion before it plays, so that nothing jumps.

/** @typedef {import("./figure.js").Figure} Figure */
/** @typedef {import("./motion.js").Values} Values */
/** @typedef {{ start: number, end: number, jumps: any[], at: (t: number) => Values, section: (t: number) => number, columns?: Record<string, number[]>, column?: (name: string, t: number) => number }} Moving */

/** How far each jump moves the frame of a scene: the centre of mass stays. @param {Figure} figure @param {Moving} motion @returns {number[][]} */
export function frameOffsets(figure, motion) {
  const offsets = [Array(figure.dimension).fill(0)];
  for (const jump of motion.jumps) {
    const before = figure.centre(figure.known({ t: jump.t, ...jump.pre_impact }));
    const after = figure.centre(figure.known({ t: jump.t, ...jump.state }));
    const last = offsets[offsets.length - 1];
    offsets.push(last.map((x, i) => x + before[i] - after[i]));
  }
  return offsets;
}

export class Camera {
  /** @param {Figure} figure */
  constructor(figure) {
    this.figure = figure;
    this.azimuth = -0.6;
    this.elevation = 0.35;
    this.scale = 1;
    this.middle = [0, 0, 0];
    this.turn = 0;
    this.size = [1, 1];
    /** @type {number[][]} flat points that must be seen */
    this.seen = [];
    const [x = 0, y = 0] = figure.gravity;
    if (figure.dimension === 2 && Math.hypot(x, y) > 0) this.turn = -Math.PI / 2 - Math.atan2(y, x);
  }

  /** World to the plane of the picture, in metres; the third number is nearness. @param {number[]} p @returns {number[]} */
  flat(p) {
    if (p.length < 3) {
      const [c, s] = [Math.cos(this.turn), Math.sin(this.turn)];
      return [c * p[0] - s * p[1], s * p[0] + c * p[1], 0];
    }
    const [c, s, ce, se] = [Math.cos(this.azimuth), Math.sin(this.azimuth), Math.cos(this.elevation), Math.sin(this.elevation)];
    const ahead = c * p[0] + s * p[1];
    return [-s * p[0] + c * p[1], ce * p[2] - se * ahead, ce * ahead + se * p[2]];
  }

  /** @param {number[]} p @returns {number[]} pixels right and down, and nearness in metres */
  project(p) {
    const [x, y, near] = this.flat(p);
    return [this.size[0] / 2 + (x - this.middle[0]) * this.scale, this.size[1] / 2 - (y - this.middle[1]) * this.scale, near];
  }

  /** The place in the plane that is drawn at a pixel. @param {number} x @param {number} y */
  unproject(x, y) {
    const flat = [(x - this.size[0] / 2) / this.scale + this.middle[0], (this.size[1] / 2 - y) / this.scale + this.middle[1]];
    const [c, s] = [Math.cos(this.turn), Math.sin(this.turn)];
    return [c * flat[0] + s * flat[1], -s * flat[0] + c * flat[1]];
  }

  /** Notes everything that the motion reaches. @param {Moving} motion @param {number[][]} offsets */
  watch(motion, offsets) {
    const { figure } = this;
    this.seen = [];
    const count = Math.min(400, Math.max(2, Math.ceil((motion.end - motion.start) * 40)));
    for (let i = 0; i <= count; ++i) {
      const t = motion.start + ((motion.end - motion.start) * i) / count;
      const values = figure.known(motion.at(t));
      const offset = offsets[motion.section(t)];
      this.see(values, offset);
    }
  }

  /** @param {Values} values @param {number[]} offset */
  see(values, offset) {
    const { figure } = this;
    for (const place of figure.places) this.seen.push(place(values).map((x, i) => x + (offset[i] ?? 0)));
    for (const segment of figure.segments) this.seen.push(segment.from(values).map((x, i) => x + (offset[i] ?? 0)));
    for (const place of figure.solids.flatMap((solid) => solid.lines.flat())) {
      this.seen.push(place(values).map((x, i) => x + (offset[i] ?? 0)));
    }
    for (const disk of figure.disks) {
      const [centre, r] = [disk.centre(values), disk.radius(values)];
      this.seen.push([centre[0] - r, centre[1] - r], [centre[0] + r, centre[1] + r]);
    }
  }

  /** Chooses scale and middle for a canvas of this many pixels. @param {number} width @param {number} height */
  fit(width, height) {
    this.size = [width, height];
    const points = this.seen.filter((p) => p.every(Number.isFinite));
    if (!points.length) return;
    const [low, high] = this.figure.dimension === 3 ? this.sphere(points) : this.box(points);
    const room = [Math.max(high[0] - low[0], 1e-9), Math.max(high[1] - low[1], 1e-9)];
    const margin = Math.min(width, height) * 0.12 + 12;
    this.scale = Math.min((width - 2 * margin) / room[0], (height - 2 * margin) / room[1], (height * 5) / Math.max(...room));
    this.middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, 0];
  }

  /** @param {number[][]} points */
  box(points) {
    const flat = points.map((p) => this.flat(p));
    const of = (/** @type {number} */ i) => flat.map((p) => p[i]);
    return [[0, 1].map((i) => of(i).reduce((a, b) => Math.min(a, b))), [0, 1].map((i) => of(i).reduce((a, b) => Math.max(a, b)))];
  }

  /** In space the window holds the motion however it is turned about the vertical. @param {number[][]} points */
  sphere(points) {
    const radius = points.reduce((most, p) => Math.max(most, Math.hypot(p[0], p[1])), 0);
    const heights = points.map((p) => p[2]);
    const [bottom, top] = [heights.reduce((a, b) => Math.min(a, b)), heights.reduce((a, b) => Math.max(a, b))];
    const [ce, se] = [Math.cos(this.elevation), Math.abs(Math.sin(this.elevation))];
    return [
      [-radius, ce * bottom - se * radius],
      [radius, ce * top + se * radius],
    ];
  }
}
