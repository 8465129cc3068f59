// What may stand where the cursor is in a scene, by the schema of scenes.

/** @param {any} schema @param {any} root @returns {any[]} the schemas that it stands for, its references followed */
function alternatives(schema, root) {
  if (!schema) return [];
  if (schema.$ref)
    return alternatives(
      schema.$ref
        .slice(2)
        .split("/")
        .reduce((/** @type {any} */ place, /** @type {string} */ key) => place?.[key], root),
      root,
    );
  const more = [
    ...(schema.anyOf ?? []),
    ...(schema.oneOf ?? []),
    ...(schema.allOf ?? []).flatMap((/** @type {any} */ one) => [one, one.then].filter(Boolean)),
  ];
  return [schema, ...more.flatMap((one) => alternatives(one, root))];
}

/** @param {any} root @param {string[]} path */
function schemasAt(root, path) {
  let here = alternatives(root, root);
  for (const step of path) {
    here = here.flatMap((schema) => {
      const next = /^\d+$/.test(step) && schema.items ? schema.items : schema.properties?.[step];
      return alternatives(next, root);
    });
  }
  return here;
}

/** The path of the object around the end of this text, which need not be whole. @param {string} text */
export function pathBefore(text) {
  /** @type {{ isArray: boolean, step: string | number }[]} */
  const open = [];
  for (const [mark, key] of text.matchAll(/"((?:[^"\\]|\\.)*)"\s*:|"(?:[^"\\]|\\.)*"|[{}[\],]/g)) {
    const last = open[open.length - 1];
    if (key !== undefined && last) last.step = key;
    else if (mark === "{") open.push({ isArray: false, step: "" });
    else if (mark === "[") open.push({ isArray: true, step: 0 });
    else if (mark === "}" || mark === "]") open.pop();
    else if (mark === "," && last?.isArray) last.step = Number(last.step) + 1;
  }
  return { path: open.slice(0, -1).map(({ step }) => String(step)), isInObject: open[open.length - 1]?.isArray === false };
}

/** The name that has been begun, without its quote. @param {string} text before the cursor @returns {string | undefined} */
export function begunName(text) {
  return /[{,]\s*"([^"\n]*)$/.exec(text)?.[1];
}

/** Names that may come here, with what they mean. @param {any} schema @param {string} text before the cursor @returns {{ word: string, meaning: string }[]} */
export function completions(schema, text) {
  const { path, isInObject } = pathBefore(text);
  const typed = begunName(text) ?? "";
  if (!isInObject || /:\s*"?[^",]*$/.test(text.slice(Math.max(text.lastIndexOf(","), text.lastIndexOf("{"))))) return [];
  const found = new Map();
  for (const one of schemasAt(schema, path)) {
    for (const [word, about] of Object.entries(one.properties ?? {}))
      found.set(word, /** @type {any} */ (about).description ?? "");
  }
  return [...found].filter(([word]) => word.startsWith(typed)).map(([word, meaning]) => ({ word, meaning }));
}
