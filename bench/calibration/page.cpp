#include "bench/calibration/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbsim::bench {
namespace {

constexpr double kWidth = 860, kRow = 26, kLeft = 130, kGap = 30, kTop = 46;

std::string panel(const std::vector<MethodScore>& scores, std::size_t figure, double x0, double width, double range) {
  const double middle = x0 + width / 2, bottom = kTop + kRow * double(scores.size());
  const auto x = [&](double value) { return middle + std::clamp(value / range, -1.0, 1.0) * width / 2; };
  std::string svg = fmt::format("<text x=\"{:.1f}\" y=\"20\" text-anchor=\"middle\" class=\"h\">{}</text>\n", middle,
                                kFigures[figure]);
  for (const double tick : {-range, -range / 2, 0.0, range / 2, range}) {
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" class=\"{3}\"/>\n<text x=\"{0:.1f}\" "
        "y=\"{4:.1f}\" text-anchor=\"middle\">{5:g}</text>\n",
        x(tick), kTop - 6, bottom, tick == 0 ? "zero" : "grid", bottom + 16, tick);
  }
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const FigureScore& f = scores[i].figures[figure];
    const double y = kTop + kRow * (double(i) + 0.5);
    if (f.robots == 0) {
      svg +=
          fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">cannot be seen</text>\n", middle, y + 4);
      continue;
    }
    svg += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" class=\"bar\"/>\n",
                       x(f.bias - 2 * f.spread), x(f.bias + 2 * f.spread), y, y);
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/>\n", x(f.bias), y);
  }
  return svg;
}

}  // namespace

const std::array<const char*, 3> kFigures{"E_d", "E_b", "mean radius"};

std::string score_table(const std::vector<MethodScore>& scores) {
  std::string text = "| method |";
  for (const char* f : kFigures) text += fmt::format(" {0} bias | {0} spread | {0} covered |", f);
  text += "\n|---|" + std::string("---|---|---|---|---|---|---|---|---|") + "\n";
  for (const MethodScore& s : scores) {
    text += fmt::format("| {} |", s.name);
    for (const FigureScore& f : s.figures) {
      if (f.robots == 0) {
        text += " cannot be seen | | |";
        continue;
      }
      text += fmt::format(" {:+.1f} ± {:.1f} | {:.1f} | {} |", f.bias, f.bias_se, f.spread,
                          f.intervals > 0 ? fmt::format("{:.1f} %", 100 * f.covered) : "");
    }
    text += "\n";
  }
  return text;
}

std::string score_picture(const std::vector<MethodScore>& scores) {
  const double height = kTop + kRow * double(scores.size()) + 44;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n<style>.h{{font-weight:bold;font-size:14px}}.grid{{stroke:#ddd}}.zero{{stroke:#888}}"
      ".bar{{stroke:#4477aa;stroke-width:5;stroke-opacity:.45}}circle{{fill:#224466}}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      kWidth, height);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", kLeft - 10,
                       kTop + kRow * (double(i) + 0.5) + 4, scores[i].name);
  }
  const double width = (kWidth - kLeft - 2 * kGap - 20) / 3;
  for (std::size_t figure = 0; figure < 3; ++figure) {
    double range = 5;
    for (const MethodScore& s : scores)
      range = std::max(range, std::abs(s.figures[figure].bias) + 2 * s.figures[figure].spread);
    const double step = std::pow(10, std::floor(std::log10(range)));
    svg +=
        panel(scores, figure, kLeft + double(figure) * (width + kGap), width, step * std::ceil(range / step * 2) / 2);
  }
  svg += fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">error, parts of ten thousand: mean (dot) "
      "and two standard deviations over the robots</text>\n</svg>\n",
      kWidth / 2, height - 8);
  return svg;
}

}  // namespace umbsim::bench
