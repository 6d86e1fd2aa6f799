"""Common Data Representation as ROS 2 puts it on the wire and into bags: OMG DDS-XTypes 7.4, encoding version 1, little
endian, and the message definitions of the types that are written."""
import struct

TIME = "int32 sec\nuint32 nanosec\n"
HEADER = "builtin_interfaces/Time stamp\nstring frame_id\n"
POINT = "float64 x\nfloat64 y\nfloat64 z\n"
QUATERNION = "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"
BAR = "=" * 80 + "\n"


def defined(own, *others):
    return own + "".join(BAR + "MSG: " + name + "\n" + text for name, text in others)


STAMPED = (("std_msgs/Header", HEADER), ("builtin_interfaces/Time", TIME))
POSE = (("geometry_msgs/Pose", "Point position\nQuaternion orientation\n"), ("geometry_msgs/Point", POINT),
        ("geometry_msgs/Quaternion", QUATERNION))
TRANSFORM_STAMPED = "std_msgs/Header header\nstring child_frame_id\nTransform transform\n"
TRANSFORM = (("geometry_msgs/Transform", "Vector3 translation\nQuaternion rotation\n"),
             ("geometry_msgs/Vector3", POINT), ("geometry_msgs/Quaternion", QUATERNION)) + STAMPED
DEFINITIONS = {
    "sensor_msgs/msg/JointState": defined(
        "# State of joints\nstd_msgs/Header header\n\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
        "float64[] effort\n", *STAMPED),
    "geometry_msgs/msg/PoseStamped": defined("std_msgs/Header header\nPose pose\n", *STAMPED, *POSE),
    "tf2_msgs/msg/TFMessage": defined("geometry_msgs/TransformStamped[] transforms\n",
                                      ("geometry_msgs/TransformStamped", TRANSFORM_STAMPED), *TRANSFORM),
    "nav_msgs/msg/Odometry": defined(
        "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
        "geometry_msgs/TwistWithCovariance twist\n",
        ("geometry_msgs/PoseWithCovariance", "Pose pose\nfloat64[36] covariance\n"),
        ("geometry_msgs/TwistWithCovariance", "Twist twist\nfloat64[36] covariance\n"),
        ("geometry_msgs/Twist", "Vector3  linear\nVector3  angular\n"), ("geometry_msgs/Vector3", POINT),
        *STAMPED, *POSE),
    "geometry_msgs/msg/Twist": defined("Vector3  linear\nVector3  angular\n", ("geometry_msgs/Vector3", POINT)),
    "geometry_msgs/msg/TwistStamped": defined(
        "std_msgs/Header header\nTwist twist\n", ("geometry_msgs/Twist", "Vector3  linear\nVector3  angular\n"),
        ("geometry_msgs/Vector3", POINT), *STAMPED),
    "std_msgs/msg/String": "string data\n",
}


class Cdr:
    """Grows field by field; every number stands at a multiple of its size behind the four bytes of the header."""

    def __init__(self):
        self.data = bytearray()

    def number(self, form, value):
        size = struct.calcsize(form)
        self.data += b"\0" * (-len(self.data) % size)
        self.data += struct.pack("<" + form, value)
        return self

    def string(self, text):
        encoded = text.encode() + b"\0"
        self.number("I", len(encoded))
        self.data += encoded
        return self

    def doubles(self, values):
        for value in values:
            self.number("d", value)
        return self

    def sequence(self, values):
        self.number("I", len(values))
        return self.doubles(values)

    def header(self, ns, frame):
        self.number("i", ns // 10**9).number("I", ns % 10**9)
        return self.string(frame)

    def bytes(self):
        return b"\0\1\0\0" + bytes(self.data)


def joint_state(ns, names, positions, velocities):
    m = Cdr().header(ns, "")
    m.number("I", len(names))
    for name in names:
        m.string(name)
    return m.sequence(positions).sequence(velocities).sequence([]).bytes()


def pose_stamped(ns, frame, position, quaternion):
    return Cdr().header(ns, frame).doubles(position).doubles(quaternion).bytes()


def odometry(ns, frame, child, position, quaternion):
    return (Cdr().header(ns, frame).string(child).doubles(position).doubles(quaternion).doubles([0.0] * 36)
            .doubles([0.0] * 6).doubles([0.0] * 36).bytes())


def twist(linear, angular):
    return Cdr().doubles([linear, 0.0, 0.0, 0.0, 0.0, angular]).bytes()


def twist_stamped(ns, linear, angular):
    return Cdr().header(ns, "base_link").doubles([linear, 0.0, 0.0, 0.0, 0.0, angular]).bytes()


def tf_message(transforms):
    m = Cdr().number("I", len(transforms))
    for ns, frame, child, translation, quaternion in transforms:
        m.header(ns, frame).string(child).doubles(translation).doubles(quaternion)
    return m.bytes()


def text_message(text):
    return Cdr().string(text).bytes()
