// An exported bag, opened by the readers that Foxglove is built on: every message of every topic is decoded by the definition
// in the bag, and says what the run's tables say.   mcap_log.mjs TOOLS BAG RUN
import assert from "node:assert/strict";
import {open} from "node:fs/promises";
import {readFileSync, readdirSync} from "node:fs";
import {createRequire} from "node:module";
import {join, resolve} from "node:path";

const [tools, bag, run] = process.argv.slice(2).map((path) => resolve(path));
const require = createRequire(join(tools, "package.json"));
const {McapIndexedReader} = require("@mcap/core");
const {loadDecompressHandlers} = require("@mcap/support");
const {parse} = require("@foxglove/rosmsg");
const {MessageReader} = require("@foxglove/rosmsg2-serialization");

const kLogBegins_s = 1e9;
const kRounded = 2e-9;  // tables and stamps are rounded to nanoseconds and 1e-9

/// Rows of a CSV file as objects of numbers or texts.
function table(...path) {
  const [head, ...rows] = readFileSync(join(...path), "utf8").trim().split("\n").map((line) => line.split(","));
  return rows.map((row) => Object.fromEntries(row.map((x, i) => [head[i], isNaN(x) ? x : Number(x)])));
}

const near = (a, b, tolerance, what) => assert.ok(Math.abs(a - b) <= tolerance, `${what}: ${a} is not ${b}`);
const seconds = ({sec, nsec, nanosec}) => sec - kLogBegins_s + (nsec ?? nanosec) * 1e-9;
const yaw = (q) => 2 * Math.atan2(q.z, q.w);

const file = await open(join(bag, readdirSync(bag).find((name) => name.endsWith(".mcap"))));
const reader = await McapIndexedReader.Initialize({
  readable: {
    size: async () => BigInt((await file.stat()).size),
    read: async (offset, length) => {
      const bytes = new Uint8Array(Number(length));
      await file.read(bytes, 0, bytes.length, Number(offset));
      return bytes;
    },
  },
  decompressHandlers: await loadDecompressHandlers(),
});
assert.equal(reader.header.profile, "ros2");
const decoders = new Map();
const messages = {};
let last = 0n;
for await (const {channelId, logTime, data} of reader.readMessages()) {
  const channel = reader.channelsById.get(channelId);
  const schema = reader.schemasById.get(channel.schemaId);
  assert.deepEqual([channel.messageEncoding, schema.encoding], ["cdr", "ros2msg"]);
  if (!decoders.has(channelId)) {
    decoders.set(channelId, new MessageReader(parse(new TextDecoder().decode(schema.data), {ros2: true})));
  }
  assert.ok(logTime >= last, "messages come in the order of their times");
  last = logTime;
  const decoded = decoders.get(channelId).readMessage(data);
  const stamp = (decoded.header ?? decoded.transforms[0].header).stamp;
  near(seconds(stamp), Number(logTime - BigInt(kLogBegins_s) * 1000000000n) * 1e-9, kRounded, "stamp");
  (messages[channel.topic] ??= []).push(decoded);
}
await file.close();
for (const [topic, list] of Object.entries(messages)) {
  const stated = reader.statistics.channelMessageCounts;
  const id = [...reader.channelsById.values()].find((c) => c.topic === topic).id;
  assert.equal(BigInt(list.length), stated.get(id), `messages of ${topic}`);
  assert.match(readFileSync(join(bag, "metadata.yaml"), "utf8"),
               new RegExp(`name: ${topic}\\n[^]*?message_count: ${list.length}\\n`), `metadata.yaml on ${topic}`);
}
console.log(Object.entries(messages).map(([topic, list]) => `${topic} ${list.length}`).join(", "));

const recording = readFileSync(join(run, "recording.yaml"), "utf8");
const header = (key) => Number(new RegExp(`^  ${key}: (.*)$`, "m").exec(recording)[1]);
const [ticks, radius, wheelbase] = ["ticks_per_revolution", "wheel_radius_m", "wheelbase_m"].map(header);
const counts = [], truth = [];
for (const {id, from_s} of table(bag, "runs.csv")) {
  for (const row of table(run, "runs", id, "encoders.csv")) counts.push({...row, time_s: row.time_s + from_s});
  for (const row of table(run, "runs", id, "truth.csv")) truth.push({...row, time_s: row.time_s + from_s});
}
assert.deepEqual([messages["/joint_states"].length, messages["/odom"].length, messages["/tf"].length, messages["/truth"].length],
                 [counts.length, counts.length, counts.length, truth.length]);
counts.forEach((row, i) => {
  const joints = messages["/joint_states"][i], command = messages["/cmd_vel"][i].twist;
  near(seconds(joints.header.stamp), row.time_s, 1e-6, "time of the counts");
  assert.equal(joints.name.length, 2);
  near(joints.position[0], 2 * Math.PI / ticks * row.left_ticks, kRounded, "left shaft");
  near(joints.position[1], 2 * Math.PI / ticks * row.right_ticks, kRounded, "right shaft");
  near(command.linear.x, radius * (row.left_command_radps + row.right_command_radps) / 2, kRounded, "commanded speed");
  near(command.angular.z, radius * (row.right_command_radps - row.left_command_radps) / wheelbase, kRounded, "commanded turn");
  const odometry = messages["/odom"][i].pose.pose, base = messages["/tf"][i].transforms[1];
  assert.deepEqual([base.header.frame_id, base.child_frame_id], ["odom", "base_link"]);
  assert.deepEqual(base.transform.rotation, odometry.orientation);
});
truth.forEach((row, i) => {
  const {header: {stamp, frame_id}, pose} = messages["/truth"][i];
  assert.equal(frame_id, "map");
  near(seconds(stamp), row.time_s, 1e-6, "time of the truth");
  near(pose.position.x, row.x_m, kRounded, "x");
  near(pose.position.y, row.y_m, kRounded, "y");
  near(Math.sin(yaw(pose.orientation) - row.theta_rad), 0, kRounded, "heading");
});
