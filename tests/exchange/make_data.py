#!/usr/bin/python3
"""Writes the logs in data/ by independent code: `/usr/bin/python3 make_data.py [FOLDER [SECONDS [HZ]]]`.

MCAP and CDR from their specifications (mcap.py, cdr.py), SQLite by Python's module, ROS 1 by Debian's python3-rosbag
(left out where it is not there). All of them hold the same drive (drive.py).
"""
import math
import os
import sqlite3
import sys

import cdr
import mcap
import drive as the_drive
from drive import BELIEVED, START_NS, drive

FOLDER = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(os.path.abspath(__file__)), "data")
if len(sys.argv) > 3:
    the_drive.ENCODER_HZ = the_drive.TRACKER_HZ = int(sys.argv[3])
ROWS, POSES, RUNS = drive(float(sys.argv[2]) if len(sys.argv) > 2 else None)
JOINTS = ["wheel_left_joint", "wheel_right_joint"]
RAD = 2 * math.pi / BELIEVED["ticks_per_revolution"]


def path(name):
    return os.path.join(FOLDER, name)


def quaternion(theta):
    return [0.0, 0.0, math.sin(theta / 2), math.cos(theta / 2)]


def seconds(ns, decimals=9):
    return f"{ns // 10**9}.{ns % 10**9:09d}"[: 11 + decimals]


def merged(*series):
    return sorted((m for s in series for m in s), key=lambda m: m[0])


def csv_files():
    with open(path("ticks.csv"), "w") as f:
        f.write("time_s,left_ticks,right_ticks\n")
        f.writelines(f"{seconds(t)},{l},{r}\n" for t, l, r, _, _ in ROWS)
    with open(path("german.csv"), "w") as f:  # a decimal comma, milliseconds, one file for both, wrapped degrees
        f.write("Zeit [ms];Encoder links [counts];Encoder rechts [counts];x [mm];y [mm];heading [deg]\n")
        for (t, l, r, _, _), (_, x, y, a) in zip(ROWS, POSES):
            a = math.degrees(math.remainder(a, 2 * math.pi))
            f.write(f"{(t - START_NS) / 1e6:.1f};{l};{r};{x * 1e3:.3f};{y * 1e3:.3f};{a:.4f}\n".replace(".", ","))
    with open(path("truth.tum"), "w") as f:
        for t, x, y, a in POSES:
            f.write(f"{seconds(t)} {x:.7f} {y:.7f} 0 " + " ".join(f"{v:.9f}" for v in quaternion(a)) + "\n")
    with open(path("truth.kitti"), "w") as f, open(path("times.txt"), "w") as times:
        for t, x, y, a in POSES:
            c, s = math.cos(a), math.sin(a)
            f.write(f"{c:.9f} {-s:.9f} 0 {x:.7f} {s:.9f} {c:.9f} 0 {y:.7f} 0 0 1 0\n")
            times.write(seconds(t) + "\n")
    with open(path("echo_joint_states.csv"), "w") as f:
        for t, l, r, wl, wr in ROWS:
            f.write(f"{t // 10**9},{t % 10**9},base_link,{JOINTS[0]},{JOINTS[1]},{l * RAD!r},{r * RAD!r},{wl!r},{wr!r},\n")
    with open(path("echo_mocap.csv"), "w") as f:
        for t, x, y, a in POSES:
            f.write(f"{t // 10**9},{t % 10**9},mocap,{x!r},{y!r},0.0," + ",".join(repr(v) for v in quaternion(a)) + "\n")
    with open(path("plotjuggler.csv"), "w") as f:  # every time of any topic is a row, blank where a topic has none
        position = "/mocap/pose/pose/position/"
        turn = "/mocap/pose/pose/orientation/"
        columns = [f"/joint_states/{j}/{q}" for j in JOINTS for q in ("position", "velocity")]
        f.write(",".join(["__time"] + columns + [position + c for c in "xyz"] + [turn + c for c in "xyzw"] +
                         [turn + "yaw", turn + "yaw_deg"]) + "\n")
        wheels = [(t, [l * RAD, wl, r * RAD, wr]) for t, l, r, wl, wr in ROWS]
        tracked = [(t, [x, y, 0.0] + quaternion(a) + [a, math.degrees(a)]) for t, x, y, a in POSES]
        for t in sorted({t for t, _ in wheels} | {t for t, _ in tracked}):
            a, b = dict_of(wheels).get(t, [""] * 4), dict_of(tracked).get(t, [""] * 9)
            f.write(",".join([seconds(t)] + [str(v) for v in a + b]) + "\n")
    with open(path("runs.csv"), "w") as f:
        f.write("id,from_s,to_s,direction\n")
        for i, (direction, begin, end) in enumerate(RUNS):
            f.write(f"{direction}-{i // 2 + 1},{begin - 0.5:.2f},{end + 0.5:.2f},{direction}\n")


KEPT = {}


def dict_of(pairs):
    if id(pairs) not in KEPT:
        KEPT[id(pairs)] = dict(pairs)
    return KEPT[id(pairs)]


def ros2_messages(tracked_as="pose", namespace=""):
    """JointState with a gripper before the wheels, the truth, the robot's own odometry, and something else."""
    topics = {namespace + "/joint_states": "sensor_msgs/msg/JointState", namespace + "/odom": "nav_msgs/msg/Odometry",
              "/chatter": "std_msgs/msg/String"}
    wheels, own, tracked = [], [], []
    for t, l, r, wl, wr in ROWS:
        wheels.append((t, namespace + "/joint_states",
                       cdr.joint_state(t, ["gripper"] + JOINTS, [0.25, l * RAD, r * RAD], [0.0, wl, wr])))
    for t, x, y, a in POSES[::20]:
        own.append((t, namespace + "/odom", cdr.odometry(t, "odom", "base_link", [x, y, 0.0], quaternion(a))))
    truth_type = "geometry_msgs/msg/PoseStamped" if tracked_as == "pose" else "tf2_msgs/msg/TFMessage"
    topic = namespace + ("/mocap/pose" if tracked_as == "pose" else "/tf")
    topics[topic] = truth_type
    for t, x, y, a in POSES:
        data = (cdr.pose_stamped(t, "mocap", [x, y, 0.0], quaternion(a)) if tracked_as == "pose" else
                cdr.tf_message([(t, "world", "base_link", [x, y, 0.0], quaternion(a))]))
        tracked.append((t, topic, data))
    other = [(START_NS, "/chatter", cdr.text_message("hello"))]
    return topics, merged(wheels, own, tracked, other)


def with_definitions(topics):
    return {topic: (kind, cdr.DEFINITIONS[kind]) for topic, kind in topics.items()}


def mcap_files():
    topics, messages = ros2_messages()
    mcap.write(path("drive_zstd.mcap"), with_definitions(topics), messages, "zstd")
    mcap.write(path("drive_lz4.mcap"), with_definitions(topics), messages, "lz4")
    topics, messages = ros2_messages("tf")
    mcap.write(path("drive_tf.mcap"), with_definitions(topics), messages, "zstd")


def db3_files():
    for name, defined in (("drive", True), ("drive_old", False)):  # definitions came with ROS 2 Iron
        folder = path(name + "_db3")
        os.makedirs(folder, exist_ok=True)
        file = os.path.join(folder, name + "_0.db3")
        if os.path.exists(file):
            os.remove(file)
        topics, messages = ros2_messages()
        if not defined:
            messages = messages[: len(messages) // 2]
        with sqlite3.connect(file) as db:
            db.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
                       "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")
            db.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT "
                       "NULL, data BLOB NOT NULL)")
            db.execute("CREATE INDEX timestamp_idx ON messages (timestamp ASC)")
            ids = {topic: i + 1 for i, topic in enumerate(topics)}
            db.executemany("INSERT INTO topics VALUES(?,?,?,'cdr','')", [(ids[t], t, k) for t, k in topics.items()])
            db.executemany("INSERT INTO messages(topic_id,timestamp,data) VALUES(?,?,?)",
                           [(ids[topic], t, data) for t, topic, data in messages])
            if defined:
                db.execute("CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding "
                           "TEXT NOT NULL, encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL)")
                db.executemany("INSERT INTO message_definitions(topic_type,encoding,encoded_message_definition,"
                               "type_description_hash) VALUES(?,'ros2msg',?,'')",
                               [(k, cdr.DEFINITIONS[k]) for k in topics.values()])
        db.close()
        with open(os.path.join(folder, "metadata.yaml"), "w") as f:
            f.write("rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n  relative_file_paths:\n"
                    f"    - {name}_0.db3\n  compression_format: \"\"\n  compression_mode: \"\"\n")


def ros1_file():
    try:
        import genpy
        import rosbag
        from geometry_msgs.msg import PoseStamped
        from sensor_msgs.msg import JointState
        from std_msgs.msg import String
    except ImportError as e:
        print("no ROS 1 bag:", e)
        return
    with rosbag.Bag(path("drive.bag"), "w", compression="bz2") as bag:
        messages = [(t, "/joint_states", (l, r, wl, wr)) for t, l, r, wl, wr in ROWS]
        messages += [(t, "/vicon/robot", (x, y, a)) for t, x, y, a in POSES]
        bag.write("/chatter", String(data="hello"), genpy.Time(START_NS // 10**9, START_NS % 10**9))
        for t, topic, values in sorted(messages, key=lambda m: m[:2]):
            stamp = genpy.Time(t // 10**9, t % 10**9)
            if topic == "/joint_states":
                message = JointState(name=JOINTS, position=[v * RAD for v in values[:2]], velocity=list(values[2:]))
            else:
                message = PoseStamped()
                message.pose.position.x, message.pose.position.y = values[:2]
                q = message.pose.orientation
                q.x, q.y, q.z, q.w = quaternion(values[2])
            message.header.stamp = stamp
            bag.write(topic, message, stamp)


def spoiled_files():
    """Fifteen seconds each, with one thing wrong."""
    folder = path("spoiled")
    os.makedirs(folder, exist_ok=True)
    rows, poses = ROWS[:300], POSES[:300]

    def bag(name, wheels=None, tracked=None, topics=None, definitions=None, encoding="cdr", names=JOINTS, scale=1.0,
            length=1.0, turn=1.0, mangle=None, topic="/joint_states", truth="/mocap/pose", more=()):
        kinds = {topic: "sensor_msgs/msg/JointState", truth: "geometry_msgs/msg/PoseStamped"}
        kinds.update(topics or {})
        if wheels is None:
            wheels = [(t, topic, cdr.joint_state(t, names, [scale * l * RAD, scale * r * RAD], [wl, wr]))
                      for t, l, r, wl, wr in rows]
        if tracked is None:
            tracked = [(t, truth, cdr.pose_stamped(t, "mocap", [length * x, length * y, 0.0], quaternion(turn * a)))
                       for t, x, y, a in poses]
        messages = merged(wheels, tracked, *more)
        used = {m[1] for m in messages}
        described = {k: v for k, v in with_definitions(kinds).items() if k in used}
        described.update(definitions or {})
        mcap.write(os.path.join(folder, name + ".mcap"), described, mangle(messages) if mangle else messages, "zstd",
                   encoding=encoding)

    def joint(i, position, **changes):
        t, l, r, wl, wr = rows[i]
        return (t, "/joint_states", cdr.joint_state(changes.get("at", t), changes.get("names", JOINTS), position, [wl, wr]))

    def with_row(i, message):
        all_rows = [joint(k, [l * RAD, r * RAD]) for k, (_, l, r, _, _) in enumerate(rows)]
        all_rows[i] = message
        return all_rows

    def with_pose(i, position, q):
        t = poses[i][0]
        good = [(t, "/mocap/pose", cdr.pose_stamped(t, "mocap", [x, y, 0.0], quaternion(a))) for t, x, y, a in poses]
        good[i] = (t, "/mocap/pose", cdr.pose_stamped(t, "mocap", position, q))
        return good

    nan = float("nan")
    bag("good")
    bag("nan_position", with_row(120, joint(120, [nan, 1.0])))
    bag("nan_pose", tracked=with_pose(100, [nan, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]))
    bag("zero_quaternion", tracked=with_pose(100, [0.5, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]))
    bag("stamps_back", with_row(150, joint(150, [1.0, 1.0], at=rows[140][0])))
    bag("one_position", with_row(150, joint(150, [1.0])))
    bag("outlier", tracked=with_pose(100, [poses[100][1] + 0.1, poses[100][2] + 0.1, 0.0], quaternion(poses[100][3])))
    bag("swapped", names=JOINTS[::-1])
    bag("arm_only", names=["shoulder", "elbow"])
    bag("no_wheels", wheels=[])
    bag("no_truth", tracked=[])
    bag("positions_in_degrees", scale=180 / math.pi)
    bag("positions_by_ten", scale=10.0)
    bag("truth_in_millimetres", length=1000.0)
    bag("truth_by_ten", length=0.1)
    bag("heading_reversed", turn=-1.0)
    bag("json", encoding="json")
    bag("not_that_type", wheels=[(t, "/joint_states", b"\0\1\0\0" + b"\xff" * 40) for t, *_ in rows])
    bag("no_position_field", definitions={"/joint_states": (
        "sensor_msgs/msg/JointState", cdr.DEFINITIONS["sensor_msgs/msg/JointState"].replace("float64[] position\n", ""))})
    bag("undefined_type", definitions={"/joint_states": (
        "sensor_msgs/msg/JointState", "std_msgs/Header header\nmy_msgs/Wheel[] wheels\n")})
    second = [(t, "/b/joint_states", cdr.joint_state(t, JOINTS, [r * RAD, l * RAD], [wr, wl])) for t, l, r, wl, wr in rows]
    bag("two_robots", topics={"/b/joint_states": "sensor_msgs/msg/JointState"}, more=[second])
    other = [(t, "/b/pose", cdr.pose_stamped(t, "mocap", [y, x, 0.0], quaternion(-a))) for t, x, y, a in poses]
    bag("two_truths", topics={"/b/pose": "geometry_msgs/msg/PoseStamped"}, more=[other])
    bag("four_wheels", wheels=[(t, "/joint_states", cdr.joint_state(
        t, ["front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel"],
        [l * RAD, r * RAD, l * RAD, r * RAD], [wl, wr, wl, wr])) for t, l, r, wl, wr in rows])
    bag("interleaved", wheels=merged([(t, "/joint_states", cdr.joint_state(t, JOINTS, [l * RAD, r * RAD], [wl, wr]))
                                      for t, l, r, wl, wr in rows],
                                     [(t + 1000, "/joint_states", cdr.joint_state(t, JOINTS, [r * RAD, l * RAD], [wr, wl]))
                                      for t, l, r, wl, wr in rows]))
    late = 3_600_000_000_000
    bag("other_clock", tracked=[(t + late, "/mocap/pose", cdr.pose_stamped(t + late, "mocap", [x, y, 0.0], quaternion(a)))
                                for t, x, y, a in poses])
    bag("looks_aside", turn=1.0, tracked=[(t, "/mocap/pose", cdr.pose_stamped(
        t, "mocap", [x, y, 0.0], quaternion(a + math.pi / 2))) for t, x, y, a in poses])
    bag("y_up", tracked=[(t, "/mocap/pose", cdr.pose_stamped(
        t, "mocap", [y, 0.0, x], [0.0, math.sin(a / 2), 0.0, math.cos(a / 2)])) for t, x, y, a in poses])
    bag("lying", tracked=[(t, "/mocap/pose", cdr.pose_stamped(t, "mocap", [x, y, 0.0], [math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]))
                          for t, x, y, a in poses])
    tf = [(t, "/tf", cdr.tf_message([(t, "map", "odom", [0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]),
                                     (t, name + "/odom", name + "/base_link", [x, y, 0.0], quaternion(a))]))
          for t, x, y, a in poses for name in ("a", "b")]
    bag("tf_of_two", tracked=tf, topics={"/tf": "tf2_msgs/msg/TFMessage"})
    bag("two_parents", topics={"/tf": "tf2_msgs/msg/TFMessage"}, tracked=[
        (t, "/tf", cdr.tf_message([(t, "map" if i % 2 else "world", "base_link", [x, y, 0.0], quaternion(a))]))
        for i, (t, x, y, a) in enumerate(poses)])


def body_speeds(wl, wr):
    """What a drive controller is told so that it makes these wheel speeds, by what it believes."""
    return BELIEVED["wheel_radius_m"] * (wl + wr) / 2, BELIEVED["wheel_radius_m"] * (wr - wl) / BELIEVED["wheelbase_m"]


def with_commands(file, kind, topic, rows, others=()):
    """The first 15 s with commands of the body at every row of the wheels that `rows` keeps."""
    def command(t, wl, wr):
        v, w = body_speeds(wl, wr)
        return cdr.twist_stamped(t, v, w) if kind.endswith("Stamped") else cdr.twist(v, w)
    topics, messages = ros2_messages()
    messages = [m for m in messages if m[0] < ROWS[300][0]]
    topics.update({t: "geometry_msgs/msg/Twist" for t in others})
    topics[topic] = kind
    more = [(t, topic, command(t, wl, wr)) for i, (t, _, _, wl, wr) in enumerate(ROWS[:300]) if rows(i)]
    more += [(t, o, cdr.twist(0.7, 0.7)) for o in others for t, *_ in ROWS[:300:10]]
    mcap.write(path(file), with_definitions(topics), merged(messages, more), "zstd")


def database(file, topics, messages, packed=False):
    with sqlite3.connect(file) as db:
        db.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
                   "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")
        db.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT "
                   "NULL, data BLOB NOT NULL)")
        ids = {topic: i + 1 for i, topic in enumerate(topics)}
        db.executemany("INSERT INTO topics VALUES(?,?,?,'cdr','')", [(ids[t], t, k) for t, k in topics.items()])
        db.executemany("INSERT INTO messages(topic_id, timestamp, data) VALUES(?,?,?)",
                       [(ids[t], ns, mcap.zstd(data) if packed else data) for ns, t, data in messages])
    db.close()


def packed_files():
    """rosbag2 with --compression-mode file and message, and an MCAP file that somebody packed."""
    topics, messages = ros2_messages()
    messages = [m for m in messages if m[0] < ROWS[300][0]]
    for mode, name in (("FILE", "by_file"), ("MESSAGE", "by_message")):
        folder = path("packed_" + name)
        os.makedirs(folder, exist_ok=True)
        file = os.path.join(folder, name + "_0.db3")
        if os.path.exists(file):
            os.remove(file)
        database(file, topics, messages, mode == "MESSAGE")
        if mode == "FILE":
            with open(file, "rb") as plain, open(file + ".zstd", "wb") as packed:
                packed.write(mcap.zstd(plain.read()))
            os.remove(file)
            file += ".zstd"
        with open(os.path.join(folder, "metadata.yaml"), "w") as f:
            f.write("rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n  compression_format: zstd"
                    f"\n  compression_mode: {mode}\n  relative_file_paths:\n    - {os.path.basename(file)}\n")
    with open(path("spoiled/good.mcap"), "rb") as plain, open(path("packed.mcap.zst"), "wb") as packed:
        packed.write(mcap.zstd(plain.read()))


def command_files():
    with_commands("commands.mcap", "geometry_msgs/msg/Twist", "/cmd_vel", lambda i: True, ["/cmd_vel_nav"])
    # For three quarters of a second on the first side nothing is commanded.
    with_commands("commands_stamped.mcap", "geometry_msgs/msg/TwistStamped", "/diff_drive_controller/cmd_vel",
                  lambda i: i < 70 or i >= 85)


os.makedirs(FOLDER, exist_ok=True)
csv_files()
mcap_files()
db3_files()
ros1_file()
if len(sys.argv) < 3:
    spoiled_files()
    command_files()
    packed_files()
