// Every system and every view opens without a complaint, at a phone's width too, and axe-core finds nothing.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { findings, launch, newPage, open, origin } from "./browser.mjs";

const parts = { simulate: "motion", equations: "equations", modes: "modes", turning_points: "turning", equilibria: "equilibria", bifurcations: "bifurcations", gait: "gait", accuracy: "accuracy" };
let browser, systems;

before(async () => {
  browser = await launch();
  const list = await (await fetch(`${origin}/v1/systems`)).json();
  systems = await Promise.all(list.systems.map(async ({ name }) => (await fetch(`${origin}/v1/systems/${name}`)).json()));
});
after(() => browser.close());

async function noSidewaysScroll(page) {
  const [wide, seen] = await page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]);
  assert.ok(wide <= seen, `the page is ${wide} pixels wide in a window of ${seen}`);
}

test("the start view draws every system", async () => {
  const { page, complaints, context } = await newPage(browser);
  await open(page, "#/", ".vignette");
  assert.equal(await page.locator(".vignette").count(), systems.length);
  const isDrawn = () => page.locator(".vignette").evaluateAll((all) => all.every((canvas) =>
    canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some((value) => value > 0)));
  await page.waitForTimeout(300);
  assert.ok(await isDrawn());
  assert.deepEqual(complaints, []);
  assert.deepEqual(await findings(page), []);
  await context.close();
});

test("every view of every system opens, and its words are there", async () => {
  const { page, complaints, context } = await newPage(browser);
  for (const { name, capabilities } of systems) {
    for (const needs of capabilities.filter((one) => one in parts)) {
      await open(page, `#/systems/${name}/${parts[needs]}`, ".views a[aria-current]");
      await page.locator(`pre.curl[data-endpoint=${needs}]`).first().waitFor();
      assert.equal(await page.locator(".view .problem:not(:empty)").count(), 0, `${name} ${needs}`);
      assert.deepEqual(complaints.splice(0), [], `${name} ${needs}`);
    }
  }
  await context.close();
});

test("the ten problems are answered", async () => {
  const { page, complaints, context } = await newPage(browser);
  for (let number = 1; number <= 10; ++number) {
    await open(page, `#/problems/${number}`, ".question");
    assert.ok(await page.locator("table.answers tr").count() > 0, `problem ${number}`);
    assert.deepEqual(complaints.splice(0), [], `problem ${number}`);
  }
  assert.ok(await page.locator(".sheet.differs").count() > 0);
  await context.close();
});

for (const theme of ["light", "dark"]) {
  test(`axe-core finds nothing, in ${theme} colours, at two widths, and nothing scrolls sideways`, async () => {
    const views = ["#/", "#/systems/cart_pendulum", "#/systems/rod_spring_pendulum/equations", "#/systems/rod_pendulum/modes", "#/systems/free_spin_pendulum/turning",
      "#/systems/whirling_pendulum/equilibria", "#/systems/whirling_pendulum/bifurcations", "#/systems/compass_walker/gait", "#/systems/spring_pendulum/accuracy", "#/problems/8", "#/problems/9", "#/scene", "docs", "errors/invalid-request", "nothing-here"];
    const found = {};
    for (const width of [1280, 360]) {
      const { page, context } = await newPage(browser, { width, theme });
      for (const view of views) {
        await open(page, view);
        const here = await findings(page);
        if (here.length) found[`${view} at ${width}`] = here;
        await noSidewaysScroll(page);
      }
      await context.close();
    }
    assert.deepEqual(found, {});
  });
}

test("every address of the docs opens, sends its forms, and axe-core finds nothing in it", async () => {
  const { page, complaints, context } = await newPage(browser, { width: 360 });
  await open(page, "docs", "details.address");
  const entries = page.locator("details.address");
  const count = await entries.count();
  const { paths } = await (await fetch(`${origin}/openapi.json`)).json();
  assert.equal(count, Object.keys(paths).length);
  for (let i = 0; i < count; ++i) {
    const entry = entries.nth(i);
    await entry.locator("summary").click();
    for (const form of await entry.locator("form").all()) {
      await form.locator("button").first().click();
      await form.locator(".status").waitFor({ timeout: 60000 });
      assert.match(await form.locator(".status").textContent(), /^200 /, await entry.locator("summary").textContent());
    }
    await noSidewaysScroll(page);
    assert.deepEqual(await findings(page), [], await entry.locator("summary").textContent());
    await entry.locator("summary").click();
  }
  assert.deepEqual(complaints, []);
  await context.close();
});
