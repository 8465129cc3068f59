// The page asks /v1 like any other client; what it sent is shown under each answer.

/** @typedef {{ pointer?: string, parameter?: string, code: string, detail: string, did_you_mean?: string, allowed?: string[] }} FieldError */
/** @typedef {{ status: number, title: string, detail: string, errors?: FieldError[], reason?: string, t_reached?: number }} ProblemBody */
/** @typedef {Record<string, any>} Body */

/** An answer that is not one: what the service says of it. */
export class Problem extends Error {
  /** @param {ProblemBody} body @param {number} [retryAfter] seconds */
  constructor(body, retryAfter) {
    super(body.detail || body.title);
    this.name = "Problem";
    this.body = body;
    this.retryAfter = retryAfter;
  }
}

/** @type {Set<(text: string) => void>} */
const listeners = new Set();

/** Hears what is to be said about the connection: "" when all is well. @param {(text: string) => void} listener */
export function onConnection(listener) {
  listeners.add(listener);
}

/** @param {string} text */
function say(text) {
  for (const listener of listeners) listener(text);
}

/** @param {number} seconds @param {AbortSignal | undefined} signal @returns {Promise<void>} */
function pause(seconds, signal) {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(resolve, 1000 * seconds);
    signal?.addEventListener(
      "abort",
      () => {
        clearTimeout(timer);
        reject(signal.reason);
      },
      { once: true },
    );
  });
}

/** @param {Response} response @returns {Promise<never>} */
async function refuse(response) {
  const body = await response.json().catch(() => ({ title: response.statusText, detail: "", status: response.status }));
  throw new Problem(body, Number(response.headers.get("Retry-After")) || undefined);
}

/**
 * Sends it until the service has time for it. Throws Problem, or what aborted it.
 * @param {string} target @param {RequestInit} options
 */
async function patiently(target, options) {
  count(1);
  try {
    return await untilAnswered(target, options);
  } finally {
    // What is done with the answer comes first.
    setTimeout(() => count(-1));
  }
}

/** @param {string} target @param {RequestInit} options @returns {Promise<Response>} */
async function untilAnswered(target, options) {
  for (;;) {
    /** @type {Response} */
    let response;
    try {
      response = await fetch(target, options);
    } catch (error) {
      options.signal?.throwIfAborted();
      say("The service does not answer. Trying again in 2 s.");
      await pause(2, options.signal ?? undefined);
      continue;
    }
    if (response.status !== 503) {
      say("");
      return response.ok ? response : refuse(response);
    }
    const seconds = Math.min(10, Number(response.headers.get("Retry-After")) || 2);
    say(`The service is busy. Trying again in ${seconds} s.`);
    await pause(seconds, options.signal ?? undefined);
  }
}

let underWay = 0;
/** @type {Set<(count: number) => void>} */
const counters = new Set();

/** Hears how many questions are under way. @param {(count: number) => void} counter */
export function onAsking(counter) {
  counters.add(counter);
}

/** @param {number} change */
function count(change) {
  underWay += change;
  for (const counter of counters) counter(underWay);
}

/** @type {Map<string, Promise<any>>} */
const kept = new Map();

/** The document at an address, fetched once. @param {string} target @returns {Promise<any>} */
export function read(target) {
  const known = kept.get(target);
  if (known) return known;
  const answer = patiently(target, {}).then((response) => response.json());
  kept.set(target, answer);
  answer.catch(() => kept.delete(target));
  return answer;
}

/** The answer to a question. @param {string} endpoint @param {Body} body @param {AbortSignal} [signal] @returns {Promise<any>} */
export async function ask(endpoint, body, signal) {
  const response = await patiently(`/v1/${endpoint}`, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(body),
    signal,
  });
  return response.json();
}

/** The answer as CSV. @param {string} endpoint @param {Body} body */
export async function askForTable(endpoint, body) {
  const response = await patiently(`/v1/${endpoint}`, {
    method: "POST",
    headers: { "Content-Type": "application/json", Accept: "text/csv" },
    body: JSON.stringify(body),
  });
  return response.blob();
}

/** A shell takes what is between single quotes as it is. @param {string} text */
export function quoted(text) {
  return `'${text.replaceAll("'", "'\\''")}'`;
}

/** The line that asks the same in a shell. @param {string} endpoint @param {Body} body */
export function curlLine(endpoint, body) {
  return `curl ${quoted(`${location.origin}/v1/${endpoint}`)} -d ${quoted(JSON.stringify(body))}`;
}

/** The lines that ask the same in Python. @param {string} endpoint @param {Body} body */
export function pythonLines(endpoint, body) {
  const text = JSON.stringify(body, null, 1).replaceAll("\\", "\\\\").replaceAll('"""', '\\"\\"\\"');
  return (
    `import json, urllib.request\n\nrequest = json.loads("""${text}""")\n` +
    `answer = json.load(urllib.request.urlopen("${location.origin}/v1/${endpoint}", json.dumps(request).encode()))\n`
  );
}
