// /docs: every address opens and every form is answered.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { findings, launch, newPage, noSidewaysScroll, open, origin } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

test("every address of the docs opens, sends its forms, and axe-core finds nothing in it", async () => {
  const { page, complaints, context } = await newPage(browser, { width: 360, motion: "reduce" });
  await open(page, "docs", "details.address");
  const entries = page.locator("details.address");
  const count = await entries.count();
  assert.deepEqual(await findings(page), []);
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
    assert.deepEqual(await findings(page, { within: "details.address[open]" }), [], await entry.locator("summary").textContent());
    await entry.locator("summary").click();
  }
  assert.deepEqual(complaints, []);
  await context.close();
});
