// What a run's page holds (docs/new-page.md): the summary and the runs with their thinned tracks.

import {isNumber} from "../lib/format";

export type Pose = [number, number, number];

export interface Run {
  id: string;
  direction: string;
  stage: string;
  error?: {x_m: number; y_m: number; theta_rad: number};
  truth?: Pose[];
  odometry?: Pose[];
  time_s?: number[];
  wheels?: number[][];    // a row a pose: angle of the left and right wheel, load of both (N), sliding share of both
  ellipses?: number[][];  // x, y, longer and shorter semi-axis, angle, index of the pose
  fixes?: number[];
}

export interface Bump {
  run: string;
  x_m: number;
  y_m: number;
  height_m: number;
}

// Figures come by name from summary.json.
// eslint-disable-next-line @typescript-eslint/no-explicit-any
export type Figures = Record<string, any>;

export interface RunData {
  page: string;
  title: string;
  scenario?: string;
  description?: string;
  version: string;
  seed?: number;
  side_m?: number;
  wheelbase_m?: number;
  summary: Figures;
  runs: Run[];
  bumps: Bump[];
  robot?: Figures;
  floor?: Figures;
  provenance?: Figures;
}

export type Tracked = Run & {truth: Pose[]; odometry: Pose[]};

export function normal(data: RunData): RunData {
  data.summary ??= {};
  data.runs = (Array.isArray(data.runs) ? data.runs : []).map((run) => ({...run, stage: run.stage ?? "before"}));
  data.bumps = Array.isArray(data.bumps) ? data.bumps : [];
  return data;
}

export const hasError = (run: Run): boolean => !!run.error && isNumber(run.error.x_m) && isNumber(run.error.y_m);

export const hasTrack = (run: Run): run is Tracked =>
    [run.truth, run.odometry].every((path) => Array.isArray(path) && path.length > 1);

export const ofKind = (data: RunData, stage: string, direction?: string): Run[] =>
    data.runs.filter((r) => hasError(r) && r.stage === stage && (!direction || r.direction === direction));
