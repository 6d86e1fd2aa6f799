// Which page this is stands in its data.

import {escapeHtml, find} from "./lib/html";
import {showError} from "./lib/page";
import {showGap} from "./gap/gap";
import {showCalibration} from "./other/calibration";
import {showExplanation} from "./other/explanation";
import {showIndex} from "./other/index";
import {showPlan} from "./other/plan";
import {showPrediction} from "./other/prediction";
import {showScore} from "./other/score";
import {showRun} from "./run/run";
import {showSweep} from "./sweep/sweep";

window.addEventListener("error", (event) => showError(event.message));
window.addEventListener("unhandledrejection", (event) => showError(String(event.reason)));

// eslint-disable-next-line @typescript-eslint/no-explicit-any
const PAGES: Record<string, (data: any) => Promise<void>> = {
  run: showRun, recording: showRun, sweep: showSweep, gap: showGap, calibration: showCalibration, explanation: showExplanation, plan: showPlan,
  prediction: showPrediction, score: showScore, index: showIndex};

async function start(): Promise<void> {
  const data = JSON.parse(find(document, "#report-data").textContent!);
  const show = PAGES[data.page];
  if (!show) throw new Error(`no page shows “${escapeHtml(data.page)}”`);
  await show(data);
  document.body.dataset.drawn = "true";
}

start().catch((error) => {
  showError(error instanceof Error ? error.message : String(error));
  throw error;
});
