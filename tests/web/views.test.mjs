// Every system and every view opens without a complaint, at a phone's width too, and axe-core finds nothing.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { findings, launch, newPage, open, origin, turnTo } from "./browser.mjs";

const parts = {
  simulate: "motion",
  equations: "equations",
  modes: "modes",
  turning_points: "turning",
  equilibria: "equilibria",
  bifurcations: "bifurcations",
  gait: "gait",
  accuracy: "accuracy",
};
let browser, systems;

before(async () => {
  browser = await launch();
  const list = await (await fetch(`${origin}/v1/systems`)).json();
  systems = await Promise.all(list.systems.map(async ({ name }) => (await fetch(`${origin}/v1/systems/${name}`)).json()));
});
after(() => browser.close());

test("the start view draws every system", async () => {
  const { page, complaints, context } = await newPage(browser);
  await open(page, "#/", ".vignette");
  assert.equal(await page.locator(".vignette").count(), systems.length);
  const isDrawn = () =>
    page.locator(".vignette").evaluateAll((all) =>
      all.every((canvas) =>
        canvas
          .getContext("2d")
          .getImageData(0, 0, canvas.width, canvas.height)
          .data.some((value) => value > 0),
      ),
    );
  await page.waitForTimeout(300);
  assert.ok(await isDrawn());
  assert.deepEqual(complaints, []);
  assert.deepEqual(await findings(page), []);
  await context.close();
});

test("from system to system and from view to view without loading the page anew, and every view has its words", async () => {
  const { page, complaints, context } = await newPage(browser);
  await open(page, "#/", ".vignette");
  for (const { name, title, capabilities } of systems) {
    for (const needs of capabilities.filter((one) => one in parts)) {
      await turnTo(page, `#/systems/${name}/${parts[needs]}`, ".views a[aria-current]");
      await page.locator("h1", { hasText: title }).waitFor();
      await page.locator(`pre.curl[data-endpoint=${needs}]`).first().waitFor();
      assert.equal(await page.locator(".view .problem:not(:empty)").count(), 0, `${name} ${needs}`);
      assert.deepEqual(complaints.splice(0), [], `${name} ${needs}`);
    }
  }
  await context.close();
});

test("a scene of which only the Lagrangian is known says why T and V are missing", async () => {
  const { page, complaints, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/systems/charged_particle/equations", "pre.curl");
  const words = await page.locator(".view").innerText();
  assert.match(words, /only its Lagrangian, so T and V are not known/);
  assert.doesNotMatch(words, /null/);
  await open(page, "#/systems/two_bodies/equations", "pre.curl");
  assert.match(await page.locator(".view").innerText(), /Solved for the accelerations\s+\S+/);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("tabs are one line, and no table of modes is wider than its column, on a desk", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/");
  for (const { name, capabilities } of systems.filter((one) => one.capabilities.includes("modes"))) {
    await turnTo(page, `#/systems/${name}/modes`, "table.modes");
    const [height, wide, seen] = await page.evaluate(() => {
      const frame = document.querySelector(".modes").closest(".table-frame");
      return [document.querySelector(".views").offsetHeight, frame.scrollWidth, frame.clientWidth];
    });
    assert.ok(height < 48, `${name}: tabs ${height} pixels high`);
    assert.ok(wide <= seen, `${name}: a table of ${wide} pixels in ${seen}`);
    assert.ok(capabilities.length > 0);
  }
  await context.close();
});

test("on a phone no table is wider than the screen, and a long number shows all its digits at a tap", async () => {
  const { page, complaints, context } = await newPage(browser, { width: 360, height: 740, motion: "reduce", touch: true });
  await open(page, "#/");
  for (const { name, capabilities } of systems) {
    for (const needs of ["modes", "equilibria", "gait"].filter((one) => capabilities.includes(one))) {
      await turnTo(page, `#/systems/${name}/${parts[needs]}`, `pre.curl[data-endpoint=${needs}]`);
      const frames = page.locator(".table-frame");
      const widths = await frames.evaluateAll((all) => all.map((frame) => [frame.scrollWidth, frame.clientWidth]));
      for (const [wide, seen] of widths) assert.ok(wide <= seen, `${name} ${needs}: a table of ${wide} pixels in ${seen}`);
    }
  }
  await open(page, "#/systems/free_spin_pendulum/turning", "button.beginning");
  const { theta_max } = await (await fetch(`${origin}/v1/turning_points?system=free_spin_pendulum&coordinate=theta`)).json();
  const first = page.locator("button.beginning").first();
  const beginning = (await first.innerText()).replace(/[^0-9.]/g, "");
  assert.equal(Number(beginning), Number(theta_max.toPrecision(5)));
  await first.tap();
  const whole = page.locator(".number:focus");
  assert.equal((await whole.innerText()).replace(/[^0-9.]/g, ""), String(theta_max).slice(0, 17));
  assert.deepEqual(await findings(page), []);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("T and V are columns of the service, with their errors", async () => {
  const { page, complaints, context } = await newPage(browser, { motion: "reduce" });
  const answered = page.waitForResponse((one) => one.url().endsWith("/v1/simulate") && (one.request().postData() ?? "").includes('"T"'));
  await open(page, "#/systems/cart_pendulum?_show=T,V", ".plots figure");
  const answer = await (await answered).json();
  assert.equal(answer.trajectory.T.length, answer.trajectory.t.length);
  const said = await page.locator(".words").innerText();
  for (const name of ["T ±", "V ±"]) assert.ok(said.includes(name), said);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("milliseconds are shown where they are asked for, and measured by the service", async () => {
  const { page, complaints, context } = await newPage(browser, { motion: "reduce" });
  const bodies = [];
  page.on("request", (one) => one.url().endsWith("/v1/accuracy") && bodies.push(JSON.parse(one.postData())));
  await open(page, "#/systems/whirling_pendulum/accuracy?t_end=1", ".view figure");
  assert.ok(!(await page.locator(".result").innerText()).includes(" ms"));
  await page.getByLabel("Measure milliseconds").check();
  await page.locator(".result", { hasText: / ms;/ }).waitFor({ timeout: 60000 });
  assert.deepEqual([bodies[0].measure, bodies.at(-1).measure], [undefined, true]);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("the ten problems are answered", async () => {
  const { page, complaints, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/");
  for (let number = 1; number <= 10; ++number) {
    await turnTo(page, `#/problems/${number}`, ".question");
    assert.ok((await page.locator("table.answers tr").count()) > 0, `problem ${number}`);
    assert.deepEqual(complaints.splice(0), [], `problem ${number}`);
  }
  assert.ok((await page.locator(".sheet.differs").count()) > 0);
  await context.close();
});
