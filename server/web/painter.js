// The signs of mechanics on a canvas: hatched supports, rods with a thickness, coils, strings, disks and masses.

/** @typedef {number[]} Pixel */

/** The page's colours, which follow its theme. */
export function palette() {
  const style = getComputedStyle(document.documentElement);
  const data = ["blue", "vermillion", "green", "purple", "orange", "sky"];
  const names = ["ink", "soft", "line", "paper", ...data, ...data.map((name) => `${name}-text`)];
  return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

export class Painter {
  /** @param {CanvasRenderingContext2D} context @param {Record<string, string>} colours */
  constructor(context, colours) {
    this.context = context;
    this.colours = colours;
  }

  /** @param {Pixel[]} points @param {string} colour @param {number} width @param {number[]} [dash] */
  path(points, colour, width, dash = []) {
    const { context } = this;
    context.beginPath();
    points.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.lineCap = "round";
    context.lineJoin = "round";
    context.setLineDash(dash);
    context.stroke();
    context.setLineDash([]);
  }

  /** @param {Pixel} a @param {Pixel} b @param {number} thickness */
  rod(a, b, thickness) {
    this.path([a, b], this.colours.ink, thickness);
    this.path([a, b], this.colours.soft, Math.max(1, thickness - 3));
  }

  /** The number of turns stays; their pitch changes. @param {Pixel} a @param {Pixel} b @param {number} radius */
  spring(a, b, radius) {
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (length < 1) return;
    const [ux, uy] = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    const [turns, lead] = [9, Math.min(0.12 * length, 10)];
    /** @type {Pixel[]} */
    const points = [a];
    for (let i = 0; i <= turns * 16; ++i) {
      const along = lead + ((length - 2 * lead) * i) / (turns * 16);
      const across = radius * Math.sin((2 * Math.PI * i) / 16);
      points.push([a[0] + ux * along - uy * across, a[1] + uy * along + ux * across]);
    }
    this.path([...points, b], this.colours.ink, 1.4);
  }

  /** Straight while it pulls, curved when it does not. @param {Pixel} a @param {Pixel} b @param {boolean} slack */
  string(a, b, slack) {
    if (!slack) return this.path([a, b], this.colours.ink, 1.2);
    const sag = 0.25 * Math.hypot(b[0] - a[0], b[1] - a[1]);
    const points = Array.from({ length: 21 }, (_, i) => {
      const s = i / 20;
      return [a[0] + s * (b[0] - a[0]) + sag * s * (1 - s) * 2, a[1] + s * (b[1] - a[1]) + sag * s * (1 - s) * 4];
    });
    return this.path(points, this.colours.ink, 1.2);
  }

  /** @param {Pixel} at @param {number} radius @param {string} [colour] */
  mass(at, radius, colour = this.colours.blue) {
    const { context } = this;
    context.beginPath();
    context.arc(at[0], at[1], radius, 0, 2 * Math.PI);
    context.fillStyle = colour;
    context.fill();
    context.strokeStyle = this.colours.paper;
    context.lineWidth = 1.5;
    context.stroke();
  }

  /** Its radius shows how it turns. @param {Pixel} centre @param {number} radius @param {number} angle */
  disk(centre, radius, angle) {
    const { context } = this;
    context.beginPath();
    context.arc(centre[0], centre[1], radius, 0, 2 * Math.PI);
    context.fillStyle = this.colours.blue;
    context.globalAlpha = 0.18;
    context.fill();
    context.globalAlpha = 1;
    context.strokeStyle = this.colours.blue;
    context.lineWidth = 2;
    context.stroke();
    this.path([centre, [centre[0] + radius * Math.cos(angle), centre[1] - radius * Math.sin(angle)]], this.colours.blue, 1.5);
    this.mass(centre, 2.5);
  }

  /** A line with hatching on its right. @param {Pixel} a @param {Pixel} b */
  hatched(a, b) {
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const [ux, uy] = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    for (let along = 3; along < length; along += 7) {
      const foot = [a[0] + ux * along, a[1] + uy * along];
      this.path([foot, [foot[0] - 5 * ux - 6 * uy, foot[1] - 5 * uy + 6 * ux]], this.colours.soft, 0.8);
    }
    this.path([a, b], this.colours.ink, 1.5);
  }

  /** @param {Pixel} at @param {"ceiling" | "pin" | "wall"} kind */
  support(at, kind) {
    const [x, y] = at;
    if (kind === "ceiling") this.hatched([x + 22, y], [x - 22, y]);
    if (kind === "wall") this.hatched([x, y - 26], [x, y + 26]);
    this.ring(at);
  }

  /** @param {Pixel} at */
  ring(at) {
    const { context } = this;
    context.beginPath();
    context.arc(at[0], at[1], 3.5, 0, 2 * Math.PI);
    context.fillStyle = this.colours.paper;
    context.fill();
    context.strokeStyle = this.colours.ink;
    context.lineWidth = 1.5;
    context.stroke();
  }

  /** @param {Pixel} from @param {Pixel} to @param {string} colour @param {string} [label] */
  arrow(from, to, colour, label = "") {
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    if (length < 2) return;
    const [ux, uy] = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
    const head = Math.min(8, length / 2);
    this.path([from, to], colour, 2);
    this.path(
      [
        [to[0] - head * (ux - 0.5 * uy), to[1] - head * (uy + 0.5 * ux)],
        to,
        [to[0] - head * (ux + 0.5 * uy), to[1] - head * (uy - 0.5 * ux)],
      ],
      colour,
      2,
    );
    if (label) this.text(label, [to[0] + 9 * ux, to[1] + 9 * uy], colour);
  }

  /** Older parts are fainter. @param {Pixel[]} points @param {string} colour */
  trail(points, colour) {
    const chunk = Math.max(1, Math.ceil(points.length / 12));
    for (let i = 0; i < points.length - 1; i += chunk) {
      this.context.globalAlpha = 0.08 + (0.5 * (i + chunk)) / points.length;
      this.path(points.slice(i, i + chunk + 1), colour, 1.5);
    }
    this.context.globalAlpha = 1;
  }

  /** @param {string} text @param {Pixel} at @param {string} [colour] @param {number} [size] */
  text(text, at, colour = this.colours.ink, size = 14) {
    const { context } = this;
    context.font = `italic ${size}px Georgia, "Times New Roman", "DejaVu Serif", serif`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineWidth = 4;
    context.strokeStyle = this.colours.paper;
    context.strokeText(text, at[0], at[1]);
    context.fillStyle = colour;
    context.fillText(text, at[0], at[1]);
  }
}
