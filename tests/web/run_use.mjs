// run_use.mjs TOOLS REPORT.html: what a reader does with the page of a run: enlarges, marks, saves, follows a link, prints.
import assert from "node:assert/strict";
import {again, close, dataOf, download, fits, open, pages, run, sound} from "./browser.mjs";

const [file] = pages;
const data = dataOf(file);

await run({
  async "the slider enlarges the error, and a run can be chosen"() {
    const page = await again(file);
    const path = page.locator("#path-0 .truth path");
    const slider = page.locator("#figure-2 input[type=range]");
    await slider.fill("0");
    const before = await path.getAttribute("d");
    await slider.fill("8");
    assert.equal(await page.locator("#figure-2 output").textContent(), "\u00d730");
    assert.notEqual(await path.getAttribute("d"), before);
    await page.locator("#path-0 svg").dispatchEvent("input");  // as a chart does whose tip moves
    assert.equal(await page.locator("#figure-2 output").textContent(), "\u00d730");
    const options = page.locator("#figure-2 select").first().locator("option");
    if (await options.count() > 1) {
      const curve = page.locator("#growth-position .series path").first();
      const was = await curve.getAttribute("d");
      await page.locator("#figure-2 select").first().selectOption({index: 1});
      assert.notEqual(await curve.getAttribute("d"), was, "figure 3 shows the run that was chosen in figure 2");
    }
    await sound(page);
  },

  async "a stretch that is dragged along a curve is marked in the paths"() {
    const page = await again(file);
    assert.equal(await page.locator("#figure-2 .stretch path").count(), 0);
    const box = await page.locator("#growth-position svg").boundingBox();
    await page.locator("#growth-position").scrollIntoViewIfNeeded();
    const at = await page.locator("#growth-position svg").boundingBox();
    await page.mouse.move(at.x + 0.4 * box.width, at.y + 0.5 * box.height);
    await page.mouse.down();
    await page.mouse.move(at.x + 0.6 * box.width, at.y + 0.5 * box.height, {steps: 4});
    await page.mouse.up();
    await page.locator("#figure-2 .stretch path").first().waitFor({state: "attached", timeout: 5000});
    await page.locator("#figure-3 select").selectOption("0");  // the same by keyboard
    assert.ok(await page.locator("#figure-2 .stretch path").count() >= 1);
    await page.locator("#figure-3 select").selectOption("");
    assert.equal(await page.locator("#figure-2 .stretch path").count(), 0);
    await sound(page);
  },

  async "charts are enlarged by button and by dragging, and shown whole again"() {
    const page = await again(file);
    const chart = page.locator("#scatter-all");
    const ticks = () => chart.locator("svg").textContent();
    const whole = await ticks();
    await chart.locator("[data-act=in]").click();
    assert.notEqual(await ticks(), whole);
    await chart.locator("[data-act=all]").click();
    assert.equal(await ticks(), whole);
    await chart.scrollIntoViewIfNeeded();
    const box = await chart.locator("svg").boundingBox();
    await page.mouse.move(box.x + 0.4 * box.width, box.y + 0.4 * box.height);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.6 * box.height, {steps: 3});
    await page.mouse.up();
    assert.notEqual(await ticks(), whole);
    await sound(page);
  },

  async "charts are saved as SVG and PNG, tables as CSV"() {
    const page = await again(file);
    const svg = await download(page, page.locator("#path-0 [data-act=svg]"));
    assert.match(svg.name, /^path-.*\.svg$/);
    assert.match(svg.bytes.toString(), /<svg[^>]*xmlns="http:\/\/www.w3.org\/2000\/svg"/);
    assert.ok(!/style="[^"]*(fill|stroke): var\(/.test(svg.bytes.toString()), "colours are written out");
    const png = await download(page, page.locator("#path-0 [data-act=png]"));
    assert.equal(png.bytes.subarray(1, 4).toString(), "PNG");
    assert.ok(png.bytes.length > 5000);
    const csv = await download(page, page.locator("#runs [data-save=csv]"));
    const lines = csv.bytes.toString().trim().split("\n").map((line) => line.split(","));
    assert.equal(lines.length, 1 + data.runs.filter((r) => r.error).length);
    assert.ok(Math.abs(Number(lines[1][2]) - data.runs[0].error.x_m * 1000) < 0.06, lines[1].join());
    await sound(page);
  },

  async "a deep link leads to its figure"() {
    const page = await open(file, {hash: "#figure-3", height: 500});
    await page.waitForTimeout(100);
    const box = await page.locator("#figure-3").boundingBox();
    assert.ok(box.y > -40 && box.y < 400, `figure 3 begins at ${box.y} px`);
    await close(page);
  },

  async "directions differ by shape, not by colour alone"() {
    const page = await again(file);
    const marks = await page.locator("#scatter-all .end-point").evaluateAll((groups) => groups.map((g) => {
      const {tagName, attributes} = g.firstElementChild;
      return [/--c?cw/.exec(g.outerHTML)[0], `${tagName} ${attributes.d?.value ?? ""}`];
    }));
    const shapes = (direction) => new Set(marks.filter(([colour]) => colour === direction).map(([, shape]) => shape));
    const [cw, ccw] = [shapes("--cw"), shapes("--ccw")];
    assert.ok(cw.size && ccw.size, `${marks}`);
    for (const shape of cw) assert.ok(!ccw.has(shape), `cw and ccw are both drawn as ${shape}`);
    await sound(page);
  },

  async "it prints on A4, without its buttons, and cuts no chart"() {
    const [kWide, kHigh] = [718, 1047];  // CSS pixels of A4 between margins of 1 cm
    const page = await again(file);
    const pdf = await page.pdf({format: "A4", margin: {top: "1cm", bottom: "1cm", left: "1cm", right: "1cm"}});
    assert.ok(pdf.length > 20_000 && pdf.subarray(0, 4).toString() === "%PDF");
    await page.emulateMedia({media: "print"});
    await page.setViewportSize({width: kWide, height: kHigh});
    assert.equal(await page.locator(".chart-tools").first().isVisible(), false);
    await fits(page);
    const charts = await page.locator(".plot svg:visible").all();
    assert.ok(charts.length >= 3, `${charts.length} charts`);
    for (const chart of charts) {
      const {x, width, height} = await chart.boundingBox();
      const what = await chart.getAttribute("aria-label");
      assert.ok(x >= 0 && x + width <= kWide + 1 && height <= kHigh, `${what}: ${width} by ${height} px from ${x}`);
      assert.equal(await chart.evaluate((e) => getComputedStyle(e).breakInside), "avoid", what);
    }
    await close(page);
  },
});
