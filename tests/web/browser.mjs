// Opens pages in Debian's Chromium and holds them to what all pages promise: no request, no console message, no error, no
// broken number, nothing beyond the screen's edge, no serious violation that axe-core finds.
import assert from "node:assert/strict";
import {existsSync, mkdtempSync, readFileSync} from "node:fs";
import {createRequire} from "node:module";
import {tmpdir} from "node:os";
import {join, resolve} from "node:path";

const SKIPPED = 77;
const [tools, ...args] = process.argv.slice(2);
export const pages = args.map((page) => resolve(page));
const require = createRequire(join(resolve(tools), "package.json"));
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

const program = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser"].find((p) => p && existsSync(p));
if (!program) {
  console.log("SKIPPED: no chromium");
  process.exit(SKIPPED);
}
const browser = await require("playwright-core").chromium.launch({
  executablePath: program,
  args: ["--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-background-networking"]});

// Chromium's own word on drawing without graphics hardware.
const kOfTheDriver = /GL Driver Message/;

export const downloads = mkdtempSync(join(tmpdir(), "umbsim-web-"));

/// The data that the program embedded.
export function dataOf(file) {
  const text = readFileSync(file, "utf8");
  return JSON.parse(/<script type="application\/json" id="report-data">(.*?)<\/script>/s.exec(text)[1]);
}

/// A page as a reader sees it. Options: width, height, dark, hash, reduced.
export async function open(file, {width = 1280, height = 900, dark = false, hash = "", touch = false} = {}) {
  const context = await browser.newContext({viewport: {width, height}, colorScheme: dark ? "dark" : "light", acceptDownloads: true, hasTouch: touch});
  const page = await context.newPage();
  page.complaints = [];
  page.on("console", (m) => kOfTheDriver.test(m.text()) || page.complaints.push(`console ${m.type()}: ${m.text()}`));
  page.on("pageerror", (e) => page.complaints.push(`error: ${e.message}`));
  page.on("dialog", (d) => page.complaints.push(`dialog: ${d.message()}`));
  page.on("request", (r) => {
    if (!/^(file|data|blob):/.test(r.url()) || (r.url().startsWith("file:") && r.resourceType() !== "document")) page.complaints.push(`request: ${r.url()}`);
  });
  await page.goto(`file://${file}${hash}`);
  await page.waitForFunction(() => document.body.dataset.drawn === "true" || !document.getElementById("page-error").hidden);
  return page;
}

const shared = new Map();

/// The same page for several parts of a test, which leave it as they like.
export async function again(file) {
  if (!shared.has(file)) shared.set(file, await open(file));
  return shared.get(file);
}

/// What every page promises, whatever was done with it.
export async function sound(page) {
  assert.equal(await page.locator("#page-error").isVisible(), false, await page.locator("#page-error").textContent());
  const text = await page.evaluate(() => document.getElementById("report").innerText);
  for (const broken of ["NaN", "undefined", "Infinity", "[object"]) {
    const at = text.indexOf(broken);
    assert.equal(at, -1, `"${broken}" on the page: …${text.slice(Math.max(0, at - 60), at + 30)}…`);
  }
  assert.deepEqual(page.complaints, []);
}

export async function close(page) {
  await sound(page);
  await page.context().close();
}

/// Nothing stands beyond the screen's edge; wide tables scroll in their own frame.
export async function fits(page) {
  const [content, screen] = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
  assert.ok(content <= screen, `the page is ${content} px wide on ${screen} px`);
}

/// No table is cut off: none needs to be scrolled.
export async function tablesFit(page) {
  for (const frame of await page.locator(".table-wrap:visible").all()) {
    const [content, seen] = await frame.evaluate((e) => [e.scrollWidth, e.clientWidth]);
    assert.ok(content <= seen + 1, `a table of ${content} px in ${seen} px: ${await frame.getAttribute("aria-label")}`);
  }
}

export async function accessible(page) {
  await page.evaluate(`${axe}; true`);
  const violations = await page.evaluate(async () => (await window.axe.run(document, {
    runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"]})).violations
      .filter((v) => ["serious", "critical"].includes(v.impact))
      .map((v) => `${v.id}: ${v.nodes.length} of ${v.nodes.slice(0, 3).map((n) => `${n.target} ${n.failureSummary}`).join(" | ")}`));
  assert.deepEqual(violations, []);
}

/// The picture of an element, and that something is on it.
export async function picture(locator) {
  const bytes = await locator.screenshot();
  assert.ok(bytes.length > 1500, `a picture of ${bytes.length} bytes is blank`);
  return bytes;
}

export const differ = (a, b, what) => assert.ok(!a.equals(b), `${what}: the pictures are the same`);

export async function download(page, locator) {
  const [file] = await Promise.all([page.waitForEvent("download"), locator.click()]);
  const path = join(downloads, file.suggestedFilename());
  await file.saveAs(path);
  return {name: file.suggestedFilename(), bytes: readFileSync(path)};
}

/// Runs the parts of a test one after the other, says which failed, and ends the process.
export async function run(parts) {
  let failures = 0;
  for (const [name, part] of Object.entries(parts)) {
    const begun = Date.now();
    try {
      await part();
      console.log(`ok: ${name} (${Date.now() - begun} ms)`);
    } catch (error) {
      ++failures;
      console.log(`FAIL: ${name}\n  ${String(error.message).split("\n").slice(0, 12).join("\n  ")}\n  ${String(error.stack).split("\n").find((l) => l.includes("_page.mjs") || l.includes("replay")) ?? ""}`);
    }
  }
  await browser.close();
  process.exit(failures ? 1 : 0);
}

export const number = (text) => Number(text.replace(/\u2212/g, "-").replace(/[\s\u202f\u00a0]/g, "").replace(/(mm|m|rad|°|×).*$/, ""));

/// A shown number is that of the data, to the digits that are shown.
export function same(shown, value, what) {
  const digits = (/\.(\d+)/.exec(shown)?.[1] ?? "").length;
  assert.ok(Math.abs(number(shown) - value) <= 0.5001 * 10 ** -digits + 1e-12, `${what}: ${shown} is shown, ${value} in the data`);
}
