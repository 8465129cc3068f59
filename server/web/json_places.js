// Where each value of a JSON text stands, by its pointer, so that a message can be shown where it belongs.

/** @typedef {{ start: number, end: number, keyStart?: number }} Place */

/** What breaks the grammar, and where. */
export class TextMistake extends Error {
  /** @param {string} message @param {number} offset */
  constructor(message, offset) {
    super(message);
    this.offset = offset;
  }
}

const literal = /(?:true|false|null|-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)(?![\w.])/y;
const string = /"(?:[^"\\\u0000-\u001f]|\\(?:["\\/bfnrt]|u[0-9a-fA-F]{4}))*"/y;

class Scanner {
  /** @param {string} text */
  constructor(text) {
    this.text = text;
    this.offset = 0;
    /** @type {Map<string, Place>} */
    this.places = new Map();
  }

  space() {
    while (/\s/.test(this.text[this.offset] ?? "")) this.offset += 1;
  }

  /** @param {string} mark */
  take(mark) {
    this.space();
    if (this.text[this.offset] !== mark) return false;
    this.offset += 1;
    return true;
  }

  /** @param {RegExp} pattern @param {string} wanted */
  match(pattern, wanted) {
    this.space();
    pattern.lastIndex = this.offset;
    const found = pattern.exec(this.text);
    if (!found) throw new TextMistake(this.complaint(wanted), this.offset);
    this.offset = pattern.lastIndex;
    return found[0];
  }

  /** @param {string} wanted */
  complaint(wanted) {
    const here = this.text[this.offset];
    if (here === undefined) return `The text ends where ${wanted} should be.`;
    if (here === "'") return "JSON has double quotes.";
    if (here === "/") return "JSON has no comments.";
    if (here === "}" || here === "]") return "A comma too many, or something is missing here.";
    const word = /^[\p{L}_][\w.-]*/u.exec(this.text.slice(this.offset, this.offset + 40))?.[0];
    if (word) return `A text stands in double quotes: "${word}".`;
    return `Here should be ${wanted}.`;
  }

  /** @param {string} pointer @param {number} depth @param {number} [keyStart] */
  value(pointer, depth, keyStart) {
    if (depth > 60) throw new TextMistake("This is too deep.", this.offset);
    this.space();
    const start = this.offset;
    const first = this.text[start];
    if (first === "{") this.object(pointer, depth);
    else if (first === "[") this.array(pointer, depth);
    else if (first === '"') this.match(string, "a text in double quotes");
    else this.match(literal, "a value");
    this.places.set(pointer, { start, end: this.offset, keyStart });
  }

  /** @param {string} pointer @param {number} depth */
  object(pointer, depth) {
    this.take("{");
    if (this.take("}")) return;
    do {
      this.space();
      const keyStart = this.offset;
      const key = JSON.parse(this.match(string, "a name in double quotes"));
      if (!this.take(":")) throw new TextMistake("A colon is missing.", this.offset);
      this.value(`${pointer}/${key.replaceAll("~", "~0").replaceAll("/", "~1")}`, depth + 1, keyStart);
    } while (this.take(","));
    if (!this.take("}")) throw new TextMistake("A comma or } is missing.", this.offset);
  }

  /** @param {string} pointer @param {number} depth */
  array(pointer, depth) {
    this.take("[");
    if (this.take("]")) return;
    let index = 0;
    do this.value(`${pointer}/${index++}`, depth + 1);
    while (this.take(","));
    if (!this.take("]")) throw new TextMistake("A comma or ] is missing.", this.offset);
  }
}

/** The places of all values; throws TextMistake. @param {string} text @returns {Map<string, Place>} */
export function placesIn(text) {
  const scanner = new Scanner(text);
  scanner.value("", 0);
  scanner.space();
  if (scanner.offset < text.length) throw new TextMistake("There is more after the end.", scanner.offset);
  return scanner.places;
}

/** The place that a pointer names, or that of what is around it. @param {Map<string, Place>} places @param {string} pointer @returns {Place} */
export function nearest(places, pointer) {
  for (let place = pointer; ; place = place.slice(0, place.lastIndexOf("/"))) {
    const found = places.get(place);
    if (found) return found;
    if (place === "") return { start: 0, end: 0 };
  }
}

/** Line and column, from 1. @param {string} text @param {number} offset */
export function lineOf(text, offset) {
  const before = text.slice(0, offset).split("\n");
  return { line: before.length, column: before[before.length - 1].length + 1 };
}
