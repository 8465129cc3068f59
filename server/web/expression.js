// The service's expressions (api/scenes: positions, lengths, forces), evaluated for drawing. The grammar is that of
// core/expr/parse.hpp; nothing is run as a program.

/** @typedef {Record<string, number>} Values */
/** @typedef {(values: Values) => number} Compiled */

/** @type {Record<string, (x: number) => number>} */
const functions = {
  sin: Math.sin,
  cos: Math.cos,
  tan: Math.tan,
  asin: Math.asin,
  acos: Math.acos,
  atan: Math.atan,
  sinh: Math.sinh,
  cosh: Math.cosh,
  tanh: Math.tanh,
  exp: Math.exp,
  log: Math.log,
  sqrt: Math.sqrt,
  abs: Math.abs,
  sign: Math.sign,
};
const token = /\s*(?:((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|([A-Za-z_]\w*)|(\*\*|[-+*/^()]))/y;

/** @param {string} text */
function tokensOf(text) {
  const tokens = [];
  token.lastIndex = 0;
  while (token.lastIndex < text.trimEnd().length) {
    const found = token.exec(text);
    if (!found) throw new SyntaxError(`'${text}' is not an expression.`);
    tokens.push(found[1] ?? found[2] ?? (found[3] === "**" ? "^" : found[3]));
  }
  return tokens;
}

class Reader {
  /** @param {string} text */
  constructor(text) {
    this.tokens = tokensOf(text);
    this.place = 0;
    this.depth = 0;
  }
  /** @param {string[]} wanted */
  take(...wanted) {
    const next = this.tokens[this.place];
    if (!wanted.includes(next)) return undefined;
    this.place += 1;
    return next;
  }
  /** @returns {Compiled} */
  sum() {
    if (++this.depth > 64) throw new SyntaxError("The expression is too deep.");
    let left = this.term();
    for (let sign = this.take("+", "-"); sign; sign = this.take("+", "-")) {
      const [a, b] = [left, this.term()];
      left = sign === "+" ? (v) => a(v) + b(v) : (v) => a(v) - b(v);
    }
    this.depth -= 1;
    return left;
  }
  /** @returns {Compiled} */
  term() {
    let left = this.signed();
    for (let sign = this.take("*", "/"); sign; sign = this.take("*", "/")) {
      const [a, b] = [left, this.signed()];
      left = sign === "*" ? (v) => a(v) * b(v) : (v) => a(v) / b(v);
    }
    return left;
  }
  /** @returns {Compiled} */
  signed() {
    if (this.take("+")) return this.signed();
    if (!this.take("-")) return this.power();
    const a = this.signed();
    return (v) => -a(v);
  }
  /** @returns {Compiled} */
  power() {
    const base = this.primary();
    if (!this.take("^")) return base;
    const exponent = this.signed();
    return (v) => base(v) ** exponent(v);
  }
  /** @returns {Compiled} */
  primary() {
    const next = this.tokens[this.place++];
    if (next === undefined) throw new SyntaxError("The expression ends too early.");
    if (/^[\d.]/.test(next))
      return (
        (value) => () =>
          value
      )(Number(next));
    if (next === "(") return this.closed(this.sum());
    if (Object.hasOwn(functions, next) && this.take("(")) {
      const [call, argument] = [functions[next], this.closed(this.sum())];
      return (v) => call(argument(v));
    }
    if (next === "pi") return () => Math.PI;
    if (!/^[A-Za-z_]/.test(next)) throw new SyntaxError(`'${next}' is not expected here.`);
    return (v) => (Object.hasOwn(v, next) ? v[next] : next === "deg" ? Math.PI / 180 : NaN);
  }
  /** @param {Compiled} inside */
  closed(inside) {
    if (!this.take(")")) throw new SyntaxError("A bracket is not closed.");
    return inside;
  }
}

/** A function of the values of its names; NaN where a name has none. @param {string | number} text @returns {Compiled} */
export function compile(text) {
  const reader = new Reader(String(text));
  const compiled = reader.sum();
  if (reader.place < reader.tokens.length) throw new SyntaxError(`'${reader.tokens[reader.place]}' is not expected here.`);
  return compiled;
}

/** As `compile`, but what cannot be read is NaN: while someone types, a drawing waits. @param {string | number | undefined} text @returns {Compiled} */
export function compiled(text) {
  if (text === undefined || text === "") return () => 0;
  try {
    return compile(text);
  } catch {
    return () => NaN;
  }
}
