// A scene of one's own: messages at their places, nothing injected, everything drawn.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { idle, launch, newPage, noSidewaysScroll, open } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

const template = async (page) => JSON.parse(await page.locator("#scene-text").inputValue());
const write = async (page, text) => {
  await page.locator("#scene-text").fill(text);
};

test("five templates open in every view", async () => {
  const { page, complaints, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/scene", ".plot");
  const names = (await page.locator("#template option").allTextContents()).slice(1);
  assert.equal(names.length, 5);
  for (const name of names) {
    await page.getByLabel("Begin with").selectOption(name);
    await idle(page);
    for (const view of ["Equations", "Equilibria", "Motion"]) {
      await page.locator(".views").getByRole("link", { name: view }).click();
      await idle(page);
      await page.locator("pre.curl").first().waitFor();
    }
    assert.equal(await page.locator(".remark").count(), 0, name);
  }
  assert.deepEqual(complaints, []);
  await context.close();
});

test("what the service says stands at its line, and its suggestion is a button", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/scene", ".plot");
  const text = await page.locator("#scene-text").inputValue();
  await write(page, text.replace('"mass": "m"', '"mass": "mm"'));
  const remark = page.locator(".remark");
  await remark.waitFor();
  const line = text.split("\n").findIndex((one) => one.includes('"mass": "m"')) + 1;
  assert.match(await remark.textContent(), new RegExp(`line ${line}`));
  assert.equal(await page.locator(".gutter .wrong").textContent(), String(line));
  await write(page, text.replace('"gravity"', '"gravitty"'));
  await page.waitForFunction(() => /gravity/.test(document.querySelector(".remark")?.textContent ?? ""));
  await page.locator(".remark").getByRole("button", { name: /write/ }).first().click();
  await page.waitForFunction(() => document.querySelectorAll(".remark").length === 0);
  assert.equal(await page.locator("#scene-text").inputValue(), text);
  await context.close();
});

test("text that is no JSON is told where it breaks", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/scene", ".plot");
  for (const [text, said] of [
    ["{\n  'name': 1}", /line 2 .*double quotes/],
    ['{"name": "a",\n}', /line 2/],
    ['{"a": 1 // x\n}', /line 1/],
    ['{"units": none}', /line 1 .*double quotes: "none"/],
    ["", /ends/],
  ]) {
    await write(page, text);
    await page.waitForFunction(
      (pattern) => new RegExp(pattern).test(document.querySelector(".remark")?.textContent ?? ""),
      said.source,
    );
  }
  await context.close();
});

test("a scene without units has none beside its numbers, on a phone too", async () => {
  const { page, complaints, context } = await newPage(browser, { width: 360, height: 740, motion: "reduce" });
  await open(page, "#/scene", ".plot");
  const scene = {
    name: "duffing",
    title: "Duffing's oscillator",
    units: "none",
    coordinates: [{ name: "x", initial: "0.1" }],
    inputs: [{ name: "F", default: "0.3*cos(1.2*t)" }],
    lagrangian: "x_dot^2/2 + x^2/2 - x^4/4",
    forces: [{ value: "F - 0.2*x_dot", along: "x" }],
  };
  await write(page, JSON.stringify(scene, null, 1));
  await page.waitForFunction(() => document.querySelector("h1").textContent.startsWith("Duffing"));
  await idle(page);
  assert.doesNotMatch(await page.locator("main").innerText(), /undefined|null/);
  await noSidewaysScroll(page);
  await page.locator(".views").getByRole("link", { name: "Equations" }).click();
  await page.locator(".view", { hasText: "only its Lagrangian" }).waitFor();
  assert.deepEqual(complaints, []);
  await context.close();
});

test("names of the schema are offered where they fit", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/scene", ".plot");
  await idle(page);
  const text = await page.locator("#scene-text").inputValue();
  const place = text.indexOf('"kind": "particle"') + '"kind": "particle",'.length;
  await page.locator("#scene-text").evaluate((area, at) => {
    area.focus();
    area.setSelectionRange(at, at);
  }, place);
  await page.keyboard.press("Control+Space");
  const words = await page.locator(".offers button").allTextContents();
  assert.ok(words.includes("mass") && words.includes("position"), words.join());
  assert.ok(!words.includes("coordinates"));
  await context.close();
});

test("a hostile scene injects nothing", async () => {
  const { page, complaints, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/scene", ".plot");
  const scene = await template(page);
  const markup = '<img src=x onerror="window.taken=1"><script>window.taken=1</script>';
  scene.title = markup + "x".repeat(900);
  scene.description = markup;
  scene.parameters[0].meaning = markup;
  scene.coordinates[0].meaning = markup;
  scene.coordinates[0].latex = markup.slice(0, 60);
  await write(page, JSON.stringify(scene));
  await page.waitForFunction(() => document.querySelector("h1").textContent.startsWith("<img"));
  for (const view of ["Equations", "Modes", "Motion"]) {
    await page.locator(".views").getByRole("link", { name: view }).click();
    await idle(page);
  }
  assert.equal(await page.evaluate(() => window.taken), undefined);
  assert.equal(await page.locator("main img, main script").count(), 0);
  const [wide, seen] = await page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]);
  assert.ok(wide <= seen);
  scene.title = "y".repeat(100000);
  await write(page, JSON.stringify(scene));
  await page
    .locator(".own-editor .problem", { hasText: "too large" })
    .or(page.locator(".own-editor .problem", { hasText: "bytes" }))
    .first()
    .waitFor();
  scene.title = "Short";
  scene.name = "__proto__";
  await write(page, JSON.stringify(scene));
  await page.waitForFunction(() => document.querySelector(".remark") || document.querySelector("h1").textContent === "Short");
  assert.deepEqual(
    complaints.filter((text) => !/status of 4(13|22)/.test(text)),
    [],
  );
  await context.close();
});
