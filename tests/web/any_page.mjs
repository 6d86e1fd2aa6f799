// any_page.mjs TOOLS REPORT.html [REPORT.html...]: pages of every other kind: each opens, fits, is accessible, and shows what
// its data name.
import assert from "node:assert/strict";
import {accessible, close, dataOf, fits, open, pages, picture, run} from "./browser.mjs";

/// Words of the data that must stand on the page.
const WORDS = {
  calibration: (d) => [d.calibration.method, ...d.calibration.comparison.methods.map((m) => m.name)],
  explanation: (d) => d.explanation.effects.map((e) => e.name.replace(/_/g, " ")),
  plan: (d) => d.plan.menu.map((m) => m.run),
  prediction: (d) => Object.keys(Object.values(d.prediction.predictions)[0].runs),
  score: (d) => d.score.verdicts.map((v) => v.name),
  index: (d) => d.results.map((r) => r.name),
  recording: (d) => d.runs.map((r) => r.id),
  run: (d) => d.runs.map((r) => r.id)};

await run(Object.fromEntries(pages.map((file) => {
  const data = dataOf(file);
  return [`${data.page}: ${data.title}`, async () => {
    const page = await open(file);
    assert.equal(await page.locator("h1").textContent(), data.title);
    const text = await page.evaluate(() => document.getElementById("report").textContent);
    for (const word of WORDS[data.page](data)) assert.ok(text.includes(word), `"${word}" is not on the page`);
    assert.ok(await page.locator("table").count() >= 1);
    await picture(page.locator("main"));
    await fits(page);
    await accessible(page);
    await close(page);
    const phone = await open(file, {width: 390, height: 844, dark: true});
    await fits(phone);
    await accessible(phone);
    await close(phone);
  }];
})));
