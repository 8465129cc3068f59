// Debian's Chromium for the tests of the page: a page that notes every complaint, and asks nobody but its own server.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { execFile } from "node:child_process";
import assert from "node:assert/strict";
import { promisify } from "node:util";
import process from "node:process";

export const modules = process.env.QDOT_PAGE_MODULES;
const require = createRequire(`${modules}/here.js`);
const { chromium } = require("playwright-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
export const origin = process.env.QDOT_URL;
const run = promisify(execFile);

export async function launch() {
  const sandbox = process.getuid() === 0 ? ["--no-sandbox"] : [];
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: [...sandbox, "--disable-gpu"] });
}

/** A page with the list of what went wrong on it. */
export async function newPage(
  browser,
  { width = 1280, height = 900, theme = "light", motion = "no-preference", touch = false } = {},
) {
  const context = await browser.newContext({
    viewport: { width, height },
    colorScheme: theme,
    reducedMotion: motion,
    bypassCSP: false,
    hasTouch: touch,
  });
  const page = await context.newPage();
  const complaints = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(String(error.stack)));
  page.on("request", (request) => {
    if (!request.url().startsWith(origin) && !/^(blob|data):/.test(request.url())) complaints.push(`asks ${request.url()}`);
  });
  return { page, complaints, context };
}

/** Opens a view and waits until it stands still: no question under way, and its parts there. */
export async function open(page, hash, wanted = "main h1") {
  await page.goto("about:blank"); // another fragment alone would load nothing anew
  await page.goto(`${origin}/${hash}`);
  await page.locator(wanted).first().waitFor();
  await idle(page);
}

/** Goes on to another view as a link does, which costs half of loading the page anew. */
export async function turnTo(page, hash, wanted = "main h1") {
  await page.evaluate((to) => {
    const old = document.querySelector(".view > *") ?? document.querySelector("main > *");
    old.dataset.old = "";
    location.hash = to;
  }, hash);
  await page.locator("[data-old]").waitFor({ state: "detached" });
  await page.locator(wanted).first().waitFor();
  await idle(page);
}

/** Until nothing is asked any more, and what was answered is shown. */
export async function idle(page) {
  await page.waitForFunction(
    () =>
      new Promise((resolve) => {
        let quiet = 0;
        const look = () => {
          quiet = document.documentElement.dataset.asking ? 0 : quiet + 1;
          if (quiet > 4) resolve(true);
          else requestAnimationFrame(look);
        };
        look();
      }),
  );
}

/**
 * What axe-core finds in a part of the page, by all its rules or by some, a line each. It is given to the page as a program
 * of the test, which no policy holds back.
 */
export async function findings(page, { within = "html", rules = undefined } = {}) {
  const session = await page.context().newCDPSession(page);
  const evaluate = async (expression) =>
    (await session.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true })).result.value;
  if (!(await evaluate("Boolean(window.axe)"))) await evaluate(`${axe}; true`);
  const options = { resultTypes: ["violations"], ...(rules && { runOnly: { type: "rule", values: rules } }) };
  const found = await evaluate(`axe.run(${JSON.stringify(within)}, ${JSON.stringify(options)}).then((all) =>
    JSON.stringify(all.violations.map((one) => one.id + ": " + one.nodes.slice(0, 3).map((node) => node.html.slice(0, 160) + " " + (node.any[0]?.message ?? node.all[0]?.message ?? "")).join(" | "))))`);
  await session.detach();
  return JSON.parse(found);
}

/** What a shell line prints. */
export async function shell(line) {
  const { stdout } = await run("sh", ["-c", `${line} --silent --noproxy '*'`], { encoding: "buffer", maxBuffer: 1 << 28 });
  return stdout;
}

/** Where the first body stands in the window at the start of the motion, which is then shown. */
export async function placeOfBody(page) {
  await page.locator(".scrub").evaluate((range) => {
    range.value = range.min;
    range.dispatchEvent(new Event("input"));
  });
  await page.evaluate(() => window.scrollTo(0, 0));
  return page.evaluate(async () => {
    const { pictures } = await import("/page/stage.js");
    const canvas = document.querySelector("canvas.drawing");
    const picture = pictures.get(canvas);
    const box = canvas.getBoundingClientRect();
    const [x, y] = picture.pixel(picture.figure.masses[0].at, picture.figure.known(picture.motion.at(0)), [0, 0]);
    return [box.left + x, box.top + y];
  });
}

/** A phone shows the page without scrolling sideways. */
export async function noSidewaysScroll(page) {
  const [wide, seen] = await page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]);
  assert.ok(wide <= seen, `the page is ${wide} pixels wide in a window of ${seen}`);
}
