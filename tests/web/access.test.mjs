// axe-core finds nothing in any view, in both themes, and nothing scrolls sideways.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { findings, launch, newPage, noSidewaysScroll, open } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

for (const theme of ["light", "dark"]) {
  test(`axe-core finds nothing, in ${theme} colours, at two widths, and nothing scrolls sideways`, async () => {
    const views = [
      "#/",
      "#/systems/cart_pendulum",
      "#/systems/rod_spring_pendulum/equations",
      "#/systems/rod_pendulum/modes",
      "#/systems/free_spin_pendulum/turning",
      "#/systems/whirling_pendulum/equilibria",
      "#/systems/whirling_pendulum/bifurcations",
      "#/systems/compass_walker/gait",
      "#/systems/spring_pendulum/accuracy",
      "#/problems/8",
      "#/problems/9",
      "#/scene",
      "docs",
      "errors/invalid-request",
      "nothing-here",
    ];
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
