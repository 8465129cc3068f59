// What is drawn is what was answered, at once and smoothly.
import assert from "node:assert/strict";
import process from "node:process";
import { Worker } from "node:worker_threads";
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

/** The times between 180 frames, sorted, and the longest task among them, in milliseconds. */
function watchFrames(page) {
  return page.evaluate(
    () =>
      new Promise((resolve) => {
        window.long.length = 0;
        const times = [];
        const step = (now) => {
          times.push(now);
          if (times.length < 180) requestAnimationFrame(step);
          else
            resolve({
              frames: times
                .slice(1)
                .map((t, i) => t - times[i])
                .sort((a, b) => a - b),
              long: Math.max(0, ...window.long),
            });
        };
        requestAnimationFrame(step);
      }),
  );
}

/** What two threads that only count get of two processors: less than all where other programs run. */
async function shareOfProcessors() {
  const counting = "const end = performance.now() + 300; while (performance.now() < end);";
  const before = process.cpuUsage();
  const began = performance.now();
  await Promise.all([1, 2].map(() => new Promise((done) => new Worker(counting, { eval: true }).on("exit", done))));
  const { user, system } = process.cpuUsage(before);
  return (user + system) / 1000 / (2 * (performance.now() - began));
}

const turns = [
  ["cart_pendulum", "Cart"],
  ["spring_pendulum", "Spring"],
];

/// From the change of the address to the first pixel [ms].
function timeOfFirstDrawing(page, name, title) {
  return page.evaluate(
    ([name, title]) =>
      new Promise((resolve) => {
        location.hash = `#/systems/${name}`;
        const began = performance.now();
        const look = () => {
          const canvas = document.querySelector("canvas.drawing");
          const isDrawn =
            document.querySelector("h1")?.textContent.startsWith(title) &&
            canvas?.width > 0 &&
            canvas
              .getContext("2d")
              .getImageData(0, 0, canvas.width, canvas.height)
              .data.some((value) => value > 0);
          if (isDrawn) resolve(performance.now() - began);
          else requestAnimationFrame(look);
        };
        look();
      }),
    [name, title],
  );
}

test("the first drawing is there within 300 ms, and it plays at 60 frames a second without a long task, with 10,000 rows", async () => {
  const share = [await shareOfProcessors()];
  const { page, context } = await newPage(browser);
  await page.addInitScript(() => {
    window.long = [];
    new PerformanceObserver((list) => list.getEntries().forEach((entry) => window.long.push(Math.round(entry.duration)))).observe(
      { type: "longtask", buffered: true },
    );
  });
  await open(page, "#/", ".vignette");
  await page.evaluate(() => {
    location.hash = "#/systems/spring_pendulum";
  });
  await page.locator("canvas.plot").first().waitFor();
  // Another program may take the processor for a while: the best of five tries is what the page can do.
  const tries = [];
  for (const [name, title] of [...turns, ...turns, turns[0]]) {
    if (!tries.some((time) => time < 300)) tries.push(await timeOfFirstDrawing(page, name, title));
  }
  await open(page, "#/systems/spring_pendulum?t_end=166", ".plot");
  await page.waitForTimeout(500);
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  const worked = async () =>
    (await session.send("Performance.getMetrics")).metrics.find(({ name }) => name === "TaskDuration").value;
  const attempts = [];
  for (let i = 0; i < 5 && !attempts.some(({ late, long }) => late < 20 && long <= 100); ++i) {
    const before = await worked();
    const { frames, long } = await watchFrames(page);
    attempts.push({
      late: frames[Math.floor(0.95 * frames.length)],
      long,
      work: (1000 * ((await worked()) - before)) / frames.length,
    });
  }
  await context.close();
  share.push(await shareOfProcessors());
  const said = JSON.stringify({ tries, attempts, share });
  assert.ok(Math.min(...attempts.map(({ work }) => work)) < 10, said);
  // How long that takes by the clock tells of the page only where no other program has the processors.
  if (Math.min(...share) < 0.9) return;
  assert.ok(
    tries.some((time) => time < 300),
    said,
  );
  assert.ok(
    attempts.some(({ late, long }) => late < 20 && long <= 100),
    said,
  );
});
