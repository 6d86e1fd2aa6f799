// speed_page.mjs TOOLS REPORT.html: how soon a page shows its first chart and its first 3D picture, and how large it is.
import assert from "node:assert/strict";
import {statSync} from "node:fs";
import {close, open, pages, run} from "./browser.mjs";

const [file] = pages;
const kLargest = 3 * 1024 * 1024;

await run({
  async "size"() {
    console.log(`  ${(statSync(file).size / 1e6).toFixed(2)} MB`);
    assert.ok(statSync(file).size <= kLargest);
  },
  async "times"() {
    const page = await open(file, {hash: "#replay"});
    await page.waitForSelector("canvas[data-frames]");
    const [chart, frame] = await page.evaluate(() => ["first-chart", "first-frame"].map((name) => performance.getEntriesByName(name)[0]?.startTime));
    console.log(`  first chart after ${Math.round(chart)} ms, first 3D picture after ${Math.round(frame)} ms`);
    assert.ok(chart > 0 && frame > chart);
    await close(page);
  },
});
