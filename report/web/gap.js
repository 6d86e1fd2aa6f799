"use strict";

// The page of a gap diagnosis: the gap, where, which, how far, what next.

const gapData = JSON.parse(document.getElementById("report-data").textContent);
gapData.runs = gapData.runs || [];

function buildGapPage(data) {
  const d = data.diagnosis;
  document.getElementById("report").innerHTML = `
    <header>
      <h1>${escapeHtml(data.title)}</h1>
      <p class="headline">${escapeHtml(d.verdict)}</p>
      ${gapTilesHtml(d)}
    </header>
    <section id="where"></section>
    <section><h2>Which</h2>${gapWhichHtml(d)}</section>
    <section><h2>How far</h2><div class="beside"><div id="ends"></div><div>${gapClosureHtml(d)}</div></div></section>
    <section><h2>What next</h2>${gapNextHtml(d)}</section>
    <footer>umbsim ${escapeHtml(data.version || "")}</footer>`;
}

const gapDraws = [];
if (gapData.diagnosis) {
  buildGapPage(gapData);
  gapDraws.push(setupGapTracks(gapData, document.getElementById("where")));
  gapDraws.push(setupGapScatter(gapData, document.getElementById("ends")));
}
const drawGap = () => gapDraws.forEach((draw) => draw());
drawGap();
let gapWidth = document.documentElement.clientWidth;
window.addEventListener("resize", () => {
  if (document.documentElement.clientWidth === gapWidth) return;
  gapWidth = document.documentElement.clientWidth;
  drawGap();
});
document.body.dataset.drawn = "true";
