// The place of the 3D replay: picture, buttons, time. Its code is run once the charts are drawn.

import type {GapData} from "../gap/data";
import type {GapMoment} from "../gap/tracks";
import {colour, DEG, directionName, fixed, mmUnit, stageName} from "../lib/format";
import {fill, find, html, type Html} from "../lib/html";
import {heading, legend, lineIcon, type Section} from "../lib/page";
import type {Shared} from "../lib/shared";
import type {Choice} from "../run/choice";
import {hasTrack, type Figures, type Pose, type RunData, type Tracked} from "../run/data";
import {poseAt} from "../run/series";
import type {Replay, ReplayRun, ReplayScene, View} from "./types";

const SPEEDS = [0.25, 0.5, 1, 2, 5, 10];

/// Angles by rolling, where nobody measured them: what the wheels' ways make of the poses.
function rolled(poses: Pose[], robot: Figures, wheelbase: number): number[][] {
  let [left, right] = [0, 0];
  return poses.map((p, i) => {
    if (i > 0) {
      const q = poses[i - 1];
      const way = (p[0] - q[0]) * Math.cos(q[2]) + (p[1] - q[1]) * Math.sin(q[2]);
      const turn = Math.atan2(Math.sin(p[2] - q[2]), Math.cos(p[2] - q[2]));
      left += (way - turn * wheelbase / 2) / robot.wheel_radius_m;
      right += (way + turn * wheelbase / 2) / robot.wheel_radius_m;
    }
    return [left, right];
  });
}

const timesOf = (run: {time_s?: number[]}, n: number): number[] => (run.time_s?.length === n ? run.time_s : Array.from({length: n}, (_, i) => i * 0.25));

function indexAt(times: number[], t: number): number {
  if (t <= times[0]) return 0;
  const i = times.findIndex((v) => v > t);
  return i < 0 ? times.length - 1 : i - 1 + (t - times[i - 1]) / (times[i] - times[i - 1]);
}

function timeAt(times: number[], index: number): number {
  const i = Math.min(Math.floor(index), times.length - 2);
  return times[i] + (index - i) * (times[i + 1] - times[i]);
}

interface Player {
  scene: ReplayScene;
  key: [Html, unknown][];
  /// What the charts show of this moment.
  tell(run: number, index: number): void;
  /// Calls back when a chart was clicked.
  listen(seek: (run: number, index: number) => void): void;
  words(run: number, index: number): string;
}

function controls(player: Player): Html {
  const button = (act: string, sign: string) => html`<button type="button" data-play="${act}">${sign}</button>`;
  return html`<div class="controls replay-controls">
    ${button("toggle", "Play")}
    <label>Run <select data-replay="run" aria-label="Run that is replayed">${player.scene.runs.map((r, i) => html`<option value="${i}">${r.label}</option>`)}</select></label>
    <label>Speed <select data-replay="speed">${SPEEDS.map((s) => html`<option value="${s}" ${s === 2 ? html`selected` : ""}>\u00d7${s}</option>`)}</select></label>
    <label>Camera <select data-replay="view"><option value="whole">whole course</option><option value="follow">follow</option><option value="above">from above</option></select></label>
    ${player.scene.runs.some((r) => r.ghosts.length) && html`<label><input type="checkbox" data-replay="ghosts" checked>ghosts</label>`}</div>`;
}

/// Puts the code into the page; its policy knows the code's hash.
function startCode(): boolean {
  if (window.umbsimReplay) return true;
  const code = document.getElementById("replay-code")?.textContent;
  if (!code) return false;
  const script = document.createElement("script");
  script.textContent = code;
  document.body.append(script);
  return !!window.umbsimReplay;
}

function setup(section: HTMLElement, id: string, title: string, player: Player): void {
  fill(section, html`${heading(id, title)}<figure>${controls(player)}
    <div class="stage"><canvas tabindex="0" role="img" aria-label="3D picture of the robot on the floor. Drag to turn the view; space plays and pauses, the arrow keys step."></canvas>
      <p class="stage-words" hidden></p></div>
    <div class="controls"><label class="time">Time <input type="range" min="0" max="1000" step="1" value="0" aria-label="Time of the run"><output></output></label></div>
    ${legend(player.key)}<figcaption class="replay-words" aria-live="off"></figcaption></figure>`);
  const canvas = find<HTMLCanvasElement>(section, "canvas");
  const slider = find<HTMLInputElement>(section, "input[type=range]");
  let [run, time, speed, playing, last] = [0, 0, 2, false, 0];
  let replay: Replay | undefined;
  const times = () => player.scene.runs[run].time_s;
  const end = () => times()[times().length - 1];
  const show = (tell: boolean) => {
    const index = indexAt(times(), time);
    slider.value = String(Math.round(1000 * (time - times()[0]) / (end() - times()[0] || 1)));
    find(section, ".time output").textContent = `${fixed(time, 1)} s`;
    slider.setAttribute("aria-valuetext", `${fixed(time, 1)} seconds`);
    find(section, ".replay-words").textContent = player.words(run, index);
    if (replay) {
      replay.at(index);
      canvas.dataset.pose = JSON.stringify(replay.pose());
      canvas.dataset.wheels = JSON.stringify(replay.wheelAngles());
    }
    if (tell) player.tell(run, index);
  };
  const play = (on: boolean) => {
    playing = on;
    if (on && time >= end()) time = times()[0];
    find(section, "[data-play=toggle]").textContent = on ? "Pause" : "Play";
    last = performance.now();
  };
  const frame = (now: number) => {
    if (playing) {
      time = Math.min(end(), time + speed * (now - last) / 1000);
      if (time >= end()) play(false);
      show(true);
    }
    last = now;
    replay?.draw();
    if (visible) requestAnimationFrame(frame);
  };
  let visible = false;
  const choose = (value: number) => {
    run = value;
    time = Math.min(time, end());
    find<HTMLSelectElement>(section, "[data-replay=run]").value = String(run);
    replay?.run(run);
    show(true);
  };
  section.addEventListener("click", (event) => {
    if ((event.target as HTMLElement).dataset.play) play(!playing);
  });
  section.addEventListener("input", (event) => {
    const input = event.target as HTMLInputElement;
    const value = input.value;
    if (input === slider) {
      play(false);
      time = times()[0] + (end() - times()[0]) * Number(value) / 1000;
      show(true);
    } else if (input.dataset.replay === "run") choose(Number(value));
    else if (input.dataset.replay === "speed") speed = Number(value);
    else if (input.dataset.replay === "view") replay?.view(value as View);
    else if (input.dataset.replay === "ghosts") replay?.ghosts(input.checked);
  });
  canvas.addEventListener("keydown", (event) => {
    const step = {ArrowRight: 1, ArrowLeft: -1}[event.key];
    if (event.key === " ") play(!playing);
    else if (step) time = Math.max(times()[0], Math.min(end(), time + step));
    else return;
    event.preventDefault();
    show(true);
  });
  player.listen((r, index) => {
    if (r !== run) choose(r);
    time = timeAt(times(), index);
    play(false);
    show(false);
  });
  const size = () => {
    const width = Math.max(260, canvas.parentElement!.clientWidth);
    replay?.resize(width, Math.round(Math.min(520, width * 0.6)));
    replay?.draw();
  };
  const begin = () => {
    const test = document.createElement("canvas");
    if (!(test.getContext("webgl2")) || !startCode()) {
      find(section, ".stage-words").hidden = false;
      find(section, ".stage-words").textContent = "This browser draws no 3D pictures (WebGL 2); time and charts work all the same.";
      canvas.hidden = true;
      return;
    }
    replay = window.umbsimReplay!(canvas, player.scene);
    size();
    show(false);
    replay.draw();
    requestAnimationFrame(() => setTimeout(() => performance.mark("first-frame")));
    new ResizeObserver(() => requestAnimationFrame(size)).observe(canvas.parentElement!);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      replay!.recolour();
      replay!.draw();
    });
    new IntersectionObserver(([entry]) => {
      if (entry.isIntersecting && !visible) requestAnimationFrame(frame);
      visible = entry.isIntersecting;
    }).observe(canvas);
  };
  show(false);
  // A picture takes longer than all charts: it is made when the reader comes within a screen's height of it.
  const near = new IntersectionObserver(([entry]) => entry.isIntersecting && start(), {rootMargin: "100% 0%"});
  const start = () => {
    near.disconnect();
    window.removeEventListener("beforeprint", start);
    begin();
  };
  window.addEventListener("beforeprint", start);
  near.observe(section);
}

const cables = (data: RunData, run: Tracked) => [
  ...(run.stage === "bumped" ? data.floor?.cables ?? [] : []),
  ...data.bumps.filter((b) => b.run === run.id).map((b) => ({
    ...b, direction_rad: run.truth[poseAt(run.truth, b.x_m, b.y_m, data.wheelbase_m ?? 0)][2] + Math.PI / 2}))];

export function replaySection(data: RunData, choice: Choice): Section | null {
  const robot = data.robot;
  const runs = data.runs.filter(hasTrack);
  if (!robot?.urdf || !robot.left_joint || !runs.length) return null;
  const scene: ReplayScene = {
    robot, floor: data.floor, side_m: data.side_m,
    runs: runs.map((run): ReplayRun => ({
      label: `${run.id}, ${stageName(run.stage)}`, direction: run.direction, time_s: timesOf(run, run.truth.length), poses: run.truth, cables: cables(data, run),
      ghosts: [{name: "odometry", colour: "--muted", poses: run.odometry}],
      wheels: run.wheels ?? rolled(run.odometry, robot, data.wheelbase_m ?? 0.3)}))};
  const player: Player = {
    scene,
    key: [[lineIcon("var(--cw)", "", 6), "true robot and its trail"], [lineIcon("var(--muted)", "", 4), "ghost: where odometry believes it is"],
          ...(runs.some((r) => r.wheels) ? [[lineIcon("var(--accent)", "", 6), "ring: the wheel's load"], [lineIcon("var(--bad)", "", 6), "a wheel slides"]] as [Html, unknown][] : []),
          ...(data.bumps.length ? [[lineIcon("var(--bump)", "", 6), "cable"]] as [Html, unknown][] : [])],
    tell: (run, index) => choice.moment.set({run: runs[run], index}),
    listen: (seek) => choice.moment.on((m) => {
      if (m?.clicked) seek(runs.indexOf(m.run), m.index);
    }),
    words: (number, index) => {
      const run = runs[number];
      const i = Math.min(Math.round(index), run.truth.length - 1);
      const [t, o, w] = [run.truth[i], run.odometry[i], run.wheels?.[i]];
      return `x ${fixed(t[0], 3)} m, y ${fixed(t[1], 3)} m, heading ${fixed(t[2] * DEG, 2)}°; odometry off by ${mmUnit(Math.hypot(t[0] - o[0], t[1] - o[1]))}` +
          (w ? `; wheels carry ${fixed(w[2], 0)} N and ${fixed(w[3], 0)} N${w[4] > 0.02 || w[5] > 0.02 ? ", sliding" : ""}` : "");
    },
  };
  return {id: "replay", setup: (section) => setup(section, "replay", "3D replay", player)};
}

export function gapReplay(data: GapData, moment: Shared<GapMoment | null>): Section | null {
  const robot = data.robot;
  const runs = data.runs.filter((r) => r.recorded.length > 1 && r.recorded[0].length > 2);
  if (!robot?.urdf || !robot.left_joint || !runs.length) return null;
  const scene: ReplayScene = {
    robot, floor: data.floor, side_m: data.side_m,
    runs: runs.map((run): ReplayRun => ({
      label: `${run.id}, ${directionName(run.direction)}`, direction: run.direction, time_s: timesOf(run, run.recorded.length), poses: run.recorded, cables: [],
      ghosts: [{name: "scenario", colour: "--muted", poses: run.before}, ...(run.after ? [{name: "twin", colour: "--accent", poses: run.after}] : [])],
      wheels: rolled(run.recorded, robot, robot.wheelbase_m ?? 0.3)}))};
  const player: Player = {
    scene,
    key: [[lineIcon(colour("cw"), "", 6), "recorded robot and its trail"], [lineIcon("var(--muted)", "", 4), "ghost: the scenario's prediction"],
          ...(runs.some((r) => r.after) ? [[lineIcon("var(--accent)", "", 4), "ghost: the twin's prediction"]] as [Html, unknown][] : [])],
    tell: (run, index) => moment.set({run: runs[run], index}),
    listen: () => undefined,
    words: (number, index) => {
      const run = runs[number];
      const i = Math.min(Math.round(index), run.recorded.length - 1);
      const off = (track?: Pose[]) => (track ? mmUnit(Math.hypot(track[i][0] - run.recorded[i][0], track[i][1] - run.recorded[i][1])) : "");
      return `x ${fixed(run.recorded[i][0], 3)} m, y ${fixed(run.recorded[i][1], 3)} m; the scenario is off by ${off(run.before)}${run.after ? `, the twin by ${off(run.after)}` : ""}`;
    },
  };
  return {id: "replay", setup: (section) => setup(section, "replay", "3D replay", player)};
}
