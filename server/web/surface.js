// What a plot is drawn on: a canvas, or an SVG file. Both know the same four strokes.

/** @typedef {{ colour: string, width?: number, dash?: number[], alpha?: number }} Stroke */
/** @typedef {{ colour: string, size?: number, align?: "left" | "center" | "right", turned?: boolean, alpha?: number }} Lettering */

const family = 'system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';

export class CanvasSurface {
  /** @param {CanvasRenderingContext2D} context */
  constructor(context) {
    this.context = context;
  }

  /** @param {number[][]} points @param {Stroke} stroke */
  line(points, { colour, width = 1, dash = [], alpha = 1 }) {
    const { context } = this;
    context.globalAlpha = alpha;
    context.beginPath();
    let isDown = false;
    for (const [x, y] of points) {
      if (!Number.isFinite(y)) isDown = false;
      else if (isDown) context.lineTo(x, y);
      else {
        context.moveTo(x, y);
        isDown = true;
      }
    }
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.lineJoin = "round";
    context.setLineDash(dash);
    context.stroke();
    context.setLineDash([]);
    context.globalAlpha = 1;
  }

  /** @param {number[][]} points @param {string} colour @param {number} alpha */
  area(points, colour, alpha) {
    const { context } = this;
    context.globalAlpha = alpha;
    context.beginPath();
    for (const [x, y] of points) context.lineTo(x, y);
    context.closePath();
    context.fillStyle = colour;
    context.fill();
    context.globalAlpha = 1;
  }

  /** @param {string} text @param {number[]} at @param {Lettering} lettering */
  text(text, [x, y], { colour, size = 12, align = "left", turned = false, alpha = 1 }) {
    const { context } = this;
    context.save();
    context.globalAlpha = alpha;
    context.translate(x, y);
    if (turned) context.rotate(-Math.PI / 2);
    context.font = `${size}px ${family}`;
    context.textAlign = align;
    context.textBaseline = "middle";
    context.fillStyle = colour;
    context.fillText(text, 0, 0);
    context.restore();
  }

  /** Draws inside a box only. @param {number} x @param {number} y @param {number} width @param {number} height @param {() => void} draw */
  clipped(x, y, width, height, draw) {
    this.context.save();
    this.context.beginPath();
    this.context.rect(x, y, width, height);
    this.context.clip();
    draw();
    this.context.restore();
  }
}

/** @param {string} text */
const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;");
/** @param {number} x */
const two = (x) => x.toFixed(2);

export class SvgSurface {
  constructor() {
    /** @type {string[]} */
    this.parts = [];
    this.clips = 0;
  }

  /** @param {number[][]} points @param {Stroke} stroke */
  line(points, { colour, width = 1, dash = [], alpha = 1 }) {
    let path = "";
    let isDown = false;
    for (const [x, y] of points) {
      if (!Number.isFinite(y)) {
        isDown = false;
        continue;
      }
      path += `${isDown ? "L" : "M"}${two(x)} ${two(y)}`;
      isDown = true;
    }
    this.parts.push(
      `<path d="${path}" fill="none" stroke="${escaped(colour)}" stroke-width="${width}" stroke-opacity="${alpha}" stroke-dasharray="${dash.join(" ")}" stroke-linejoin="round"/>`,
    );
  }

  /** @param {number[][]} points @param {string} colour @param {number} alpha */
  area(points, colour, alpha) {
    this.parts.push(
      `<polygon points="${points.map(([x, y]) => `${two(x)},${two(y)}`).join(" ")}" fill="${escaped(colour)}" fill-opacity="${alpha}"/>`,
    );
  }

  /** @param {string} text @param {number[]} at @param {Lettering} lettering */
  text(text, [x, y], { colour, size = 12, align = "left", turned = false, alpha = 1 }) {
    const anchor = { left: "start", center: "middle", right: "end" }[align];
    const turn = turned ? ` transform="rotate(-90 ${two(x)} ${two(y)})"` : "";
    this.parts.push(
      `<text x="${two(x)}" y="${two(y)}" dy="0.35em" font-size="${size}" text-anchor="${anchor}" fill="${escaped(colour)}" fill-opacity="${alpha}"${turn}>${escaped(text)}</text>`,
    );
  }

  /** @param {number} x @param {number} y @param {number} width @param {number} height @param {() => void} draw */
  clipped(x, y, width, height, draw) {
    const id = `clip${++this.clips}`;
    this.parts.push(
      `<clipPath id="${id}"><rect x="${two(x)}" y="${two(y)}" width="${two(width)}" height="${two(height)}"/></clipPath><g clip-path="url(#${id})">`,
    );
    draw();
    this.parts.push("</g>");
  }

  /** @param {number} width @param {number} height @param {string} paper */
  file(width, height, paper) {
    return (
      `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="${escaped(family)}">` +
      `<rect width="100%" height="100%" fill="${escaped(paper)}"/>${this.parts.join("")}</svg>`
    );
  }
}
