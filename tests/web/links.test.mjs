// A link opens the same view again, and the lines under a view give the same bytes.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { idle, launch, newPage, open, origin, shell } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

const views = [
  ["#/systems/cart_pendulum?k=30&theta=30deg&t_end=5", "simulate"],
  ["#/systems/free_spin_pendulum/equations?_form=latex", "equations"],
  ["#/systems/rod_pendulum/modes?l=0.8", "modes"],
  ["#/systems/free_spin_pendulum/turning", "turning_points"],
  ["#/systems/whirling_pendulum/equilibria?Omega=2*sqrt(g/l)", "equilibria"],
  ["#/systems/whirling_pendulum/bifurcations", "bifurcations"],
  ["#/systems/compass_walker/gait", "gait"],
  ["#/systems/orbiting_pendulum/accuracy?t_end=2", "accuracy"],
  ["#/scene", "simulate"],
  ["#/problems/4", "modes"],
];

for (const [hash, endpoint] of views) {
  test(`the curl line of ${hash} gives the bytes that the page has`, async () => {
    const { page, context } = await newPage(browser, { motion: "reduce" });
    const seen = [];
    page.on("response", async (response) => {
      if (response.url().endsWith(`/v1/${endpoint}`))
        seen.push({ asked: response.request().postData(), body: await response.body().catch(() => null) });
    });
    await open(page, hash, "pre.curl");
    await page.locator(`pre.curl[data-endpoint=${endpoint}]`).first().waitFor();
    const line = await page.locator(`pre.curl[data-endpoint=${endpoint}]`).first().textContent();
    const printed = await shell(line);
    assert.ok(printed.length > 100);
    JSON.parse(printed);
    if (!hash.startsWith("#/problems")) {
      await idle(page);
      const same = seen.filter(({ asked }) => line.includes(asked.replaceAll("'", "'\\''")));
      assert.ok(same.length > 0, line);
      for (const { body } of same) if (body) assert.ok(body.equals(printed));
    }
    await context.close();
  });
}

test("a link opens the view again, with its numbers, its columns and its scene", async () => {
  const first = await newPage(browser, { motion: "reduce" });
  await open(first.page, "#/scene", ".plot");
  await first.page.getByLabel("Begin with").selectOption("Double pendulum with friction");
  await first.page.waitForFunction(() => document.querySelector("h1").textContent.startsWith("Double"));
  await first.page.getByLabel("l, slider").focus();
  await first.page.keyboard.press("ArrowRight");
  await first.page.locator("[data-column=energy]").uncheck();
  await first.page.waitForFunction(() => /_show=/.test(location.hash) && /[?&]l=/.test(location.hash));
  await idle(first.page);
  const line = await first.page.locator("pre.curl").first().textContent();
  const second = await newPage(browser, { motion: "reduce" });
  await second.page.goto(first.page.url());
  await second.page.locator("pre.curl").first().waitFor();
  await idle(second.page);
  assert.equal(await second.page.locator("pre.curl").first().textContent(), line);
  assert.equal(await second.page.locator("[data-column=energy]").isChecked(), false);
  await first.context.close();
  await second.context.close();
});

test("back and forward go through the views", async () => {
  const { page, complaints, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/", ".vignette");
  await page.getByRole("link", { name: /Compass walker/ }).click();
  await page.getByRole("link", { name: "Gait" }).click();
  await page.locator("pre.curl[data-endpoint=gait]").waitFor();
  await page.goBack();
  await page.locator(".plot").first().waitFor();
  await page.goBack();
  await page.locator(".vignette").first().waitFor();
  await page.goForward();
  await page.goForward();
  await page.locator("pre.curl[data-endpoint=gait]").waitFor();
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a plot goes away as SVG and PNG, a motion as CSV", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/systems/cart_pendulum", ".plot");
  for (const [button, ending, begins] of [
    ["SVG", "svg", "<svg"],
    ["PNG", "png", "\u0089PNG"],
    ["download CSV", "csv", "t,x,theta"],
  ]) {
    const coming = page.waitForEvent("download");
    await page.getByRole("button", { name: button }).first().click();
    const file = await coming;
    assert.match(file.suggestedFilename(), new RegExp(`\\.${ending}$`));
    assert.ok(readFileSync(await file.path(), "latin1").startsWith(begins), button);
  }
  await context.close();
});
