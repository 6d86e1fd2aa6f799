// Wheels that are a mesh: what bounds it, where its file is found; else a size that is given.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "sim/urdf/completed.h"
#include "tests/sim/urdf_text.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;
using testing::kRobot;
using testing::refusal_of_file;
using testing::with;
using testing::written;

constexpr double kRadius_m = 0.097, kWidth_m = 0.05, kMiddle_m = 0.01;

struct Point {
  double x, y, z;
};

// Triangles of a drum about z from kMiddle - w/2 to kMiddle + w/2, `unit` metres to one.
std::vector<Point> drum(double unit) {
  std::vector<Point> points;
  for (int i = 0; i < 64; ++i) {
    for (const auto& [k, side] : {std::pair{i, -1}, {i + 1, -1}, {i, 1}}) {
      const double angle = 2 * M_PI * k / 64;
      points.push_back({kRadius_m * std::cos(angle) / unit, kRadius_m * std::sin(angle) / unit,
                        (kMiddle_m + side * kWidth_m / 2) / unit});
    }
  }
  return points;
}

std::string binary_stl(const std::vector<Point>& points) {
  std::string data(80, 's');  // not "solid"
  const auto put = [&](const auto& value) { data.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(std::uint32_t(points.size() / 3));
  for (std::size_t i = 0; i < points.size(); i += 3) {
    for (int k = 0; k < 3; ++k) put(0.f);
    for (std::size_t k = i; k < i + 3; ++k) put(float(points[k].x)), put(float(points[k].y)), put(float(points[k].z));
    put(std::uint16_t(0));
  }
  return data;
}

std::string lines(const std::vector<Point>& points, const std::string& before, const std::string& word) {
  std::ostringstream text;
  text.precision(12);
  text << before;
  for (const Point& p : points) text << word << " " << p.x << " " << p.y << " " << p.z << "\n";
  return text.str();
}

std::string collada(const std::vector<Point>& points) {
  std::ostringstream text;
  text.precision(12);
  text << "<COLLADA><asset><unit meter=\"0.001\"/></asset><library_geometries><geometry id=\"g\"><mesh>"
          "<source id=\"p\"><float_array>";
  for (const Point& p : points) text << p.x << " " << p.y << " " << p.z << " ";
  text << "</float_array></source><vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices></mesh>"
          "</geometry></library_geometries><library_visual_scenes><visual_scene id=\"s\"><node>"
          "<scale>2 2 2</scale><instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes></COLLADA>";
  return text.str();
}

class MeshWheel : public ::testing::Test {
 protected:
  // Both wheels as the mesh, whose z is the joint's y.
  std::string robot(const std::string& mesh) const {
    const std::string cylinder = "<cylinder radius=\"0.1\" length=\"0.04\"/>";
    return with(with(kRobot, cylinder, mesh), cylinder, mesh);
  }
  void put(const std::string& name, const std::string& data) const {
    const fs::path file = fs::path(written(kRobot)).parent_path() / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << data;
  }
  void expect_wheels(const std::string& mesh) const {
    std::vector<Remark> remarks;
    const RobotModel got = load_robot(written(robot(mesh)), {}, {}, &remarks);
    EXPECT_TRUE(got.outside_shapes);
    ASSERT_FALSE(remarks.empty());
    EXPECT_EQ(remarks[0].kind, Remark::Kind::assumed);
    EXPECT_NE(remarks[0].text.find("what bounds its mesh"), std::string::npos) << remarks[0].text;
    for (const Wheel& w : got.wheels) {
      EXPECT_NEAR(w.radius_m, kRadius_m, 1e-7);
      EXPECT_NEAR(w.width_m, kWidth_m, 1e-7);
    }
    // rpy = pi/2 about x turns z to -y: both middles lie 10 mm to the right.
    EXPECT_NEAR(got.wheelbase_m(), 0.4, 1e-7);
    EXPECT_NEAR(got.wheels[0].along_joint_m, -kMiddle_m, 1e-7);
  }
};

TEST_F(MeshWheel, BinaryStlInMillimetres) {
  put("meshes/wheel.stl", binary_stl(drum(0.001)));
  expect_wheels("<mesh filename=\"meshes/wheel.stl\" scale=\"0.001 0.001 0.001\"/>");
}

TEST_F(MeshWheel, TextStlInAPackage) {
  put("some_robot/meshes/wheel.STL", lines(drum(1), "solid drum\n", " vertex"));
  expect_wheels("<mesh filename=\"package://some_robot/meshes/wheel.STL\"/>");
}

TEST_F(MeshWheel, Obj) {
  put("wheel.obj", lines(drum(1), "# a drum\n", "v"));
  expect_wheels("<mesh filename=\"file://wheel.obj\"/>");
}

TEST_F(MeshWheel, ColladaWithUnitAndScene) {
  put("wheel.dae", collada(drum(0.002)));
  expect_wheels("<mesh filename=\"wheel.dae\"/>");
}

TEST_F(MeshWheel, NotFoundNotRoundNotReadable) {
  const auto refused = [&](const std::string& mesh) { return refusal_of_file(written(robot(mesh))); };
  EXPECT_NE(refused("<mesh filename=\"package://a/b.stl\"/>").find("'package://a/b.stl' is not found"),
            std::string::npos);
  put("cut.stl", binary_stl(drum(1)).substr(0, 500));
  EXPECT_NE(refused("<mesh filename=\"cut.stl\"/>").find("cannot be read"), std::string::npos);
  std::vector<Point> half = drum(1);
  std::erase_if(half, [](const Point& p) { return p.x < 0; });
  put("half.obj", lines(half, "", "v"));
  EXPECT_NE(refused("<mesh filename=\"half.obj\"/>").find("not round"), std::string::npos);
}

TEST_F(MeshWheel, GivenSize) {
  const std::string text = robot("<mesh filename=\"package://a/b.stl\"/>");
  const RobotModel got = load_robot(written(text), {}, {0.1, 0.03});
  EXPECT_DOUBLE_EQ(got.wheels[1].radius_m, 0.1);
  EXPECT_DOUBLE_EQ(got.wheels[1].width_m, 0.03);
  EXPECT_DOUBLE_EQ(got.wheelbase_m(), 0.4);
}

// A copy that travels without its meshes.
TEST_F(MeshWheel, CopyWithItsWheelsReadsTheSame) {
  put("meshes/wheel.stl", binary_stl(drum(1)));
  const std::string text = robot("<mesh filename=\"meshes/wheel.stl\"/>");
  const RobotModel whole = load_robot(written(text));
  const std::string copy = urdf_with_wheels(text, whole);
  fs::remove_all(fs::path(written(text)).parent_path() / "meshes");
  const RobotModel again = load_robot(written(copy));
  EXPECT_FALSE(again.outside_shapes);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(again.wheels[i].radius_m, whole.wheels[i].radius_m, 1e-12);
    EXPECT_NEAR(again.wheels[i].width_m, whole.wheels[i].width_m, 1e-12);
    EXPECT_TRUE(again.wheels[i].centre_m.isApprox(whole.wheels[i].centre_m, 1e-9));
  }
  EXPECT_TRUE(again.base.com_m.isApprox(whole.base.com_m, 1e-9));
}

}  // namespace
}  // namespace umbsim
