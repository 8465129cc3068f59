// The time of a motion that plays: true time unless it is slowed, stopped at its end, moved by hand.

export class Clock {
  constructor() {
    this.time = 0;
    this.start = 0;
    this.end = 1;
    this.speed = 1;
    this.plays = false;
    this.last = 0;
    /** @type {Set<(clock: Clock) => void>} */
    this.listeners = new Set();
    this.frame = (/** @type {number} */ now) => this.advance(now);
  }

  /** @param {(clock: Clock) => void} listener */
  onChange(listener) {
    this.listeners.add(listener);
  }

  tell() {
    for (const listener of this.listeners) listener(this);
  }

  /** @param {number} start @param {number} end */
  setRange(start, end) {
    [this.start, this.end] = [start, end];
    this.seek(this.time);
  }

  /** @param {number} time */
  seek(time) {
    this.time = Math.min(this.end, Math.max(this.start, time));
    this.tell();
  }

  play() {
    if (this.plays) return;
    if (this.time >= this.end) this.time = this.start;
    this.plays = true;
    this.last = performance.now();
    requestAnimationFrame(this.frame);
    this.tell();
  }

  pause() {
    this.plays = false;
    this.tell();
  }

  /** @param {number} now in milliseconds */
  advance(now) {
    if (!this.plays) return;
    const passed = Math.min(0.1, Math.max(0, (now - this.last) / 1000));
    this.last = now;
    this.time = Math.min(this.end, this.time + passed * this.speed);
    if (this.time >= this.end) this.plays = false;
    this.tell();
    if (this.plays) requestAnimationFrame(this.frame);
  }
}
