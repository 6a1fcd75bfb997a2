// Fingers on the page: one paints, two move, zoom and turn the view, a tap of two undoes and one of three redoes.

import assert from "node:assert/strict";
import { resolve } from "node:path";
import { test } from "node:test";
import { pictures } from "./browser.mjs";
import { fingers, inspect, openStudio, prepared, rest, setUp } from "./studio.mjs";

const stage = setUp();

/** Where the canvas lies: its middle, its diagonal and the direction of that, in px and degrees. */
function placed({ corners: [[left, top], [right, bottom]] }) {
  const [x, y] = [right - left, bottom - top];
  return {
    middle: [(left + right) / 2, (top + bottom) / 2],
    size: Math.hypot(x, y), angle: (Math.atan2(y, x) * 180) / Math.PI,
  };
}

/** Moves two fingers from the points `from` to the points `to`. */
async function gesture(touch, page, from, to, steps = 12) {
  await touch("touchStart", from);
  for (let step = 1; step <= steps; step++) {
    const share = step / steps;
    await touch("touchMove", from.map((point, at) => point.map((value, axis) => value + share * (to[at][axis] - value))));
    await page.waitForTimeout(30);
  }
  await page.waitForTimeout(100);
  await touch("touchEnd");
  await page.waitForTimeout(500);
}

const near = (found, wanted, by, what) =>
  assert.ok(Math.abs(found - wanted) <= by, `${what}: ${found} instead of ${wanted}`);

test("one finger paints; two move, zoom and turn the view and paint nothing; taps undo and redo", async () => {
  const context = await stage.context({ colorScheme: "light", hasTouch: true });
  const faults = [];
  const { page } = await openStudio(context, stage.server.address, faults);
  const touch = await fingers(page);
  await touch("touchStart", [[300, 200]]);
  for (let at = 1; at < 30; at++) {
    await touch("touchMove", [[300 + 8 * at, 200 + 2 * at]]);
    await page.waitForTimeout(10);
  }
  await touch("touchEnd");
  await rest(page);
  const painted = await inspect(page);
  assert.ok(painted.history[0] > 0, "one finger has painted");
  assert.ok(painted.history.every((count) => count === painted.history[0]));

  const before = placed(painted);
  await gesture(touch, page, [[400, 250], [500, 250]], [[460, 290], [560, 290]]);
  const moved = placed(await inspect(page));
  near(moved.middle[0] - before.middle[0], 60, 12, "moved to the right");
  near(moved.middle[1] - before.middle[1], 40, 12, "moved down");
  near(moved.size, before.size, 0.01 * before.size, "not zoomed");
  near(moved.angle, before.angle, 0.5, "not turned");

  await gesture(touch, page, [[450, 300], [550, 300]], [[400, 300], [600, 300]]);
  const zoomed = placed(await inspect(page));
  near(zoomed.size / moved.size, 2, 0.2, "zoomed by the distance of the fingers");
  near(zoomed.angle, before.angle, 0.5, "not turned");

  const turn = (degrees) => [-60, 60].map((radius) => {
    const angle = (degrees * Math.PI) / 180;
    return [500 + radius * Math.cos(angle), 300 + radius * Math.sin(angle)];
  });
  // Along the circle, so that nothing is zoomed.
  await touch("touchStart", turn(0));
  for (let degrees = 3; degrees <= 45; degrees += 3) {
    await touch("touchMove", turn(degrees));
    await page.waitForTimeout(30);
  }
  await page.waitForTimeout(100);
  await touch("touchEnd");
  await page.waitForTimeout(500);
  const turned = placed(await inspect(page));
  near(turned.angle - zoomed.angle, 45, 6, "turned with the fingers");
  near(turned.size / zoomed.size, 1, 0.08, "not zoomed");
  await page.screenshot({ path: resolve(pictures, "studio-turned.png") });
  const after = await inspect(page);
  assert.deepEqual(after.history, painted.history, "two fingers paint nothing");

  // A tap that a slow frame makes too long is none: it is tapped again.
  const tap = async (points, done) => {
    for (let trial = 0; trial < 4; trial++) {
      await touch("touchStart", points);
      await page.waitForTimeout(50);
      await touch("touchEnd");
      await page.waitForTimeout(1500);
      if ((await inspect(page)).history[0] === done) return;
    }
    assert.fail(`no tap of ${points.length} fingers was heard: ${JSON.stringify(await inspect(page))}`);
  };
  const [done, all] = painted.history;
  await tap([[500, 300], [580, 310]], done - 1);
  await tap([[500, 300], [580, 310], [540, 350]], done);
  assert.equal((await inspect(page)).history[1], all, "taps paint nothing");
  assert.deepEqual(faults, [], "nothing is wrong in the browser's console");
  await context.close();
});

test("on a touch device the targets are large, unless the painter chose otherwise", async () => {
  for (const [phone, chosen, large] of [[false, null, false], [true, null, true], [true, false, false]]) {
    const context = await stage.context({ viewport: { width: 844, height: 700 }, hasTouch: phone });
    if (chosen !== null) await prepared(context, stage.server.address, { touch_targets: chosen });
    const { page } = await openStudio(context, stage.server.address);
    assert.equal((await inspect(page)).touch_targets, large, `phone: ${phone}, chosen: ${chosen}`);
    if (large) await page.screenshot({ path: resolve(pictures, "studio-fingers.png") });
    await context.close();
  }
});
