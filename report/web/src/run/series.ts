// How a run's error grows along its way: distances, errors, legs and turns of each sample.

import {DEG} from "../lib/format";
import type {Range} from "../lib/chart";
import type {Pose, Tracked} from "./data";

export interface Sample {
  index: number;
  distance: number;  // along the true path, m
  turned: number;    // in all, calculated, rad
  position: number;  // error, mm
  heading: number;   // error, degrees
}

export const wrapAngle = (a: number): number => Math.atan2(Math.sin(a), Math.cos(a));

export const samplesOf = (run: Tracked): number => Math.min(run.truth.length, run.odometry.length);

const cache = new WeakMap<object, Sample[]>();

export function errorSeries(run: Tracked): Sample[] {
  const known = cache.get(run);
  if (known) return known;
  const series: Sample[] = [];
  let [distance, turned] = [0, 0];
  for (let i = 0; i < samplesOf(run); ++i) {
    const [t, o] = [run.truth[i], run.odometry[i]];
    if (i > 0) {
      distance += Math.hypot(t[0] - run.truth[i - 1][0], t[1] - run.truth[i - 1][1]);
      turned += wrapAngle(o[2] - run.odometry[i - 1][2]);
    }
    series.push({index: i, distance, turned, position: Math.hypot(t[0] - o[0], t[1] - o[1]) * 1000, heading: wrapAngle(t[2] - o[2]) * DEG});
  }
  cache.set(run, series);
  return series;
}

/// Distances at which the middle of each 90 degree turn is passed.
export function turnDistances(series: Sample[]): number[] {
  const turns: number[] = [];
  for (const sample of series) {
    while (Math.abs(sample.turned) > (Math.PI / 2) * (turns.length + 0.5)) turns.push(sample.distance);
  }
  return turns;
}

/// The stretches between turns, as ranges of the distance.
export function legs(series: Sample[]): Range[] {
  const ends = [0, ...turnDistances(series), series[series.length - 1].distance];
  return ends.slice(1).map((end, i): Range => [ends[i], end]).filter(([a, b]) => b - a > 0.01);
}

/// Index of the pose whose wheel is nearest to the point: half a wheelbase aside, neither ahead nor behind.
export function poseAt(path: Pose[], x: number, y: number, wheelbase: number): number {
  let [least, index] = [Infinity, 0];
  path.forEach((pose, i) => {
    const [dx, dy] = [x - pose[0], y - pose[1]];
    const ahead = dx * Math.cos(pose[2]) + dy * Math.sin(pose[2]);
    const aside = Math.abs(dy * Math.cos(pose[2]) - dx * Math.sin(pose[2]));
    const cost = Math.hypot(ahead, aside - wheelbase / 2);
    if (cost < least) [least, index] = [cost, i];
  });
  return index;
}
