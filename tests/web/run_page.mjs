// run_page.mjs TOOLS REPORT.html: the page of a run.
import assert from "node:assert/strict";
import {accessible, again, close, dataOf, differ, download, fits, open, pages, picture, run, same, sound} from "./browser.mjs";

const [file] = pages;
const data = dataOf(file);
const summary = data.summary;
const stages = (stage) => data.runs.filter((r) => (r.stage ?? "before") === stage && r.error);
const tracked = data.runs.filter((r) => r.truth?.length > 1);
const directions = [...new Set(tracked.map((r) => r.direction))];
const value = (page, name) => page.locator(".tile", {has: page.locator("dt", {hasText: name})}).locator(".value").textContent();

await run({
  async "figures are those of the data"() {
    const page = await again(file);
    assert.equal(await page.locator("h1").textContent(), data.title);
    if (summary.umbmark) same(await value(page, "before"), summary.umbmark.e_max_syst_m * 1000, "E_max");
    const applied = summary.calibration?.applied;
    if (applied && applied !== "none") {
      same(await value(page, "wheel diameters"), summary.calibration[applied].e_d, "E_d");
      same(await value(page, "wheelbase"), summary.calibration[applied].e_b, "E_b");
    }
    const rows = await page.locator("#runs tbody tr").all();
    assert.equal(rows.length, data.runs.filter((r) => r.error).length);
    for (const [i, row] of rows.entries()) {
      const cells = await row.locator("td").allTextContents();
      const {x_m, y_m} = data.runs[i].error;
      assert.ok((await row.locator("th").textContent()).includes(data.runs[i].id));
      same(cells[1], x_m * 1000, "e_x");
      same(cells[2], y_m * 1000, "e_y");
    }
    await sound(page);
  },

  async "every run is drawn"() {
    const page = await again(file);
    const shown = ["before", "bumped", "after"].filter((s) => stages(s).length);
    const visible = shown.filter((s) => s !== "bumped" || shown.length === 1);
    const dots = await page.locator("#scatter-all .end-point > *").count();
    assert.equal(dots, visible.reduce((n, s) => n + stages(s).length, 0));
    assert.equal(await page.locator("#figure-2 .truth path").count(), directions.length);
    assert.equal(await page.locator("#figure-2 .odometry path").count(), directions.length);
    assert.equal(await page.locator("#figure-3 .series path").count(), 2 * directions.length);
    if (summary.umbmark) assert.ok(await page.locator("#scatter-all .emax path").count() >= 1);
    if (data.bumps.length) {
      assert.equal(await page.locator("#extended-chart .cable > *").count(), data.bumps.filter((b) => tracked.some((r) => r.id === b.run)).length);
    }
    await picture(page.locator("#figure-1"));
    await sound(page);
  },

  async "the worked calculation ends at the summary's figures"() {
    const page = await again(file);
    const results = await page.locator("[data-result]").all();
    if (summary.umbmark && data.wheelbase_m) assert.ok(results.length >= 11, `${results.length} results`);
    for (const result of results) {
      const key = await result.getAttribute("data-result");
      const known = key.split(".").reduce((at, k) => at?.[k], summary.umbmark);
      const text = await result.textContent();
      same(text, /_m$/.test(key) ? known * 1000 : known, key);
    }
    await sound(page);
  },

  async "the slider enlarges the error, and a run can be chosen"() {
    const page = await again(file);
    const path = page.locator("#path-0 .truth path");
    const slider = page.locator("#figure-2 input[type=range]");
    await slider.fill("0");
    const before = await path.getAttribute("d");
    await slider.fill("8");
    assert.equal(await page.locator("#figure-2 output").textContent(), "\u00d730");
    assert.notEqual(await path.getAttribute("d"), before);
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

  async "tips come by pointer and by arrow keys, with units"() {
    const page = await again(file);
    const chart = page.locator("#scatter-all");
    const tip = chart.locator(".tip tspan");
    await chart.locator(".end-point > *").first().hover({force: true});
    assert.ok((await tip.allTextContents()).join(" ").includes("mm"));
    await page.mouse.move(2, 2);
    await chart.locator(".plot").focus();
    const read = [];
    for (let i = 0; i < 2; ++i) {
      await page.keyboard.press("ArrowRight");
      await page.waitForFunction(() => document.querySelector("#scatter-all .said").textContent !== "");
      await page.waitForTimeout(60);
      read.push(await chart.locator(".said").textContent());
    }
    assert.match(read[0], /mm/);
    if (data.runs.length > 1) assert.notEqual(read[0], read[1]);
    await page.keyboard.press("Escape");
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

  async "phone, dark mode and print"() {
    const wide = await open(file);
    const light = await picture(wide.locator("#figure-1"));
    await fits(wide);
    await accessible(wide);
    const pdf = await wide.pdf({format: "A4"});
    assert.ok(pdf.length > 20_000 && pdf.subarray(0, 4).toString() === "%PDF");
    await wide.emulateMedia({media: "print"});
    assert.equal(await wide.locator(".chart-tools").first().isVisible(), false);
    await close(wide);
    const dark = await open(file, {dark: true});
    differ(light, await picture(dark.locator("#figure-1")), "dark mode");
    await accessible(dark);
    await close(dark);
    const phone = await open(file, {width: 390, height: 844, touch: true});
    await fits(phone);
    await picture(phone.locator("#figure-2"));
    await accessible(phone);
    await close(phone);
  },
});
