#include "bench/speed/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbsim::bench {
namespace {

constexpr double kWidth = 760, kHeight = 440, kLeft = 70, kRight = 190, kTop = 40, kBottom = 55;
constexpr double kMinSpeed = 10, kMaxSpeed = 50000, kMinError = 1e-5, kMaxError = 100;

double px(double speed) {
  const double part = std::log(std::clamp(speed, kMinSpeed, kMaxSpeed) / kMinSpeed) / std::log(kMaxSpeed / kMinSpeed);
  return kLeft + part * (kWidth - kLeft - kRight);
}
double py(double error) {
  const double part = std::log(std::clamp(error, kMinError, kMaxError) / kMinError) / std::log(kMaxError / kMinError);
  return kHeight - kBottom - part * (kHeight - kTop - kBottom);
}

std::string axes() {
  std::string svg;
  for (double speed = kMinSpeed; speed <= kMaxSpeed; speed *= 10) {
    svg += fmt::format("<line x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}' stroke='#ddd'/>"
                       "<text x='{0:.1f}' y='{3}' text-anchor='middle'>{4}</text>\n",
                       px(speed), kTop, kHeight - kBottom, kHeight - kBottom + 18, speed);
  }
  for (double error = kMinError; error <= kMaxError * 1.001; error *= 10) {
    svg += fmt::format("<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' stroke='#ddd'/>"
                       "<text x='{3}' y='{4:.1f}' text-anchor='end'>{5:g}</text>\n",
                       kLeft, kWidth - kRight, py(error), kLeft - 8, py(error) + 4, error);
  }
  svg += fmt::format("<text x='{}' y='{}' text-anchor='middle'>simulated seconds per second, one core</text>\n",
                     (kLeft + kWidth - kRight) / 2, kHeight - 12);
  svg += fmt::format("<text transform='translate(16 {}) rotate(-90)' text-anchor='middle'>return error after 16 m, mm"
                     "</text>\n", (kTop + kHeight - kBottom) / 2);
  return svg;
}

}  // namespace

std::string accuracy_plot(const std::vector<PlotPoint>& points) {
  constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000"};
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' font-family='sans-serif' font-size='12'>\n"
      "<rect width='{0}' height='{1}' fill='white'/>\n<text x='{2}' y='22' font-size='15'>Accuracy against cost: 4 m "
      "square, nominal LabMate</text>\n", kWidth, kHeight, kLeft);
  svg += axes();
  std::vector<std::string> engines;
  for (const PlotPoint& p : points) {
    if (std::find(engines.begin(), engines.end(), p.engine) == engines.end()) engines.push_back(p.engine);
  }
  for (std::size_t i = 0; i < engines.size(); ++i) {
    const char* colour = kColours[i % 5];
    std::string line;
    for (const PlotPoint& p : points) {
      if (p.engine != engines[i]) continue;
      line += fmt::format("{:.1f},{:.1f} ", px(p.sim_s_per_s), py(p.error_mm));
      svg +=
          fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='4' fill='{}'/>\n", px(p.sim_s_per_s), py(p.error_mm), colour);
    }
    svg += fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='2'/>\n", line, colour);
    svg += fmt::format("<text x='{}' y='{}' fill='{}'>{}</text>\n", kWidth - kRight + 14, kTop + 20 + 20 * double(i),
                       colour, engines[i]);
  }
  return svg + "</svg>\n";
}

}  // namespace umbsim::bench
