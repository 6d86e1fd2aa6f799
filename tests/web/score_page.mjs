// score_page.mjs TOOLS REPORT.html: the score of a trial, or of the proving ground with its engines.
import assert from "node:assert/strict";
import {again, dataOf, differ, download, pages, picture, run, sound} from "./browser.mjs";

const [file] = pages;
const data = dataOf(file);
const s = data.score;
const verdicts = Array.isArray(s.verdicts) ? s.verdicts : Object.entries(s.verdicts).map(([name, v]) => ({...v, name}));
const engines = [...new Set(verdicts.map((v) => v.engine).filter(Boolean))];
/// The numbers in the cells of the matrix.
const counted = async (page) => (await page.locator("#confusion-matrix .counts text").allTextContents()).map(Number).reduce((a, b) => a + b, 0);
const choose = (page, control, value) => page.locator(`#confusion [data-control=${control}]`).selectOption(value);

await run({
  async "every case is counted in one cell, and the right ones are framed"() {
    const page = await again(file);
    if (await page.locator("#confusion [data-control=kind]").count()) await choose(page, "kind", "all");
    assert.equal(await counted(page), verdicts.length);
    assert.equal(await page.locator("#confusion .counted").textContent(), `first cause right in ${verdicts.filter((v) => v.right).length} of ${verdicts.length}`);
    const right = await page.locator("#confusion-matrix .right > *").count();
    assert.equal(right > 0, verdicts.some((v) => v.right));
    await picture(page.locator("#confusion"));
    await sound(page);
  },

  async "the matrix of one engine holds its cases alone"() {
    const page = await again(file);
    assert.equal(await page.locator("#confusion [data-control=engine]").count(), engines.length > 1 ? 1 : 0);
    for (const engine of engines.length > 1 ? engines : []) {
      await choose(page, "engine", engine);
      assert.equal(await counted(page), verdicts.filter((v) => v.engine === engine).length, engine);
    }
    if (engines.length > 1) await choose(page, "engine", "");
    await sound(page);
  },

  async "a cell leads to its cases, and a case to its diagnosis"() {
    const page = await again(file);
    const cell = page.locator("#confusion-matrix a").first();
    const id = decodeURIComponent((await cell.getAttribute("href")).slice(1));
    const list = page.locator(`[id="${id}"]`);
    assert.equal(await list.evaluate((e) => e.open), false);
    await cell.click({force: true});
    await page.waitForFunction((at) => document.getElementById(at).open, id);
    const names = await list.locator("tbody th").allTextContents();
    assert.ok(names.length >= 1 && names.every((n) => verdicts.some((v) => v.name === n)), names.join());
    for (const name of names) assert.equal(await list.locator(`a[href="${data.links[name]}"]`).count(), data.links[name] ? 1 : 0);
    assert.equal(await page.locator("#cases tbody tr").count(), verdicts.length);
    await sound(page);
  },

  async "detection and calibration are those of the data, by engine"() {
    const page = await again(file);
    const groups = engines.length > 1 ? Object.values(s.by.engine) : [s.all ?? s];
    for (const [id, key] of [["detection", "by_severity"], ["probability", "calibration"]]) {
      const bins = groups.flatMap((g) => g[key]).filter((b) => b.cases);
      assert.equal(await page.locator(`#${id} .bin > *`).count(), bins.length, id);
      if (!bins.length) continue;
      await page.locator(`#${id} .plot`).focus();
      await page.keyboard.press("ArrowRight");
      const said = await page.locator(`#${id} .said`).textContent();
      const share = Math.round(100 * (bins[0].detected_share && id === "detection" ? bins[0].detected_share : bins[0].right_share).value);
      assert.ok(said.includes(`${share}\u00a0%`), `${said}: ${share} % in the data`);
    }
    await sound(page);
  },

  async "saved, and another choice is another picture"() {
    const page = await again(file);
    const svg = await download(page, page.locator("#confusion-matrix [data-act=svg]"));
    assert.match(svg.bytes.toString(), /<svg[^>]*xmlns/);
    if (engines.length < 2) return;
    const before = await picture(page.locator("#confusion"));
    await choose(page, "engine", engines[0]);
    differ(before, await picture(page.locator("#confusion")), engines[0]);
    await sound(page);
  },
});
