// The drawing is there at once, and moves smoothly.
import assert from "node:assert/strict";
import process from "node:process";
import { Worker } from "node:worker_threads";
import { after, before, test } from "node:test";
import { launch, newPage, open } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

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
