// What the page of a diagnosis holds (docs/gap.md): diagnosis.json and the runs as recorded and as predicted.

import type {Figures, Pose} from "../run/data";

export interface Part {
  leg: number;
  part: string;
  score: number;
  from: number;
  to: number;
}

export interface GapRun {
  id: string;
  direction: string;
  recorded: Pose[];
  before: Pose[];
  after?: Pose[];
  time_s?: number[];
  parts: Part[];
  end: Record<"before" | "after", {x_m: number; y_m: number; theta_rad: number}>;
}

export interface GapData {
  title: string;
  version: string;
  diagnosis: Figures;
  runs: GapRun[];
  robot?: Figures;
  floor?: Figures;
  side_m?: number;
  provenance?: Figures;
}

export const namesOf = (cause: Figures): string[] => Object.keys(cause.effects).sort();
export const isNamed = (cause: Figures): boolean => !["none", "unknown"].includes(namesOf(cause)[0]);
