// gap_page.mjs TOOLS REPORT.html: the page of a gap diagnosis.
import assert from "node:assert/strict";
import {accessible, again, close, dataOf, differ, download, fits, open, pages, picture, run, same, sound, tablesFit} from "./browser.mjs";

const [file] = pages;
const data = dataOf(file);
const d = data.diagnosis;
const groups = [...new Set(data.runs.map((r) => r.direction))];
const twins = data.runs.filter((r) => r.after).length;

await run({
  async "verdict, figures and causes are those of the data"() {
    const page = await again(file);
    assert.equal((await page.locator(".headline").textContent()).trim(), d.verdict);
    const tile = (name) => page.locator(".tile", {has: page.locator("dt", {hasText: name})}).first().locator(".value").textContent();
    same(await tile("Off by"), d.gap.before_mm, "off by");
    same(await tile("Noise floor"), d.gap.noise_floor_mm, "noise floor");
    for (const heading of ["Where", "Which", "How far", "What next"]) assert.equal(await page.locator("h2", {hasText: heading}).count(), 1);
    const rows = page.locator("#which table").first().locator("tbody tr");
    assert.ok(await rows.count() >= 1);
    const first = (await rows.first().locator("th").textContent()).replace(/ \+ /g, "+").replace(/ /g, "_");
    assert.equal(first, Object.keys(d.causes[0].effects).sort().join("+"));
    await sound(page);
  },

  async "runs that repeat each other share a panel, and differences show from the start"() {
    const page = await again(file);
    assert.equal(await page.locator("#where .truth path").count(), groups.length);
    assert.equal(await page.locator("#where .odometry path").count(), groups.length);
    assert.equal(await page.locator("#where .twin path").count(), twins ? groups.length : 0);
    const repeats = data.runs.length - groups.length;
    assert.equal(await page.locator("#where .repeat path").count(), 2 * repeats);
    assert.equal(await page.locator("#gap-ends .end-point > *").count(), data.runs.length + twins);
    if (d.where.place_m) assert.equal(await page.locator("#where .place circle").count() + await page.locator("#where .place path").count(), groups.length);
    const slider = page.locator("#where input[type=range]");
    const path = page.locator("#gap-path-0 .odometry path");
    const before = await path.getAttribute("d");
    await slider.fill("0");
    assert.equal(await page.locator("#where output").textContent(), "\u00d71");
    const one = await path.getAttribute("d");
    await slider.fill("6");
    assert.notEqual(await path.getAttribute("d"), one);
    if (d.gap.detected) assert.notEqual(before, one, "an error that shows is enlarged at first");
    await sound(page);
  },

  async "every scored part is in the strip"() {
    const page = await again(file);
    const scored = d.where.segments.filter((s) => s.score > 0).length;
    assert.equal(await page.locator("#gap-strip .segment > *").count(), scored);
    await sound(page);
  },

  async "nothing is cut off at 390 px and at 1280 px"() {
    for (const [width, height] of [[390, 844], [1280, 900]]) {
      const page = await open(file, {width, height});
      await fits(page);
      await tablesFit(page);
      await accessible(page);
      await close(page);
    }
  },

  async "saved, and dark"() {
    const page = await again(file);
    const light = await picture(page.locator("#where"));
    const csv = await download(page, page.locator("#which [data-save=csv]"));
    assert.ok(csv.bytes.toString().split("\n").length >= 2);
    await close(page);
    const dark = await open(file, {dark: true});
    differ(light, await picture(dark.locator("#where")), "dark mode");
    await accessible(dark);
    await close(dark);
  },
});
