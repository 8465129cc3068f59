// The address of a view: all of its state stands after the #, so that a link opens the same view again.

/** @typedef {{ path: string[], values: Map<string, string> }} Address */

/** "#/systems/cart_pendulum/modes?k=10" @param {string} [hash] @returns {Address} */
export function addressOf(hash = location.hash) {
  const [path = "", query = ""] = hash.replace(/^#\/?/, "").split("?");
  return { path: path.split("/").filter(Boolean).map(decodeURIComponent), values: new Map(new URLSearchParams(query)) };
}

/** @param {Address} address */
export function hashOf({ path, values }) {
  const query = new URLSearchParams([...values]).toString();
  return `#/${path.map(encodeURIComponent).join("/")}${query ? "?" + query : ""}`;
}

/** Writes the present state into the address without a new entry of the history. @param {Address} address */
export function remember(address) {
  history.replaceState(null, "", hashOf(address));
}

/** @param {Uint8Array} bytes */
function base64url(bytes) {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** A text, compressed, in the letters of an address. @param {string} text */
export async function packed(text) {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  return base64url(new Uint8Array(await new Response(stream).arrayBuffer()));
}

/** @param {string} letters */
export async function unpacked(letters) {
  const binary = atob(letters.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Response(stream).text();
}
