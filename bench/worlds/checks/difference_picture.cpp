#include "bench/worlds/checks/difference_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbsim::worlds {
namespace {

constexpr double kWidth = 760, kLeft = 150, kRight = 30, kTop = 70, kBottom = 45;
constexpr double kRow = 16, kGap = 14;
constexpr double kLeast_rad = 1e-7, kMost_rad = 0.1;
constexpr const char* kColours[] = {"#0072b2", "#56b4e9", "#009e73", "#d55e00", "#e69f00", "#cc79a7"};

double px(double heading_rad) {
  const double part =
      std::log(std::clamp(heading_rad, kLeast_rad, kMost_rad) / kLeast_rad) / std::log(kMost_rad / kLeast_rad);
  return kLeft + part * (kWidth - kLeft - kRight);
}

std::vector<std::string> each(const std::vector<DifferenceBar>& bars, std::string DifferenceBar::*of) {
  std::vector<std::string> names;
  for (const DifferenceBar& b : bars) {
    if (std::find(names.begin(), names.end(), b.*of) == names.end()) names.push_back(b.*of);
  }
  return names;
}

}  // namespace

std::string difference_picture(const std::vector<DifferenceBar>& bars) {
  const std::vector<std::string> pairs = each(bars, &DifferenceBar::pair), parts = each(bars, &DifferenceBar::part);
  const double block = kRow * double(parts.size()) + kGap, bottom = kTop + block * double(pairs.size());
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' font-family='sans-serif' font-size='12'>\n"
      "<rect width='{0}' height='{1}' fill='white'/>\n<text x='{2}' y='22' font-size='15'>Heading that two engines "
      "make of the same counts, nothing wrong</text>\n",
      kWidth, bottom + kBottom, kLeft);
  for (double x = kLeast_rad; x < 1.5 * kMost_rad; x *= 10) {
    svg += fmt::format(
        "<line x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}' stroke='#ddd'/>"
        "<text x='{0:.1f}' y='{3}' text-anchor='middle'>{4:g}</text>\n",
        px(x), kTop, bottom, bottom + 16, 1000 * x);
  }
  svg += fmt::format("<text x='{}' y='{}' text-anchor='middle'>mrad, root mean square over a part</text>\n",
                     (kLeft + kWidth - kRight) / 2, bottom + 36);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double x = kLeft + 95 * double(i);
    svg += fmt::format("<rect x='{}' y='38' width='12' height='12' fill='{}'/><text x='{}' y='48'>{}</text>\n", x,
                       kColours[i % 6], x + 17, parts[i]);
  }
  for (const DifferenceBar& b : bars) {
    const auto pair = std::find(pairs.begin(), pairs.end(), b.pair) - pairs.begin();
    const auto part = std::find(parts.begin(), parts.end(), b.part) - parts.begin();
    const double y = kTop + block * double(pair) + kRow * double(part);
    svg += fmt::format("<rect x='{}' y='{:.1f}' width='{:.1f}' height='{}' fill='{}'/>\n", kLeft, y + 3,
                       std::max(1.0, px(b.heading_rad) - kLeft), kRow - 4, kColours[std::size_t(part) % 6]);
    if (part == 0) {
      svg += fmt::format("<text x='{}' y='{:.1f}' text-anchor='end'>{}</text>\n", kLeft - 8,
                         y + kRow * double(parts.size()) / 2 + 4, b.pair);
    }
  }
  return svg + "</svg>\n";
}

}  // namespace umbsim::worlds
