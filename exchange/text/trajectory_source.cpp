#include "exchange/text/trajectory_source.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/error.h"
#include "exchange/import/truth/planar_track.h"

namespace umbsim::exchange {
namespace {

constexpr std::size_t kTum = 8, kKitti = 12;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

// Of a rotation matrix, by rows (Shepperd's choice of the largest component).
std::array<double, 4> quaternion(const std::array<double, 9>& R) {
  const double trace = R[0] + R[4] + R[8];
  std::array<double, 4> q{};
  if (trace > 0) {
    const double s = 2 * std::sqrt(trace + 1);
    q = {(R[7] - R[5]) / s, (R[2] - R[6]) / s, (R[3] - R[1]) / s, s / 4};
  } else if (R[0] > R[4] && R[0] > R[8]) {
    const double s = 2 * std::sqrt(1 + R[0] - R[4] - R[8]);
    q = {s / 4, (R[1] + R[3]) / s, (R[2] + R[6]) / s, (R[7] - R[5]) / s};
  } else if (R[4] > R[8]) {
    const double s = 2 * std::sqrt(1 + R[4] - R[0] - R[8]);
    q = {(R[1] + R[3]) / s, s / 4, (R[5] + R[7]) / s, (R[2] - R[6]) / s};
  } else {
    const double s = 2 * std::sqrt(1 + R[8] - R[0] - R[4]);
    q = {(R[2] + R[6]) / s, (R[5] + R[7]) / s, s / 4, (R[3] - R[1]) / s};
  }
  return q;
}

}  // namespace

bool TrajectorySource::is_tum(const Table& t) { return t.cells(0) == kTum && t.is_number(0, 0) && t.is_number(0, 7); }
bool TrajectorySource::is_kitti(const Table& t) {
  return t.cells(0) == kKitti && t.is_number(0, 0) && t.is_number(0, 11);
}

void TrajectorySource::wheels(Log&) const {
  throw InputError(
      fmt::format("{}: holds a trajectory, no wheels: give it with --truth-file, and a file of the wheels as "
                  "SOURCE",
                  table_.file()));
}

std::vector<Nanoseconds> TrajectorySource::kitti_times() const {
  std::vector<Nanoseconds> at;
  if (!options_.times_file.empty()) {
    const Table times = Table::read(options_.times_file);
    for (std::size_t row = 0; row < times.rows(); ++row) at.push_back(times.time(row, 0, kSecond_ns));
    if (at.size() != table_.rows()) {
      throw InputError(
          fmt::format("{}: {} times for {} poses of {}", times.file(), at.size(), table_.rows(), table_.file()));
    }
    return at;
  }
  if (!options_.truth_rate_hz) {
    throw InputError(
        fmt::format("{}: KITTI poses have no times: give --times FILE (one a line, in seconds), or "
                    "--truth-rate HZ",
                    table_.file()));
  }
  for (std::size_t row = 0; row < table_.rows(); ++row) {
    at.push_back(Nanoseconds(std::llround(double(row) / *options_.truth_rate_hz * 1e9)));
  }
  return at;
}

void TrajectorySource::truth(Log& log) const {
  table_.check_even();
  const bool tum = is_tum(table_);
  const std::vector<Nanoseconds> times = tum ? std::vector<Nanoseconds>{} : kitti_times();
  PlanarTrack track(table_.file(), options_.up);
  for (std::size_t row = 0; row < table_.rows(); ++row) {
    const auto n = [&](std::size_t i) { return table_.number(row, i); };
    const auto where = [&] { return fmt::format("{}: pose {}", table_.file(), row + 1); };
    if (tum) {
      track.add(table_.time(row, 0, kSecond_ns), {n(1), n(2), n(3)}, {n(4), n(5), n(6), n(7)}, where);
    } else {
      track.add(times[row], {n(3), n(7), n(11)}, quaternion({n(0), n(1), n(2), n(4), n(5), n(6), n(8), n(9), n(10)}),
                where);
    }
  }
  log.truth = track.take();
  log.found.push_back(
      fmt::format("truth: {} {} poses of {}", log.truth.at.size(), tum ? "TUM" : "KITTI", table_.file()));
}

}  // namespace umbsim::exchange
