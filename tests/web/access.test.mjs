// axe-core finds nothing in any view, in both themes, and nothing scrolls sideways.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { findings, idle, launch, newPage, noSidewaysScroll, open, turnTo } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

const themes = ["light", "dark"]; // between which nothing differs but colours
const ofColours = ["color-contrast", "link-in-text-block"];
const widths = [1280, 360];
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

for (const width of widths) {
  test(`axe-core finds nothing in either theme, and nothing scrolls sideways, ${width} pixels wide`, async () => {
    const found = {};
    const { page, context } = await newPage(browser, { width, theme: themes[0], motion: "reduce" });
    await open(page, "#/problems/1");
    for (const view of views) {
      await (view.startsWith("#") ? turnTo : open)(page, view);
      for (const theme of themes) {
        await page.emulateMedia({ colorScheme: theme });
        await idle(page);
        const here = await findings(page, theme === themes[0] ? {} : { rules: ofColours });
        if (here.length) found[`${view} in ${theme} colours`] = here;
        await noSidewaysScroll(page);
      }
    }
    await context.close();
    assert.deepEqual(found, {});
  });
}
