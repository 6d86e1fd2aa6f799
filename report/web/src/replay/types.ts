// What the page hands to the replay, and what it gets back. The replay's code is a bundle of its own.

import type {Figures, Pose} from "../run/data";

export interface Ghost {
  name: string;
  colour: string;  // a variable of the page's style
  poses: Pose[];
}

export interface Cable {
  x_m: number;
  y_m: number;
  height_m: number;
  length_m?: number;
  direction_rad?: number;
}

export interface ReplayRun {
  label: string;
  direction: string;
  time_s: number[];
  poses: Pose[];
  ghosts: Ghost[];
  wheels?: number[][];  // angles, loads, sliding shares
  cables: Cable[];
}

export interface ReplayScene {
  runs: ReplayRun[];
  robot: Figures;
  floor?: Figures;
  side_m?: number;
}

export type View = "follow" | "whole" | "above";

export interface Replay {
  run(index: number): void;
  /// The pose of this index, with a fraction, between two of the run's.
  at(index: number): void;
  view(view: View): void;
  ghosts(shown: boolean): void;
  /// Draws a picture if anything changed since the last one.
  draw(): void;
  resize(width: number, height: number): void;
  recolour(): void;
  /// Where the robot that is drawn stands: read back from the scene.
  pose(): Pose;
  wheelAngles(): [number, number];
}

export type StartReplay = (canvas: HTMLCanvasElement, scene: ReplayScene) => Replay;

declare global {
  interface Window {
    umbsimReplay?: StartReplay;
  }
}
