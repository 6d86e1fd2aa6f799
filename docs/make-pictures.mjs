// make-pictures.mjs TOOLS RESULTS IMAGES: the pictures of README.md, from pages that the program wrote: RESULTS/umbmark and
// RESULTS/extended_umbmark. TOOLS: where the pages' tests keep their packages (build/release/tests/web/tools).
import {createRequire} from "node:module";
import {join, resolve} from "node:path";

const [tools, results, images] = process.argv.slice(2).map((path) => resolve(path));
const {chromium} = createRequire(join(tools, "package.json"))("playwright-core");
const browser = await chromium.launch({executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader"]});

async function open(name, width) {
  const page = await (await browser.newContext({viewport: {width, height: 900}})).newPage();
  await page.goto(`file://${results}/${name}/report.html`);
  await page.waitForFunction(() => document.body.dataset.drawn === "true", null, {timeout: 120_000});
  return page;
}

const umbmark = await open("umbmark", 1020);
await umbmark.addStyleTag({content: "figcaption, .chart-tools {display: none}"});
await umbmark.locator("#figure-1 figure").screenshot({path: join(images, "umbmark-report.png")});

const cables = await open("extended_umbmark", 1020);
await cables.waitForSelector("canvas[data-frames]", {timeout: 120_000});
const runs = await cables.locator("[data-replay=run] option").allTextContents();
await cables.locator("[data-replay=run]").selectOption({index: runs.findIndex((r) => r.includes("with cables"))});
await cables.locator("#replay .time input").fill("150");
await cables.locator("[data-replay=view]").selectOption("follow");
await cables.waitForTimeout(3000);
await cables.locator("#replay figure").screenshot({path: join(images, "replay.png"), timeout: 120_000});
await browser.close();
