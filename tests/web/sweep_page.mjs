// sweep_page.mjs TOOLS REPORT.html: the page of a sweep.
import assert from "node:assert/strict";
import {accessible, again, close, dataOf, differ, download, fits, open, pages, picture, run, sound} from "./browser.mjs";

const [file] = pages;
const data = dataOf(file);
const places = (page) => page.locator("#sweep-map :is(.cell, .place) > *");

await run({
  async "what the sweep drove is drawn"() {
    const begun = Date.now();
    const page = await again(file);
    console.log(`  ${data.rows.length} points drawn after ${Date.now() - begun} ms`);
    assert.equal(await page.locator("h1").textContent(), `Sweep ${data.title}`);
    assert.ok(await places(page).count() >= Math.min(20, data.rows.filter((r) => !r.failed).length / 2), `${await places(page).count()} places`);
    const failed = data.rows.filter((r) => r.failed).length;
    if (failed) assert.ok(await page.locator("#sweep-map .fault > *").count() >= 1);
    if (data.rows.some((r) => r.unmet)) assert.ok(await page.locator("#sweep-map .unmet > *").count() >= 1);
    if (data.checks.length) assert.equal(await page.locator("#expectations table").first().locator("tbody tr").count(), data.checks.length);
    if (data.axes.some((a) => a.key === "effects.wheelbase.relative")) assert.ok(await page.locator("#figure-2 .recovered > *").count() >= data.rows.length / 2);
    await sound(page);
  },

  async "axes have names and units, not keys"() {
    const page = await again(file);
    const text = await page.locator("#sweep-map svg").textContent();
    for (const axis of data.axes) assert.ok(!text.includes(axis.key) || !axis.key.includes("."), `${axis.key} on the chart`);
    await sound(page);
  },

  async "any figure over any axes, as curves, map, or all axes side by side"() {
    const page = await again(file);
    const chart = page.locator("#sweep-map svg");
    const first = await picture(chart);
    await page.locator("[data-control=kind]").selectOption("parallel");
    assert.ok(await page.locator("#sweep-map .point path").count() >= Math.min(20, data.rows.filter((r) => !r.failed).length));
    differ(first, await picture(chart), "all axes side by side");
    await page.locator("[data-control=kind]").selectOption("map");
    assert.ok(await places(page).count() >= 1);
    const figures = page.locator("[data-control=figure] option");
    if (await figures.count() > 1) {
      const before = await chart.getAttribute("aria-label");
      await page.locator("[data-control=figure]").selectOption({index: await figures.count() - 1});
      assert.notEqual(await chart.getAttribute("aria-label"), before);
    }
    await page.locator("[data-control=log]").check();
    await page.locator("[data-control=kind]").selectOption("curves");
    await download(page, page.locator("#sweep-map [data-act=svg]"));
    await sound(page);
  },

  async "phone and dark mode"() {
    for (const options of [{}, {width: 390, height: 844, dark: true}]) {
      const page = await open(file, options);
      await fits(page);
      await accessible(page);
      await close(page);
    }
  },
});
