#include "gap/answer/where.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

namespace umbsim::gap {
namespace {

constexpr std::size_t kSegments = 12;  // at most, of those that speak against no effect
constexpr double kEnds_m = 0.3;        // of a leg that count as its start and its stop
const Eigen::Vector3d kRateSd(2e-3, 2e-3, 2e-3);

struct Part {
  std::size_t run;
  int leg;
  std::string name;
  std::vector<Eigen::Vector3d> rates;  // per sample; zero outside the part
  std::size_t middle = 0;
};

std::vector<Part> parts_of(const Model& model, std::size_t r) {
  std::vector<Part> parts;
  const auto& truth = model.recording().runs[r].truth;
  const auto& path = model.nominal().tracks[r];
  const std::size_t n = model.filter(r).samples();
  for (const Stretch& s : model.stretches(r)) {
    if (s.kind == Stretch::Kind::still) continue;
    std::map<std::string, Part> named;
    double way = 0;
    for (std::size_t i = 1; i < n; ++i) {
      if (truth[i].time_s <= s.start_s || truth[i].time_s > s.end_s) continue;
      const double rolled = model.nominal().rolled_m[r][i];
      way += rolled;
      std::string name = "turn";
      if (s.kind == Stretch::Kind::leg) {
        name = way < kEnds_m ? "start" : way > std::abs(s.length_m) - kEnds_m ? "stop" : "cruise";
      }
      Part& part = named[name];
      if (part.rates.empty()) {
        part = {r, s.leg, name, std::vector<Eigen::Vector3d>(n, Eigen::Vector3d::Zero()), i};
      }
      const double share = name == "turn" ? std::abs((inverse(path[i - 1]) * path[i]).theta_rad) * 0.2 : rolled;
      part.rates[i] = Eigen::Vector3d(share, share, rolled);
      if (part.rates[part.middle].norm() == 0) part.middle = i;
    }
    for (auto& [name, part] : named) parts.push_back(std::move(part));
  }
  return parts;
}

// How much evidence each leg's start, cruise and stop and each turn of every run gives against the prediction of a fit,
// most first.
std::vector<SegmentScore> segment_scores(const Model& model, const Fit& fit) {
  const std::vector<Eigen::VectorXd> left = model.left_over(fit);
  std::vector<std::vector<SegmentScore>> per_run(left.size());
  tbb::parallel_for(std::size_t(0), left.size(), [&](std::size_t r) {
    const TrackFilter& filter = model.filter(r);
    for (const Part& part : parts_of(model, r)) {
      Eigen::MatrixXd raw(3 * Eigen::Index(filter.samples()), 3);
      for (int c = 0; c < 3; ++c) {
        std::vector<Eigen::Vector3d> impulses(filter.samples(), Eigen::Vector3d::Zero());
        for (std::size_t i = 0; i < impulses.size(); ++i) impulses[i][c] = part.rates[i][c];
        raw.col(c) = filter.propagate(impulses);
      }
      const Eigen::MatrixXd white = filter.whiten(raw);
      Eigen::Matrix3d M = kRateSd.asDiagonal() * (white.transpose() * white) * kRateSd.asDiagonal();
      M.diagonal().array() += 1;
      const Eigen::LLT<Eigen::Matrix3d> llt(M);
      const Eigen::Vector3d b = kRateSd.cwiseProduct(white.transpose() * left[r].head(white.rows()));
      double gain = 0.5 * b.dot(llt.solve(b));
      for (int c = 0; c < 3; ++c) gain -= std::log(llt.matrixLLT()(c, c));
      const Pose2& at = model.recording().runs[r].truth[part.middle].X_WB;
      const auto inside = [](const Eigen::Vector3d& rate) { return rate.norm() > 0; };
      const auto first = std::find_if(part.rates.begin(), part.rates.end(), inside);
      const auto last = std::find_if(part.rates.rbegin(), part.rates.rend(), inside);
      per_run[r].push_back({model.recording().runs[r].id, part.leg, part.name, gain, at.x_m, at.y_m,
                            std::size_t(first - part.rates.begin()), std::size_t(part.rates.rend() - last)});
    }
  });
  std::vector<SegmentScore> all;
  for (auto& scores : per_run) all.insert(all.end(), scores.begin(), scores.end());
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  return all;
}

std::string in_words(const std::string& part) {
  if (part == "cruise") return "along the legs";
  return part == "turn" ? "in the turns" : "at the legs' " + part + "s";
}

using Shares = std::map<std::string, double>;

Shares::value_type most(const Shares& shares) {
  return *std::max_element(shares.begin(), shares.end(),
                           [](const auto& a, const auto& b) { return a.second < b.second; });
}

}  // namespace

LeftOver describe_left_over(const Model& model, const Fit& fit) {
  constexpr double kLeast = 5;  // log evidence
  const std::vector<SegmentScore> scores = segment_scores(model, fit);
  Shares by_part;
  Shares by_run;
  double total = 0;
  for (const SegmentScore& s : scores) {
    if (s.score <= 0) continue;
    by_part[s.part] += s.score;
    by_run[s.run] += s.score;
    total += s.score;
  }
  if (total < kLeast || scores.empty()) return {};
  const auto [part, part_score] = most(by_part);
  const auto [run, run_score] = most(by_run);
  const bool one_run = run_score > 0.5 * total && by_run.size() > 1;
  LeftOver left{fmt::format("{:.0f} % of what is left sits {}", 100 * part_score / total, in_words(part)), ""};
  if (part_score > 0.5 * total) left.where = in_words(part);
  if (one_run) left.where += (left.where.empty() ? "in run " : " of run ") + run;
  if (run_score > 0.5 * total)
    left.description += fmt::format(", {:.0f} % in run {} alone", 100 * run_score / total, run);
  const SegmentScore& worst = scores.front();
  left.description += fmt::format("; most in run {}, leg {} ({}), near ({:.2f}, {:.2f}) m", worst.run, worst.leg,
                                  worst.part, worst.at_x_m, worst.at_y_m);
  return left;
}

namespace {

// The wheel that passes a place of the floor, "left" or "right"; empty if both do, or neither.
std::string wheel_at(const Model& model, double x_m, double y_m) {
  const double half_m = model.recording().robot.wheelbase_m / 2;
  double nearest_m[] = {1e300, 1e300};
  for (const RecordedRun& run : model.recording().runs) {
    for (const TruthSample& s : run.truth) {
      for (const int wheel : {0, 1}) {
        const Pose2 at = s.X_WB * Pose2{0, wheel == 0 ? half_m : -half_m, 0};
        nearest_m[wheel] = std::min(nearest_m[wheel], std::hypot(at.x_m - x_m, at.y_m - y_m));
      }
    }
  }
  const bool passes[] = {nearest_m[0] < half_m / 2, nearest_m[1] < half_m / 2};
  if (passes[0] == passes[1]) return "";
  return passes[0] ? "left" : "right";
}

// Of a cable or a patch, or where the robot was when it was pushed.
void find_place(const Model& model, const Fit& fit, Diagnosis& d) {
  for (const Effect& e : fit.effects()) {
    const std::string pattern = traits_of(e.info->name).pattern;
    if (pattern == "place") {
      for (std::size_t i = 0; i < e.info->parameters.size(); ++i) {
        if (e.info->parameters[i].name == "x_m") {
          d.place_m[0] = e.values.numbers[i];
          d.has_place = true;
        }
        if (e.info->parameters[i].name == "y_m") d.place_m[1] = e.values.numbers[i];
      }
    } else if (pattern == "one_run") {
      for (std::size_t r = 0; r < model.recording().runs.size(); ++r) {
        const RecordedRun& run = model.recording().runs[r];
        if (run.id != e.values.run) continue;
        for (const Stretch& s : model.stretches(r)) {
          if (s.kind != Stretch::Kind::leg || s.leg != int(e.values.numbers[0])) continue;
          for (const TruthSample& sample : run.truth) {
            if (sample.time_s > s.start_s + e.values.numbers[1]) break;
            d.place_m[0] = sample.X_WB.x_m;
            d.place_m[1] = sample.X_WB.y_m;
          }
          d.has_place = true;
        }
      }
    }
  }
}

}  // namespace

void say_where(const Model& model, const Fit& none, const Fit& best, Diagnosis& d) {
  d.segments = segment_scores(model, none);
  if (d.segments.size() > kSegments) d.segments.resize(kSegments);
  if (!d.detected || best.hypotheses.empty()) return;
  // The effect that explains most names the stage.
  d.stage = name(find_effect(best.hypotheses.front().effect).stage);
  d.pattern = traits_of(best.hypotheses.front().effect).pattern;
  find_place(model, best, d);
  if (d.has_place) d.place_wheel = wheel_at(model, d.place_m[0], d.place_m[1]);
}

}  // namespace umbsim::gap
