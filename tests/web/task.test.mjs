// One whole task by keyboard alone, the preferences of the reader, and a service that goes away for a while.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import process from "node:process";
import { after, before, test } from "node:test";
import { idle, launch, newPage, open } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

/** Presses Tab, or the way back, until what is wanted has the focus. */
async function tabTo(page, wanted, key = "Tab") {
  for (let i = 0; i < 120; ++i) {
    await page.keyboard.press(key);
    const found = await page.evaluate(() => {
      const node = document.activeElement;
      return `${node?.getAttribute("aria-label") ?? ""} ${node?.textContent ?? ""} ${node?.id ?? ""}`;
    });
    if (wanted.test(found)) return;
  }
  assert.fail(`Tab does not lead to ${wanted}`);
}

test("by keyboard: from the start to the frequency of a cart with a stiffer spring", async () => {
  const { page, context } = await newPage(browser);
  await open(page, "#/", ".vignette");
  await tabTo(page, /Cart on a spring/);
  await page.keyboard.press("Enter");
  await page.locator(".plot").first().waitFor();
  await idle(page);
  await tabTo(page, /drawing|Cart on a spring.*over/);
  await page.keyboard.press(" ");
  await page.keyboard.press("Home");
  assert.match(await page.locator(".clock").textContent(), /t = 0 s/);
  await page.keyboard.press("ArrowRight");
  assert.doesNotMatch(await page.locator(".clock").textContent(), /t = 0 s/);
  await tabTo(page, /^k, slider/);
  await page.keyboard.press("Tab");
  await page.keyboard.press("Control+A");
  await page.keyboard.type("4*m*g/l");
  await page.keyboard.press("Tab");
  await tabTo(page, /^\s*Modes\s*$/, "Shift+Tab"); // the views stand above the numbers
  await page.keyboard.press("Enter");
  await page.locator("pre.curl[data-endpoint=modes]").waitFor();
  assert.match(await page.locator("pre.curl").textContent(), /4\*m\*g\/l/);
  assert.match(await page.locator("table.modes").textContent(), /oscillation/);
  await context.close();
});

test("by keyboard: a bifurcation's parameter is taken from the diagram", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/systems/whirling_pendulum/bifurcations", "canvas.plot");
  await page.locator("canvas.plot").focus();
  for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /Omega=/.test(location.hash));
  const taken = Number(new URLSearchParams(new URL(page.url()).hash.split("?")[1]).get("Omega"));
  assert.ok(taken > 6.15 && taken < 7.5, String(taken));
  await context.close();
});

test("a wrong number is told at its field, and the drawing stays", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/systems/cart_pendulum", ".plot");
  const field = page.getByRole("textbox", { name: /mass of the bob/ });
  await field.fill("20 cm");
  await field.press("Tab");
  await page.locator(".number-row .problem:not(:empty)").waitFor();
  assert.match(await page.locator(".number-row .problem:not(:empty)").textContent(), /kg/);
  assert.equal(await field.getAttribute("aria-invalid"), "true");
  assert.equal((await page.locator("canvas.plot").count()) > 0, true);
  await field.fill("0.7");
  await field.press("Tab");
  await page.waitForFunction(() => !document.querySelector(".number-row .problem:not(:empty)"));
  await context.close();
});

test("who wants less motion gets a still drawing at a telling instant, until Play is pressed", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/systems/whirling_pendulum", ".plot");
  const first = await page.locator(".clock").textContent();
  await page.waitForTimeout(300);
  assert.equal(await page.locator(".clock").textContent(), first);
  assert.doesNotMatch(first, /t = 0 s/);
  await page.getByRole("button", { name: "Play" }).click();
  await page.waitForTimeout(300);
  assert.notEqual(await page.locator(".clock").textContent(), first);
  await context.close();
});

test("the theme is the reader's, and the drawing follows it", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/systems/rod_pendulum", ".plot");
  const light = await page.locator("canvas.drawing").evaluate((canvas) => canvas.toDataURL());
  await page.emulateMedia({ colorScheme: "dark" });
  await page.waitForTimeout(100);
  assert.notEqual(await page.locator("canvas.drawing").evaluate((canvas) => canvas.toDataURL()), light);
  assert.equal(await page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor), "rgb(21, 23, 26)");
  await context.close();
});

/** A server of this test alone; port 0 is a free one. */
async function serve(port) {
  const child = spawn(process.env.QDOT_BINARY, ["serve", "--port", String(port)], { stdio: ["ignore", "pipe", "ignore"] });
  const [line] = await once(child.stdout, "data");
  return { child, port: JSON.parse(line.toString().split("\n")[0]).port };
}

async function end(child) {
  child.kill("SIGTERM");
  await once(child, "exit");
}

test("a service that is killed and started again is waited for, calmly", async () => {
  const first = await serve(0);
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await page.goto(`http://127.0.0.1:${first.port}/#/systems/spring_pendulum`);
  await page.locator(".plot").first().waitFor();
  await idle(page);
  await end(first.child);
  const field = page.getByRole("textbox", { name: /stiffness/ });
  await field.fill("55");
  await field.press("Tab");
  await page.waitForFunction(() => /does not answer/.test(document.getElementById("connection").textContent));
  assert.equal((await page.locator("canvas.plot").count()) > 0, true);
  const second = await serve(first.port);
  await page.waitForFunction(
    () =>
      document.getElementById("connection").textContent === "" &&
      document.querySelector("pre.curl").textContent.includes('"k":55'),
    null,
    { timeout: 15000 },
  );
  await end(second.child);
  await context.close();
});

test("a busy service is waited for as long as it asks, with the old picture kept", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/systems/spring_pendulum", ".plot");
  let refusals = 0;
  await page.route("**/v1/simulate", (route) => {
    refusals += 1;
    if (refusals > 1) return route.continue();
    return route.fulfill({
      status: 503,
      headers: { "Retry-After": "1" },
      contentType: "application/problem+json",
      body: '{"title": "busy", "status": 503, "detail": "busy"}',
    });
  });
  const field = page.getByRole("textbox", { name: /stiffness/ });
  await field.fill("33");
  await field.press("Tab");
  await page.waitForFunction(
    () => document.getElementById("connection").textContent === "The service is busy. Trying again in 1 s.",
  );
  assert.equal((await page.locator("canvas.plot").count()) > 0, true);
  await page.waitForFunction(
    () =>
      document.getElementById("connection").textContent === "" &&
      document.querySelector("pre.curl").textContent.includes('"k":33'),
  );
  assert.equal(refusals, 2);
  await page.getByRole("button", { name: "All defaults" }).click();
  await page.waitForFunction(() => !document.querySelector("pre.curl").textContent.includes('"k"'));
  await context.close();
});

test("many wishes in a row are not all asked: the newest is", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/systems/spring_pendulum", ".plot");
  const asked = [];
  await page.route("**/v1/simulate", async (route) => {
    asked.push(JSON.parse(route.request().postData()).parameters?.k);
    await new Promise((resolve) => {
      setTimeout(resolve, 120);
    });
    await route.continue().catch(() => {});
  });
  await page.getByLabel("k, slider").evaluate(async (slider) => {
    for (let i = 1; i <= 60; ++i) {
      slider.value = String(0.3 + i / 200);
      slider.dispatchEvent(new Event("input"));
      await new Promise(requestAnimationFrame);
    }
  });
  await idle(page);
  const last = Number(await page.getByRole("textbox", { name: /stiffness/ }).inputValue());
  assert.equal(asked.at(-1), last);
  assert.ok(asked.length < 30, `${asked.length} questions`);
  await context.close();
});
