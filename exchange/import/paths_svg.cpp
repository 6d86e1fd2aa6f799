#include "exchange/import/paths_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "odometry/dead_reckoning.h"

namespace umbsim::exchange {
namespace {

constexpr double kWidth = 800, kMargin = 50, kLegend = 40;
constexpr std::size_t kPoints = 600;  // of a line
constexpr const char* kColours[] = {"#1b6ca8", "#c8553d", "#3a7d44", "#7b4b94", "#b08900", "#007c89"};

using Line = std::vector<Pose2>;

Line tracked(const RecordedRun& run) {
  Line line;
  const std::size_t step = std::max<std::size_t>(1, run.truth.size() / kPoints);
  for (std::size_t i = 0; i < run.truth.size(); i += step) line.push_back(run.truth[i].X_WB);
  line.push_back(run.truth.back().X_WB);
  return line;
}

Line reckoned(const RecordedRun& run, const RecordedRobot& robot) {
  DeadReckoning odometry({robot.wheel_radius_m, robot.wheel_radius_m, robot.wheelbase_m, robot.ticks_per_revolution},
                         run.truth.front().X_WB, run.encoders.front().left_ticks, run.encoders.front().right_ticks);
  Line line;
  const std::size_t step = std::max<std::size_t>(1, run.encoders.size() / kPoints);
  for (std::size_t i = 0; i < run.encoders.size(); ++i) {
    odometry.update(run.encoders[i].left_ticks, run.encoders[i].right_ticks);
    if (i % step == 0 || i + 1 == run.encoders.size()) line.push_back(odometry.pose());
  }
  return line;
}

/// Floor to page.
struct Page {
  double left, top, scale;
  double x(double x_m) const { return kMargin + (x_m - left) * scale; }
  double y(double y_m) const { return kMargin + (top - y_m) * scale; }
};

std::string polyline(const Line& line, const Page& page, const char* colour, bool dashed) {
  std::string points;
  for (const Pose2& p : line) points += fmt::format("{:.1f},{:.1f} ", page.x(p.x_m), page.y(p.y_m));
  return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n", points, colour,
                     dashed ? 1.2 : 2, dashed ? " stroke-dasharray=\"5 4\"" : "");
}

// A length of 1, 2 or 5 times a power of ten, about a quarter of the width.
double scale_bar_m(double width_m) {
  const double target = width_m / 4;
  const double power = std::pow(10, std::floor(std::log10(target)));
  for (const double m : {5.0, 2.0, 1.0}) {
    if (m * power <= target) return m * power;
  }
  return power;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

}  // namespace

std::string paths_svg(const Recording& recording) {
  std::vector<Line> seen, believed;
  double x[2] = {0, 0}, y[2] = {0, 0};
  for (const RecordedRun& run : recording.runs) {
    seen.push_back(tracked(run));
    believed.push_back(reckoned(run, recording.robot));
    for (const Line* line : {&seen.back(), &believed.back()}) {
      for (const Pose2& p : *line) {
        x[0] = std::min(x[0], p.x_m);
        x[1] = std::max(x[1], p.x_m);
        y[0] = std::min(y[0], p.y_m);
        y[1] = std::max(y[1], p.y_m);
      }
    }
  }
  const double wide = std::max(x[1] - x[0], 0.1), high = std::max(y[1] - y[0], 0.1);
  const double scale = (kWidth - 2 * kMargin) / std::max(wide, high);
  const Page page{x[0], y[1], scale};
  const double height = high * scale + 2 * kMargin + kLegend;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      kWidth, height);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const char* colour = kColours[i % std::size(kColours)];
    svg += polyline(believed[i], page, colour, true) + polyline(seen[i], page, colour, false);
    const Pose2& start = seen[i].front();
    const Pose2& end = seen[i].back();
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"none\" stroke=\"{}\"/>\n", page.x(start.x_m),
                       page.y(start.y_m), colour);
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", page.x(end.x_m), page.y(end.y_m),
                       colour);
  }
  const double bar = scale_bar_m(kWidth / scale), at = height - kLegend + 12;
  svg +=
      fmt::format("<path d=\"M{:.1f} {:.1f}h{:.1f}\" stroke=\"#222\" stroke-width=\"2\"/>\n", kMargin, at, bar * scale);
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{:g} m</text>\n", kMargin, at + 16, bar);
  svg += fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}: {} runs; solid: tracker, dashed: odometry; "
      "ring: start, dot: end</text>\n</svg>\n",
      kWidth - kMargin, at + 16, escaped(recording.title), recording.runs.size());
  return svg;
}

}  // namespace umbsim::exchange
