// What a student does with an answer: closed forms, practice, sweeps, the forces of strings, a body taken by a finger.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { findings, idle, launch, newPage, noSidewaysScroll, open, origin, placeOfBody, shell, turnTo } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

const post = async (endpoint, body) =>
  (
    await fetch(`${origin}/v1/${endpoint}`, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(body),
    })
  ).json();

/** A formula as the page shows it, without the signs that are not seen. */
const shown = async (locator) => (await locator.textContent()).replace(/[\s\u2061\u2062]/g, "");

test("closed forms stand beside the numbers, as mathematics, with what they assume", async () => {
  const { page, complaints, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/systems/rod_pendulum/modes", "table.modes");
  const { modes } = await post("modes", { system: "rod_pendulum" });
  const formulas = page.locator("table.modes .formula");
  assert.equal(await formulas.count(), modes.length);
  assert.equal(await formulas.first().getAttribute("title"), modes[0].exact.omega.text);
  assert.equal(await formulas.first().locator("msqrt").count(), 2);
  assert.equal(await shown(formulas.first()), "12(17−217)gl");
  assert.match(await page.locator(".assumes").textContent(), /l > 0, g > 0/);

  await open(page, "#/systems/free_spin_pendulum/turning", ".exact");
  assert.equal(await shown(page.locator(".exact .formula").first()), "12−cosθ+18(12+sinθ)2=0");
  await open(page, "#/systems/whirling_pendulum/bifurcations", "table");
  await page.locator(".formula").first().waitFor();
  assert.equal(await shown(page.locator(".formula").first()), "gl");

  await open(page, "#/systems/rotating_l_bar/equilibria", ".solver");
  await page.getByRole("button", { name: "Find" }).click();
  await page.locator(".result .formula").waitFor();
  assert.match(await page.locator(".result .formula").getAttribute("title"), /^sqrt\(3\*g/);
  assert.equal(await page.locator("code.formula").count(), 0, "every command of the service's LaTeX is known");
  assert.deepEqual(complaints, []);
  await context.close();
});

test("every formula of every system is set as mathematics", async () => {
  const { page, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/", ".vignette");
  const { systems } = await (await fetch(`${origin}/v1/systems`)).json();
  for (const { name } of systems) {
    const { accelerations, ...equations } = await post("equations", { system: name, form: "latex" });
    const all = [
      equations.T,
      equations.V,
      equations.L,
      ...equations.equations_of_motion.map((one) => one.equation),
      ...Object.values(accelerations ?? {}),
    ];
    for (const latex of all.filter(Boolean)) {
      const kind = await page.evaluate(async (text) => {
        const { formula } = await import("/page/formula.js");
        return formula({ text: "", latex: text }).localName;
      }, latex);
      assert.equal(kind, "span", `${name}: ${latex}`);
    }
  }
  const hostile = await page.evaluate(async () => {
    const { formula } = await import("/page/formula.js");
    return ["\\operatorname{<img src=x onerror=alert(1)>}", "\\left(\\left(", "{", "\\frac", "^", "}", "\\unknown"].map(
      (latex) => {
        const node = formula({ text: "<b>x</b>", latex });
        return node.querySelector("img, b, script") === null;
      },
    );
  });
  assert.ok(hostile.every(Boolean));
  await context.close();
});

test("practice: an answer is judged, and said to be read as it is", async () => {
  const { page, complaints, context } = await newPage(browser, { motion: "reduce" });
  await open(page, "#/systems/spring_pendulum/practice", "#practice-answer");
  await page.selectOption("#practice-question", "equation_theta");
  await page.waitForFunction(() => location.hash.includes("_question=equation_theta"));
  await idle(page);
  const check = async (text, verdict) => {
    await page.fill("#practice-answer", text);
    await page.getByRole("button", { name: "Check" }).click();
    await page.locator(".verdict strong", { hasText: verdict }).waitFor();
    await idle(page);
    return page.locator(".verdict").textContent();
  };
  await check("theta'' = -(2 l' theta' + g sin theta)/l", "Right.");
  assert.ok((await page.locator(".verdict .formula mover").count()) >= 1);
  assert.match(await check("l theta'' + 2 l' theta' - g sin theta = 0", "Wrong."), /wrong sign.*It is seen at/s);
  assert.match(await check("theta'' = -G/l", "It cannot be read."), /Unknown symbol 'G'/);
  assert.match(await check("theta'' = <img src=x onerror=alert(1)>", "It cannot be read."), /./);
  const line = await page.locator("pre.curl[data-endpoint=check]").textContent();
  assert.equal(JSON.parse(await shell(line)).items[0].correct, null);
  await page.selectOption("#practice-question", "omega");
  await idle(page);
  assert.equal(await page.locator(".verdict strong").count(), 0, "another question has no verdict yet");
  const { modes } = await post("modes", { system: "spring_pendulum" });
  await check(
    modes
      .map(({ omega }) => omega.toFixed(4))
      .reverse()
      .join(", "),
    "Right.",
  );
  await check(`${modes[0].omega.toFixed(4)}, 1`, "Wrong.");
  assert.deepEqual(await findings(page), []);
  assert.deepEqual(complaints, []);
  await context.close();
});

test("a sweep plots what the service answers, at any pointer, and a click takes the value there", async () => {
  const { page, complaints, context } = await newPage(browser, { motion: "reduce" });
  const swept = page.waitForResponse((response) => response.url().endsWith("/v1/sweep"));
  await open(page, "#/systems/cart_pendulum/sweep?_vary=k&_from=1&_to=60", "canvas.plot");
  const { columns } = await (await swept).json();
  const { modes } = await post("modes", { system: "cart_pendulum", parameters: { k: columns.k[30] } });
  assert.equal(columns.value[30], modes[0].omega);
  assert.match(await page.locator("canvas.plot").getAttribute("aria-label"), /between 0\.8128 and 4\.346 rad\/s/);
  await page.fill("#sweep-pointer", "/modes/1/shape/theta");
  await page.keyboard.press("Tab");
  await page.locator("figcaption", { hasText: "/modes/1/shape/theta" }).waitFor();
  await page.fill("#sweep-pointer", "/modes/7/omega");
  await page.keyboard.press("Tab");
  await page.getByText("101 of 101 rows have no value").waitFor();
  await page.fill("#sweep-pointer", "modes");
  await page.keyboard.press("Tab");
  await page.locator(".problem[role=alert]").waitFor();
  await page.fill("#sweep-pointer", "/modes/1/omega");
  await page.keyboard.press("Tab");
  await page.locator("canvas.plot").waitFor();
  await idle(page);
  const box = await page.locator("canvas.plot").boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + 100);
  await page.waitForFunction(() => /[?&]k=/.test(location.hash));
  assert.deepEqual(
    complaints.filter((text) => !/422/.test(text)),
    [],
  );
  await context.close();
});

test("practice and sweep open for every system, at a phone's width, and axe-core finds nothing", async () => {
  const { page, complaints, context } = await newPage(browser, { width: 360, motion: "reduce" });
  const { systems } = await (await fetch(`${origin}/v1/systems`)).json();
  await open(page, "#/");
  for (const { name } of systems) {
    await turnTo(page, `#/systems/${name}/practice`, "#practice-answer");
    await noSidewaysScroll(page);
    await turnTo(page, `#/systems/${name}/sweep`, "pre.curl[data-endpoint=sweep]");
    assert.equal(await page.locator(".view .problem").count(), 0, name);
    await noSidewaysScroll(page);
    assert.deepEqual(complaints.splice(0), [], name);
  }
  assert.deepEqual(await findings(page), []);
  await context.close();
});

for (const [name, column] of [
  ["orbiting_pendulum", "tension"],
  ["rod_pendulum", "tension"],
  ["rolling_disk_platform", "normal_force"],
]) {
  test(`${name}: an arrow shows the ${column}, as large as the answer has it`, async () => {
    const { page, complaints, context } = await newPage(browser, { motion: "reduce" });
    await open(page, `#/systems/${name}?t_end=0.4`, ".plot");
    const answer = await post("simulate", { system: name, times: [0.25], include: ["validity", "positions", "accelerations"] });
    const arrow = await page.evaluate(async () => {
      const { pictures } = await import("/page/stage.js");
      const { forces, reactions } = await import("/page/arrows.js");
      const { figure, motion } = pictures.get(document.querySelector("canvas.drawing"));
      const values = figure.known(motion.at(0.25));
      const [first] = reactions(figure, values, motion);
      // The arrows at the mass give it its acceleration.
      const h = 1e-3;
      const at = (t) => figure.masses.at(-1)?.at(figure.known(motion.at(t)));
      const [a, b, c] = [at(0.25 - h), at(0.25), at(0.25 + h)];
      const needed = b?.map((x, i) => (figure.masses.at(-1).mass * (a[i] - 2 * x + c[i])) / (h * h));
      const weight = figure.gravity.map((g) => g * (figure.masses.at(-1)?.mass ?? 0));
      return { ...first, needed, weight, others: forces(figure, values).length };
    });
    const size = answer.trajectory[column][0];
    assert.ok(Math.abs(Math.hypot(...arrow.vector) - size) < 1e-3 * size, `${Math.hypot(...arrow.vector)} for ${size}`);
    if (arrow.needed)
      arrow.needed.forEach((force, i) =>
        assert.ok(
          Math.abs(arrow.vector[i] + (arrow.weight[i] ?? 0) - force) < 0.02 * size,
          `${arrow.vector} and ${arrow.weight} for ${arrow.needed}`,
        ),
      );
    const picture = () => page.locator("canvas.drawing").evaluate((canvas) => canvas.toDataURL());
    const before = await picture();
    await page.getByLabel("forces").check();
    assert.notEqual(await picture(), before);
    assert.deepEqual(complaints, []);
    await context.close();
  });
}

test("a finger takes a body up and down, and beside it moves the page", async () => {
  const { page, complaints, context } = await newPage(browser, { width: 360, height: 740, motion: "reduce", touch: true });
  await open(page, "#/systems/spring_pendulum", ".plot");
  const place = await placeOfBody(page);
  const session = await page.context().newCDPSession(page);
  const touch = (type, points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  const drag = async ([x, y], [dx, dy]) => {
    await touch("touchStart", [{ x, y }]);
    for (let i = 1; i <= 12; ++i) await touch("touchMove", [{ x: x + (dx * i) / 12, y: y + (dy * i) / 12 }]);
    await touch("touchEnd", []);
  };
  await drag(place, [0, -60]);
  await page.waitForFunction(() => /[?&]l=/.test(location.hash));
  await idle(page);
  const values = new URLSearchParams(new URL(page.url()).hash.split("?")[1]);
  assert.ok(Number(values.get("l")) < 0.5, `the spring is ${values.get("l")} long after a drag upwards`);
  assert.equal(await page.evaluate(() => window.scrollY), 0, "the page stays while a body is held");
  const address = page.url();
  const box = await page.locator("canvas.drawing").boundingBox();
  await drag([box.x + 20, box.y + box.height - 20], [0, -200]);
  await page.waitForFunction(() => window.scrollY > 50);
  assert.equal(page.url(), address, "beside the body nothing is taken");
  assert.deepEqual(complaints, []);
  await context.close();
});
