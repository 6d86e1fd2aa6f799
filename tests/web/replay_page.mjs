// replay_page.mjs TOOLS REPORT.html: the 3D replay of a run.
import assert from "node:assert/strict";
import {close, dataOf, differ, open, pages, picture, run, sound} from "./browser.mjs";

const [file] = pages;
const data = dataOf(file);
const runs = data.runs.filter((r) => (r.truth ?? r.recorded)?.length > 1);
const poses = (r) => r.truth ?? r.recorded;

const shared = {};

// The page with its picture; the same for all parts of the test that ask for nothing else.
async function started(options) {
  const page = (!options && shared.page) || await open(file, {hash: "#replay", ...options});
  if (!options) shared.page = page;
  await page.locator("#replay").scrollIntoViewIfNeeded();
  await page.waitForSelector("canvas[data-frames]");
  return page;
}
const pose = async (page) => JSON.parse(await page.locator("canvas").getAttribute("data-pose"));
const seek = (page, share) => page.locator("#replay .time input").fill(String(Math.round(1000 * share)));
const turn = (a, b) => Math.abs(Math.atan2(Math.sin(a - b), Math.cos(a - b)));

await run({
  async "the robot stands where the data say, at the beginning and at the end of every run"() {
    const page = await started();
    for (const [i, r] of runs.entries()) {
      await page.locator("[data-replay=run]").selectOption(String(i));
      for (const [share, at] of [[0, 0], [1, poses(r).length - 1]]) {
        await seek(page, share);
        const shown = await pose(page);
        const [x, y, theta] = poses(r)[at];
        assert.ok(Math.hypot(shown[0] - x, shown[1] - y) < 1e-5, `${r.id}: ${shown} is shown, ${poses(r)[at]} recorded`);
        assert.ok(turn(shown[2], theta) < 1e-5, `${r.id}: ${shown} is shown, ${poses(r)[at]} recorded`);
      }
      const end = r.wheels?.at(-1);
      if (!end) continue;
      const angles = JSON.parse(await page.locator("canvas").getAttribute("data-wheels"));
      for (const w of [0, 1]) assert.ok(Math.abs(angles[w] - end[w]) < 1e-6, `${r.id}: wheels at ${angles}, recorded ${end}`);
    }
    await sound(page);
  },

  async "it plays, pauses, and the charts' cursors go along"() {
    const page = await started();
    await page.locator("[data-replay=run]").selectOption("0");
    await seek(page, 0);
    const still = await picture(page.locator("canvas"));
    const from = await pose(page);
    await page.locator("[data-replay=speed]").selectOption("10");
    await page.locator("[data-play=toggle]").click();
    await page.waitForFunction((x) => JSON.parse(document.querySelector("canvas").dataset.pose)[0] !== x, from[0]);
    await page.waitForTimeout(700);
    await page.locator("[data-play=toggle]").click();
    await page.waitForTimeout(200);
    differ(still, await picture(page.locator("canvas")), "driving");
    const stopped = await pose(page);
    await page.waitForTimeout(200);
    assert.deepEqual(await pose(page), stopped, "it stands while it pauses");
    if (await page.locator("#path-0").count()) {
      assert.equal(await page.locator("#growth-position .cursor line").count(), 1);
      assert.equal(await page.locator("#figure-2 .cursor circle").count(), 1);
    }
    await sound(page);
  },

  async "camera, ghosts and keys"() {
    const page = await started();
    await seek(page, 0.6);
    await page.waitForTimeout(150);
    const canvas = page.locator("canvas");
    const views = [];
    for (const view of ["whole", "follow", "above"]) {
      await page.locator("[data-replay=view]").selectOption(view);
      await page.waitForTimeout(250);
      views.push(await picture(canvas));
    }
    differ(views[0], views[1], "follow");
    differ(views[1], views[2], "above");
    await page.locator("[data-replay=view]").selectOption("follow");
    const before = await pose(page);
    await canvas.focus();
    for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowLeft");
    assert.notDeepEqual(await pose(page), before);
    if (await page.locator("[data-replay=ghosts]").count()) {
      await page.waitForTimeout(250);
      const withGhosts = await picture(canvas);
      await page.locator("[data-replay=ghosts]").uncheck();
      await page.waitForTimeout(250);
      differ(withGhosts, await picture(canvas), "ghosts");
    }
    await sound(page);
  },

  async "a click on a curve takes the robot there"() {
    const page = await started();
    if (!await page.locator("#growth-position").count()) return sound(page);
    await page.locator("#growth-position").scrollIntoViewIfNeeded();
    const box = await page.locator("#growth-position svg").boundingBox();
    const before = await pose(page);
    await page.mouse.click(box.x + 0.7 * box.width, box.y + 0.5 * box.height);
    assert.notDeepEqual(await pose(page), before);
    await sound(page);
  },

  async "phone and dark mode"() {
    const page = await started({width: 390, height: 844, dark: true});
    await picture(page.locator("canvas"));
    await close(page);
  },
});
