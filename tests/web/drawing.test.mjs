// What is drawn is what was answered.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { idle, launch, newPage, open, origin, placeOfBody } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

/** Where the camera puts a place, and the centre of the mass that is painted there. */
async function painted(page, t) {
  return page.evaluate(async (time) => {
    const { pictures } = await import("/page/stage.js");
    const canvas = document.querySelector("canvas.drawing");
    const picture = pictures.get(canvas);
    picture.draw(time, {});
    const density = canvas.width / canvas.getBoundingClientRect().width;
    const { data, width } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const blue = getComputedStyle(document.documentElement)
      .getPropertyValue("--blue")
      .trim()
      .match(/\w\w/g)
      .map((two) => parseInt(two, 16));
    const at = (x, y) => blue.every((value, i) => Math.abs(data[4 * (y * width + x) + i] - value) < 3);
    const centreNear = ([px, py], radius) => {
      let [sum, sx, sy] = [0, 0, 0];
      for (let y = Math.round((py - radius) * density); y <= (py + radius) * density; ++y) {
        for (let x = Math.round((px - radius) * density); x <= (px + radius) * density; ++x)
          if (at(x, y)) {
            sum += 1;
            sx += x + 0.5;
            sy += y + 0.5;
          }
      }
      return sum ? [sx / sum / density, sy / sum / density] : null;
    };
    window.projected = (place, radius) => ({
      expected: picture.camera.project(place),
      seen: centreNear(picture.camera.project(place), radius),
    });
  }, t);
}

for (const [name, point] of [
  ["spring_pendulum", "bob"],
  ["cart_pendulum", "bob"],
  ["rod_pendulum", "bob"],
  ["orbiting_pendulum", "bob"],
  ["free_spin_pendulum", "bob"],
  ["compass_walker", "hip"],
]) {
  test(`${name}: the ${point} is painted where the answer says, to a pixel, at ten instants`, async () => {
    const { page, context } = await newPage(browser, { motion: "reduce" });
    await open(page, `#/systems/${name}?t_end=1.2`, ".plot");
    const times = Array.from({ length: 10 }, (_, i) => 0.03 + 0.1171 * i);
    const answer = await (
      await fetch(`${origin}/v1/simulate`, {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body: JSON.stringify({ system: name, times, include: ["positions"] }),
      })
    ).json();
    for (const [i, t] of times.entries()) {
      await painted(page, t);
      const place = ["x", "y", "z"]
        .map((axis) => answer.trajectory[`${point}_${axis}`]?.[i])
        .filter((value) => value !== undefined);
      const { expected, seen } = await page.evaluate((where) => window.projected(where, 16), place);
      assert.ok(seen, `no mass near ${expected} at ${t}`);
      assert.ok(Math.hypot(seen[0] - expected[0], seen[1] - expected[1]) < 1, `${seen} for ${expected} at ${t}`);
    }
    await context.close();
  });
}

test("a slider moves the drawing, the plots and the curl line", async () => {
  const { page, complaints, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/systems/spring_pendulum", ".plot");
  const picture = () => page.locator("canvas.drawing").evaluate((canvas) => canvas.toDataURL());
  const before = await picture();
  const slider = page.getByLabel("k, slider");
  await slider.focus();
  for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => document.querySelector("pre.curl")?.textContent.includes('"k":'));
  await idle(page);
  assert.notEqual(await picture(), before);
  assert.match(page.url(), /k=/);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a body is taken by hand to where the motion shall begin", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/systems/spring_pendulum", ".plot");
  const place = await placeOfBody(page);
  await page.mouse.move(...place);
  await page.mouse.down();
  await page.mouse.move(place[0] + 60, place[1] - 30, { steps: 6 });
  await page.mouse.up();
  await page.waitForFunction(() => /theta=/.test(location.hash));
  const values = new URLSearchParams(new URL(page.url()).hash.split("?")[1]);
  assert.ok(Number(values.get("theta")) > 0.25);
  await context.close();
});

test("scrubbing and zooming: the time follows, and the plot shows less", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/systems/cart_pendulum", ".plot");
  const plot = page.locator("canvas.plot").first();
  const box = await plot.boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + 60);
  const time = Number((await page.locator(".clock").textContent()).match(/[\d.]+/)[0]);
  assert.ok(time > 3 && time < 7, String(time));
  const before = await plot.evaluate((canvas) => canvas.toDataURL());
  const second = page.locator("canvas.plot").nth(1);
  const beside = await second.evaluate((canvas) => canvas.toDataURL());
  await page.mouse.move(box.x + 150, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(box.x + 300, box.y + 60, { steps: 4 });
  await page.mouse.up();
  assert.notEqual(await plot.evaluate((canvas) => canvas.toDataURL()), before);
  assert.notEqual(await second.evaluate((canvas) => canvas.toDataURL()), beside, "the other plots show the same time");
  await plot.focus();
  await page.keyboard.press("0");
  assert.equal(await plot.evaluate((canvas) => canvas.toDataURL()), before);
  await context.close();
});
