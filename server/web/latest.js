// Of many wishes only the newest matters: one question is under way, one waits, and what takes long makes room.

const patience = 250; // milliseconds that a question may hold up a newer one

export class Latest {
  /** @param {(signal: AbortSignal) => Promise<void>} work @param {(error: unknown) => void} fail */
  constructor(work, fail) {
    this.work = work;
    this.fail = fail;
    /** @type {AbortController | null} */
    this.running = null;
    this.isWaiting = false;
    this.began = 0;
    this.timer = 0;
  }

  /** Asks in the next frame, with what is wished then. */
  wish() {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => this.begin());
  }

  begin() {
    if (!this.isWaiting) return;
    if (this.running) {
      clearTimeout(this.timer);
      this.timer = window.setTimeout(() => this.running?.abort(), Math.max(0, this.began + patience - performance.now()));
      return;
    }
    this.isWaiting = false;
    this.run();
  }

  async run() {
    const controller = new AbortController();
    this.running = controller;
    this.began = performance.now();
    try {
      await this.work(controller.signal);
    } catch (error) {
      if (!controller.signal.aborted) this.fail(error);
    }
    clearTimeout(this.timer);
    this.running = null;
    this.begin();
  }

  /** Nothing more is wanted. */
  stop() {
    this.isWaiting = false;
    this.running?.abort();
  }
}
