// any_page.mjs TOOLS REPORT.html [REPORT.html...]: pages of every other kind: each opens, fits, is accessible, and shows what
// its data name.
import assert from "node:assert/strict";
import {accessible, close, dataOf, fits, open, pages, picture, run, tablesFit} from "./browser.mjs";

/// Words of the data that must stand on the page.
const WORDS = {
  calibration: (d) => [d.calibration.method, ...d.calibration.comparison.methods.map((m) => m.name)],
  explanation: (d) => d.explanation.effects.map((e) => e.name.replace(/_/g, " ")),
  plan: (d) => d.plan.menu.map((m) => m.run),
  prediction: (d) => Object.keys(Object.values(d.prediction.predictions)[0].runs),
  score: (d) => (Array.isArray(d.score.verdicts) ? d.score.verdicts.map((v) => v.name) : Object.keys(d.score.verdicts)),
  index: (d) => d.results.map((r) => r.name),
  recording: (d) => d.runs.map((r) => r.id),
  run: (d) => d.runs.map((r) => r.id)};

/// What more a page of a kind holds.
const CHECKS = {
  async plan(page, {plan}) {
    for (const [id, r] of [["these-runs", plan.these_runs], ["recommended-result", plan.recommended?.result]]) {
      if (!r?.confusion) continue;
      const shown = r.confusion.probability.flat().filter((p) => p >= 0.005);
      assert.equal(await page.locator(`#${id}-matrix .counts text`).count(), shown.length, `cells of ${id}`);
      assert.ok((await page.locator(`#${id}`).textContent()).includes(`${r.separated_pairs} of ${r.pairs} pairs`));
    }
    assert.equal(await page.locator("#recommended table").first().locator("tbody tr").count(), plan.recommended.runs.length);
  },
  async explanation(page, d) {
    const directions = Object.keys(d.explanation.whole).length;
    assert.ok(await page.locator("#figure-1 .share path").count() >= directions * d.explanation.effects.length);
    assert.equal(await page.locator("[data-replay=run] option").count(), d.runs.length);
  }};

/// The arrow keys read the values of the first chart.
async function readByKeys(page) {
  const chart = page.locator(".chart").first();
  if (!await chart.count()) return;
  await chart.locator(".plot").focus();
  await page.keyboard.press("ArrowRight");
  assert.ok((await chart.locator(".said").textContent()).length > 3, "nothing is read");
  await page.keyboard.press("Escape");
}

await run(Object.fromEntries(pages.map((file) => {
  const data = dataOf(file);
  return [`${data.page}: ${data.title}`, async () => {
    const page = await open(file);
    assert.equal(await page.locator("h1").textContent(), data.title);
    const text = await page.evaluate(() => document.getElementById("report").textContent);
    for (const word of WORDS[data.page](data)) assert.ok(text.includes(word), `"${word}" is not on the page`);
    assert.ok(await page.locator("table").count() >= 1);
    await picture(page.locator("main"));
    await CHECKS[data.page]?.(page, data);
    await readByKeys(page);
    await fits(page);
    await tablesFit(page);
    await accessible(page);
    await close(page);
    const phone = await open(file, {width: 390, height: 844, dark: true});
    await fits(phone);
    await accessible(phone);
    await close(phone);
  }];
})));
