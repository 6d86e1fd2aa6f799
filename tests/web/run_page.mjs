// run_page.mjs TOOLS REPORT.html: the page of a run shows its data. What a reader does with it: run_use.mjs.
import assert from "node:assert/strict";
import {accessible, again, close, dataOf, differ, fits, open, pages, picture, run, same, sound} from "./browser.mjs";

const [file] = pages;
const data = dataOf(file);
const summary = data.summary;
const stages = (stage) => data.runs.filter((r) => (r.stage ?? "before") === stage && r.error);
const tracked = data.runs.filter((r) => r.truth?.length > 1);
const directions = [...new Set(tracked.map((r) => r.direction))];
const value = (page, name) => page.locator(".tile", {has: page.locator("dt", {hasText: name})}).locator(".value").textContent();

await run({
  async "figures are those of the data"() {
    const page = await again(file);
    assert.equal(await page.locator("h1").textContent(), data.title);
    if (summary.umbmark) same(await value(page, "before"), summary.umbmark.e_max_syst_m * 1000, "E_max");
    const applied = summary.calibration?.applied;
    if (applied && applied !== "none") {
      same(await value(page, "wheel diameters"), summary.calibration[applied].e_d, "E_d");
      same(await value(page, "wheelbase"), summary.calibration[applied].e_b, "E_b");
    }
    const rows = await page.locator("#runs tbody tr").all();
    assert.equal(rows.length, data.runs.filter((r) => r.error).length);
    for (const [i, row] of rows.entries()) {
      const cells = await row.locator("td").allTextContents();
      const {x_m, y_m} = data.runs[i].error;
      assert.ok((await row.locator("th").textContent()).includes(data.runs[i].id));
      same(cells[1], x_m * 1000, "e_x");
      same(cells[2], y_m * 1000, "e_y");
    }
    await sound(page);
  },

  async "every run is drawn"() {
    const page = await again(file);
    const shown = ["before", "bumped", "after"].filter((s) => stages(s).length);
    const visible = shown.filter((s) => s !== "bumped" || shown.length === 1);
    const dots = await page.locator("#scatter-all .end-point > *").count();
    assert.equal(dots, visible.reduce((n, s) => n + stages(s).length, 0));
    assert.equal(await page.locator("#figure-2 .truth path").count(), directions.length);
    assert.equal(await page.locator("#figure-2 .odometry path").count(), directions.length);
    assert.equal(await page.locator("#figure-3 .series path").count(), 2 * directions.length);
    if (summary.umbmark) assert.ok(await page.locator("#scatter-all .emax path").count() >= 1);
    if (data.bumps.length) {
      assert.equal(await page.locator("#extended-chart .cable > *").count(), data.bumps.filter((b) => tracked.some((r) => r.id === b.run)).length);
    }
    await picture(page.locator("#figure-1"));
    await sound(page);
  },

  async "the worked calculation ends at the summary's figures"() {
    const page = await again(file);
    const results = await page.locator("[data-result]").all();
    if (summary.umbmark && data.wheelbase_m) assert.ok(results.length >= 11, `${results.length} results`);
    for (const result of results) {
      const key = await result.getAttribute("data-result");
      const known = key.split(".").reduce((at, k) => at?.[k], summary.umbmark);
      const text = await result.textContent();
      same(text, /_m$/.test(key) ? known * 1000 : known, key);
    }
    await sound(page);
  },

  async "tips come by pointer and by arrow keys, with units"() {
    const page = await again(file);
    const chart = page.locator("#scatter-all");
    const tip = chart.locator(".tip tspan");
    await chart.locator(".end-point > *").first().hover({force: true});
    assert.ok((await tip.allTextContents()).join(" ").includes("mm"));
    await page.mouse.move(2, 2);
    await chart.locator(".plot").focus();
    const read = [];
    for (let i = 0; i < 2; ++i) {
      await page.keyboard.press("ArrowRight");
      await page.waitForFunction(() => document.querySelector("#scatter-all .said").textContent !== "");
      await page.waitForTimeout(60);
      read.push(await chart.locator(".said").textContent());
    }
    assert.match(read[0], /mm/);
    if (data.runs.length > 1) assert.notEqual(read[0], read[1]);
    await page.keyboard.press("Escape");
    await sound(page);
  },

  async "phone and dark mode"() {
    const page = await again(file);
    const light = await picture(page.locator("#figure-1"));
    await fits(page);
    await accessible(page);
    await page.emulateMedia({colorScheme: "dark"});
    differ(light, await picture(page.locator("#figure-1")), "dark mode");
    await accessible(page);
    await close(page);
    const phone = await open(file, {width: 390, height: 844, touch: true});
    await fits(phone);
    await picture(phone.locator("#figure-2"));
    await accessible(phone);
    await close(phone);
  },
});
