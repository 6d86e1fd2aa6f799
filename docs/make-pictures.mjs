// make-pictures.mjs TOOLS RESULTS IMAGES: the pictures of the documents, from pages that the program wrote: RESULTS/umbmark,
// RESULTS/extended_umbmark, RESULTS/recovery (the sweep) and RESULTS/case-06 (a diagnosis), those that are there. TOOLS: where the
// pages' tests keep their packages (build/release/tests/web/tools).
import {existsSync} from "node:fs";
import {createRequire} from "node:module";
import {join, resolve} from "node:path";

const [tools, results, images] = process.argv.slice(2).map((path) => resolve(path));
const {chromium} = createRequire(join(tools, "package.json"))("playwright-core");
const browser = await chromium.launch({executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader"]});

// take(RESULT, WIDTH, PICTURE, what): the picture is the element that `what` gives, with some air about it.
async function take(name, width, picture, what) {
  const file = join(results, name, "report.html");
  if (!existsSync(file)) return console.log(`${picture}: no ${name}, left as it is`);
  const page = await (await browser.newContext({viewport: {width, height: 900}})).newPage();
  await page.goto(`file://${file}`);
  await page.waitForFunction(() => document.body.dataset.drawn === "true", null, {timeout: 120_000});
  await page.addStyleTag({content: "figcaption, .chart-tools, .anchor {display: none} figure {padding: 10px} section, .tile {break-inside: avoid}"});
  await (await what(page)).screenshot({path: join(images, picture), timeout: 120_000});
}

await take("umbmark", 1020, "umbmark-report.png", (page) => page.locator("#figure-1 figure"));
await take("recovery", 820, "sweep-recovery.png", (page) => page.locator("#figure-1 figure"));
await take("case-06", 1100, "gap-report.png", async (page) => {
  await page.addStyleTag({content: "section:not(#where), footer, .strip {display: none} main {padding-bottom: 16px}"});
  return page.locator("main");
});
await take("extended_umbmark", 1020, "replay.png", async (page) => {
  await page.waitForSelector("canvas[data-frames]", {timeout: 120_000});
  const runs = await page.locator("[data-replay=run] option").allTextContents();
  await page.locator("[data-replay=run]").selectOption({index: runs.findIndex((r) => r.includes("with cables"))});
  await page.locator("#replay .time input").fill("150");
  await page.locator("[data-replay=view]").selectOption("follow");
  await page.locator("#replay .time input").blur();
  await page.waitForTimeout(3000);
  return page.locator("#replay figure");
});
await browser.close();
