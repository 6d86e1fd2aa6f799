// malice.mjs TOOLS REPORT.html: texts of a page that try to become markup stay text. The page is one that the program wrote, of a
// scenario with such texts.
import assert from "node:assert/strict";
import {close, dataOf, open, pages, run} from "./browser.mjs";

const [file] = pages;

await run({
  async "a malicious title, robot and run stay text"() {
    const data = dataOf(file);
    assert.ok(JSON.stringify(data).includes("onerror"), "the page holds what it is tried with");
    const page = await open(file, {hash: "#replay"});
    await page.waitForTimeout(800);
    assert.equal(await page.locator("h1").textContent(), data.title);
    assert.equal(await page.title(), data.title.replace(/\s+/g, " ").trim());
    assert.equal(await page.locator("img").count(), 0);
    assert.equal(await page.evaluate(() => window.broken), undefined);
    await close(page);
  },
});
