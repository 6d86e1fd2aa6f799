#include "gap/replay/signature_cache.h"

#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "core/sha256.h"
#include "gap/replay/remembered.h"
#include "gap/replay/signature_files.h"

namespace umbsim::gap {
namespace {

namespace fs = std::filesystem;

// The values' bytes one after another, texts with their length, so that no two contents make the same bytes.
class Bytes {
 public:
  template <class T>
  Bytes& add(const T& value) requires std::is_arithmetic_v<T> {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Bytes& add(const std::string& text) {
    add(std::uint64_t(text.size()));
    bytes_ += text;
    return *this;
  }
  template <class T>
  Bytes& add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
    return *this;
  }
  std::string hash() const { return sha256(bytes_); }

 private:
  std::string bytes_;
};

std::string run_hash(const Recording& recording, const RecordedRun& run, std::size_t index) {
  Bytes b;
  const RecordedRobot& robot = recording.robot;
  b.add(robot.urdf).add(robot.wheel_radius_m).add(robot.wheelbase_m).add(robot.ticks_per_revolution);
  b.add(recording.encoder_rate_hz).add(recording.truth_kind);
  b.add(std::uint64_t(index)).add(run.id).add(run.direction).add(run.has_commands).add(run.payload_kg);
  b.add(std::uint64_t(run.bumps.size()));
  for (const RecordedBump& bump : run.bumps) b.add(bump.x_m).add(bump.y_m).add(bump.height_m);
  b.add(std::uint64_t(run.encoders.size()));
  for (const EncoderSample& s : run.encoders) {
    b.add(s.time_s).add(s.left_ticks).add(s.right_ticks).add(s.left_command_radps).add(s.right_command_radps);
  }
  // The poses say where a replay starts, and where places are met.
  for (const TruthSample& t : run.truth) b.add(t.time_s).add(t.X_WB.x_m).add(t.X_WB.y_m).add(t.X_WB.theta_rad);
  return b.hash();
}

// What is known of one recording.
class Store {
 public:
  Store(Simulator simulator, const Recording& recording, const std::string& identity, const CacheChoice& choice)
      : simulator_(std::move(simulator)) {
    if (choice.folder) files_.emplace(*choice.folder, choice.max_bytes);
    for (std::size_t r = 0; r < recording.runs.size(); ++r) {
      run_.push_back(sha256(identity + run_hash(recording, recording.runs[r], r)));
    }
  }

  template <class Work>
  std::vector<double> known(const std::string& kind, std::size_t run, const std::vector<Effect>& effects,
                            const Work& work) {
    if (!files_) return work();
    const std::string key = sha256(run_[run] + kind + '\0' + bytes_of(effects));
    if (auto numbers = files_->read(key)) return std::move(*numbers);
    std::vector<double> numbers = work();
    files_->write(key, numbers);
    return numbers;
  }

  const Simulator& simulator() const { return simulator_; }

 private:
  Simulator simulator_;
  std::optional<SignatureFiles> files_;
  std::vector<std::string> run_;  // hash of everything but effects, by run
};

std::vector<Pose2> cached_ticks(Store& store, std::size_t run, const std::vector<Effect>& effects,
                                double roughness_m_per_sqrt_m) {
  std::string kind = "ticks";
  if (roughness_m_per_sqrt_m != 0) {
    kind.append(reinterpret_cast<const char*>(&roughness_m_per_sqrt_m), sizeof roughness_m_per_sqrt_m);
  }
  const std::vector<double> numbers = store.known(kind, run, effects, [&] {
    std::vector<double> flat;
    for (const Pose2& X : store.simulator().ticks(run, effects, roughness_m_per_sqrt_m)) {
      flat.insert(flat.end(), {X.x_m, X.y_m, X.theta_rad});
    }
    return flat;
  });
  std::vector<Pose2> poses;
  poses.reserve(numbers.size() / 3);
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) poses.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return poses;
}

std::vector<std::array<double, 2>> cached_commands(Store& store, std::size_t run, const std::vector<Effect>& effects) {
  const std::vector<double> numbers = store.known("commands", run, effects, [&] {
    std::vector<double> flat;
    for (const auto& angle : store.simulator().commands(run, effects)) flat.insert(flat.end(), {angle[0], angle[1]});
    return flat;
  });
  std::vector<std::array<double, 2>> angles;
  angles.reserve(numbers.size() / 2);
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) angles.push_back({numbers[i], numbers[i + 1]});
  return angles;
}

}  // namespace

std::optional<fs::path> user_cache_folder() {
  // An empty or relative XDG_CACHE_HOME is to be ignored (XDG base directory specification 0.8).
  const char* xdg = std::getenv("XDG_CACHE_HOME");
  if (xdg && fs::path(xdg).is_absolute()) return fs::path(xdg) / "umbsim" / "signatures";
  const char* home = std::getenv("HOME");
  if (home && fs::path(home).is_absolute()) return fs::path(home) / ".cache" / "umbsim" / "signatures";
  return std::nullopt;
}

Simulator cached(Simulator simulator, const Recording& recording, const std::string& identity,
                 const CacheChoice& choice) {
  const auto command_features = simulator.command_features;
  const auto scrubs = simulator.scrubs;
  const bool commands = bool(simulator.commands);
  const double wheel_width_m = simulator.wheel_width_m;
  const double mass_kg = simulator.mass_kg;
  const auto store = std::make_shared<Store>(std::move(simulator), recording, identity, choice);
  Simulator result;
  result.ticks = [store](std::size_t run, const std::vector<Effect>& e, double roughness_m_per_sqrt_m) {
    return cached_ticks(*store, run, e, roughness_m_per_sqrt_m);
  };
  if (commands) {
    result.commands = [store](std::size_t run, const std::vector<Effect>& e) {
      return cached_commands(*store, run, e);
    };
  }
  result.command_features = command_features;
  result.scrubs = scrubs;
  result.wheel_width_m = wheel_width_m;
  result.mass_kg = mass_kg;
  return result;
}

}  // namespace umbsim::gap
