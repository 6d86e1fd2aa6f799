// What the figures of a page show together: a run of each direction, a marked stretch of the way, a moment of the replay.

import type {Range} from "../lib/chart";
import {Shared} from "../lib/shared";
import {hasTrack, type RunData, type Tracked} from "./data";

export interface Moment {
  run: Tracked;
  index: number;  // of the pose, with a fraction
  clicked?: boolean;  // in a chart, so that the replay goes there
}

export interface Choice {
  runs: Shared<Record<string, Tracked>>;
  stretch: Shared<Range | null>;  // of the distance driven, m
  moment: Shared<Moment | null>;
}

export function choiceOf(data: RunData): Choice {
  const runs: Record<string, Tracked> = {};
  for (const run of data.runs.filter(hasTrack)) runs[run.direction] ??= run;
  return {runs: new Shared(runs), stretch: new Shared<Range | null>(null), moment: new Shared<Moment | null>(null)};
}

/// Runs that differ from this one by chance alone.
export const repeats = (data: RunData, run: Tracked): Tracked[] =>
    data.runs.filter(hasTrack).filter((r) => r.direction === run.direction && r.stage === run.stage);

export const directions = (choice: Choice): string[] => Object.keys(choice.runs.value);
