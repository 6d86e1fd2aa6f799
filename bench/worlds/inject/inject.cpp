#include "bench/worlds/inject/inject.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "core/error.h"
#include "core/random.h"
#include "core/text/text_file.h"
#include "gap/trial/draw/severity.h"
#include "gap/trial/write/even_tables.h"
#include "gap/trial/write/seal.h"

namespace umbsim::worlds {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxUrdfBytes = 16 * 1024 * 1024;

std::string random_name(std::uint64_t seed, std::uint64_t index) {
  return fmt::format("{:012x}", RandomStream(seed, "inject name", index).bits() & 0xffffffffffff);
}

// The mean of the runs of each direction at every moment, for each run.
std::optional<SignalTrack> means(const Recording& r, const SignalTrack& track) {
  SignalTrack mean = track;
  bool any = false;
  for (std::size_t i = 0; i < track.size(); ++i) {
    double alike = 0;
    for (auto& moment : mean[i]) moment = {};
    for (std::size_t j = 0; j < track.size(); ++j) {
      if (r.runs[i].direction != r.runs[j].direction) continue;
      ++alike;
      for (std::size_t k = 0; k < mean[i].size(); ++k)
        for (std::size_t c = 0; c < 3; ++c) mean[i][k][c] += track[j][k][c];
    }
    any = any || alike > 1;
    for (auto& moment : mean[i])
      for (double& v : moment) v /= alike;
  }
  if (!any) return std::nullopt;
  return mean;
}

void write_recording_of(const Recording& recording, const fs::path& source, const fs::path& into) {
  Recording r = recording;
  r.title = "recording";
  r.source.clear();
  write_recording(r, into);
  write_even_tables(r, into);
  const fs::path urdf = source / r.robot.urdf;  // else it is in robots/
  if (!r.robot.urdf.empty() && fs::exists(urdf))
    write_text_file(into / r.robot.urdf, read_text_file(urdf, kMaxUrdfBytes));
  normalise_times(into);
}

struct Spoiled {
  Recording recording;
  Injection injection;
  std::optional<double> severity;
};

std::optional<Spoiled> draw(const Recording& real, std::size_t which, std::uint64_t seed, std::uint64_t index) {
  const InjectionKind& kind = injections()[which % injections().size()];
  RandomStream random(seed, "inject size", index);
  const double size = kind.min * std::pow(kind.max / kind.min, random.uniform());
  Spoiled s;
  try {
    s.recording = spoiled(real, kind, size, RandomStream(seed, "inject", index).bits() >> 1, s.injection);
  } catch (const InputError&) {
    return std::nullopt;
  }
  s.severity = severity_of(real, s.recording);
  return s;
}

Json answer_of(const Spoiled& s, const std::string& source) {
  Json json{{"tier", "single"},
            {"effects", {{s.injection.effect, s.injection.parameters}}},
            {"excluded", Json::array()},
            {"severities", Json::object()}};
  if (s.severity) json["severities"][s.injection.effect] = {{"severity", *s.severity}};
  json["undetectable_expected"] = s.severity && *s.severity < kLeastSeverity;
  json["world"] = {{"engine", "real"}, {"driver", "real"}, {"tracker", "real"},           {"runs", source},
                   {"robot", source},  {"kind", "single"}, {"injected", s.injection.name}};
  return json;
}

}  // namespace

std::optional<double> severity_of(const Recording& real, const Recording& changed) {
  const SignalTrack was = signal_track(real, Signal::odometry), is = signal_track(changed, Signal::odometry);
  const std::optional<SignalTrack> mean = means(real, was);
  if (!mean) return std::nullopt;
  return severity(signal_size(is, &was), signal_size(was, &*mean));
}

InjectResult inject(const std::vector<std::string>& recordings, const TrialFolder& folder, int each,
                    std::uint64_t seed) {
  if (fs::exists(folder.root) && !fs::is_empty(folder.root))
    throw InputError(fmt::format("{}: is not empty; give another folder with --out", folder.root.string()));
  InjectResult result;
  Json answers{{"format", "umbsim-trial-answers/1"}, {"trial", "injected"}, {"seed", seed}, {"cases", Json::object()}};
  std::map<std::string, Json> by_name;
  std::vector<CaseEntry> entries, unspoiled;
  const TrialFolder as_they_are(folder.root / "unspoiled");
  std::uint64_t index = 0;
  for (const std::string& path : recordings) {
    const fs::path source = fs::path(path).lexically_normal();
    const std::string name = (source.has_filename() ? source : source.parent_path()).filename().string();
    const Recording real = read_recording(source);
    write_whole(as_they_are.recordings() / name, [&](const fs::path& into) { write_recording_of(real, source, into); });
    unspoiled.push_back({name, {}});
    for (int k = 0; k < each; ++k, ++index) {
      const std::optional<Spoiled> s = draw(real, std::size_t(index), seed, index);
      if (!s) {
        ++result.refused;
        continue;
      }
      const std::string random = random_name(seed, index);
      write_whole(folder.recordings() / random,
                  [&](const fs::path& into) { write_recording_of(s->recording, source, into); });
      by_name[random] = answer_of(*s, name);
      entries.push_back({random, {}});
    }
  }
  for (const auto& [name, answer] : by_name) answers["cases"][name] = answer;
  write_file_whole(folder.cases(), case_entries_text("injected", entries));
  write_file_whole(as_they_are.cases(), case_entries_text("unspoiled", unspoiled));
  result.recordings = entries.size();
  result.unspoiled = unspoiled.size();
  result.seal = seal_answers(folder, answers.dump(1) + "\n");
  return result;
}

}  // namespace umbsim::worlds
