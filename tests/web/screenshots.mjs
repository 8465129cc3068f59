// A picture of every view, at a phone's and a desk's width, light and dark: node screenshots.mjs DIRECTORY [WORD IN A NAME].
import { mkdirSync } from "node:fs";
import process from "node:process";
import { idle, launch, newPage, open } from "./browser.mjs";

const views = {
  start: "#/",
  motion: "#/systems/cart_pendulum",
  forced: "#/systems/forced_spring_pendulum?F=2*cos(4*t)&t_end=20",
  chaos: "#/systems/rod_pendulum?theta=1.2&phi=1.4&t_end=30",
  stops: "#/systems/rolling_disk_platform",
  equations: "#/systems/free_spin_pendulum/equations",
  modes: "#/systems/rod_pendulum/modes",
  turning: "#/systems/free_spin_pendulum/turning",
  equilibria: "#/systems/whirling_pendulum/equilibria",
  bifurcations: "#/systems/whirling_pendulum/bifurcations",
  gait: "#/systems/compass_walker/gait",
  accuracy: "#/systems/spring_pendulum/accuracy",
  sweep: "#/systems/cart_pendulum/sweep?_vary=k&_from=1&_to=60",
  practice: "#/systems/spring_pendulum/practice",
  problem: "#/problems/10",
  scene: "#/scene",
  docs: "docs",
  error: "errors/invalid-request",
  nothing: "nothing-here",
};
const [, , directory, word = ""] = process.argv;
mkdirSync(directory, { recursive: true });
const browser = await launch();
for (const width of [1280, 360]) {
  for (const theme of ["light", "dark"]) {
    const { page, context } = await newPage(browser, { width, height: width < 500 ? 740 : 900, theme, motion: "reduce" });
    for (const [name, hash] of Object.entries(views)) {
      const file = `${name}-${width}-${theme}.png`;
      if (!file.includes(word)) continue;
      await open(page, hash);
      await idle(page);
      await page.waitForTimeout(200);
      await page.screenshot({ path: `${directory}/${file}`, fullPage: width < 500 });
    }
    await context.close();
  }
}
await browser.close();
