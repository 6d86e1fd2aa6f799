#include "gap/trial/score/score.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.h"
#include "core/text/text_file.h"
#include "gap/trial/write/seal.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

// The hash that stood when the case was diagnosed must be that of these answers.
void check_process_seal(const Json& process, const std::string& hash, const fs::path& file) {
  const auto then = process.find("answers_sha256");
  if (then == process.end() || !then->is_string() || *then == hash) return;
  throw InputError(
      fmt::format("{}: was diagnosed when other answers were sealed ({})", file.string(), then->get<std::string>()));
}

Verdict verdict_of(const TrialFolder& folder, const std::string& name, const Answer& answer, const std::string& hash) {
  const fs::path place = folder.diagnoses() / name;
  std::optional<Diagnosis> diagnosis;
  if (fs::exists(place / "diagnosis.json")) diagnosis = read_diagnosis(place / "diagnosis.json");
  double wall_s = 0;
  if (fs::exists(place / "process.json")) {
    const Json process = read_json(place / "process.json");
    check_process_seal(process, hash, place / "process.json");
    wall_s = process.value("wall_s", 0.0);
    if (process.value("failed", false)) diagnosis.reset();
  }
  return judge(name, answer, diagnosis, wall_s);
}

bool has_recordings(const TrialFolder& folder, const std::vector<Verdict>& verdicts) {
  for (const Verdict& v : verdicts) {
    if (!fs::exists(folder.recordings() / v.name / "recording.yaml")) return false;
  }
  return true;
}

std::vector<std::string> umbmark_of(const TrialFolder& folder, const std::vector<Verdict>& verdicts) {
  std::vector<std::string> named(verdicts.size());
  tbb::parallel_for(std::size_t(0), verdicts.size(), [&](std::size_t i) {
    named[i] = umbmark_alone(read_recording(folder.recordings() / verdicts[i].name));
  });
  return named;
}

// Tiers with fewer runs or poses have smaller files for a reason that is no secret.
bool whole_set(const Verdict& v) { return v.answer.tier != Tier::end_points && v.answer.tier != Tier::poor_runs; }

LeakFigure metadata_of(const TrialFolder& folder, const std::vector<Verdict>& verdicts) {
  std::vector<const Verdict*> cases;
  for (const Verdict& v : verdicts) {
    if (whole_set(v)) cases.push_back(&v);
  }
  std::vector<std::vector<double>> features(cases.size());
  tbb::parallel_for(std::size_t(0), cases.size(),
                    [&](std::size_t i) { features[i] = metadata(folder.recordings() / cases[i]->name); });
  std::vector<std::string> labels;
  for (const Verdict* v : cases) labels.push_back(v->answer.tier == Tier::pairs ? "pairs" : v->truth);
  return metadata_leak(features, labels);
}

LeakFigure shuffled_of(const std::vector<Verdict>& verdicts) {
  std::vector<std::string> truths, named;
  for (const Verdict& v : verdicts) {
    if (v.answer.tier != Tier::single) continue;
    truths.push_back(v.truth);
    named.push_back(v.named);
  }
  return shuffled_labels(truths, named);
}

std::string trial_name(const TrialFolder& folder) {
  if (!fs::exists(folder.cases())) return fs::absolute(folder.root).lexically_normal().filename().string();
  return read_json(folder.cases()).value("trial", "");
}

}  // namespace

TrialScore score_trial(const TrialFolder& folder, const fs::path& answers_file) {
  TrialScore score;
  score.trial = trial_name(folder);
  score.sealed = check_seal(answers_file, read_seal(folder));
  score.answers_sha256 = sha256(read_text_file(answers_file, kMaxAnswerBytes));
  const Answers answers = read_answers(answers_file);
  bool any = false;
  for (const CaseEntry& entry : read_case_entries(folder)) {
    const auto answer = answers.find(entry.name);
    if (answer == answers.end()) {
      throw InputError(fmt::format("{}: has no answer for case '{}'", answers_file.string(), entry.name));
    }
    any = any || fs::exists(folder.diagnoses() / entry.name);
    score.verdicts.push_back(verdict_of(folder, entry.name, answer->second, score.answers_sha256));
  }
  if (!any) throw InputError(fmt::format("{}: no case has been diagnosed", folder.diagnoses().string()));
  score.figures = figures(score.verdicts);
  score.shuffled = shuffled_of(score.verdicts);
  const bool recordings = has_recordings(folder, score.verdicts);
  score.baselines =
      baselines(score.verdicts, recordings ? umbmark_of(folder, score.verdicts) : std::vector<std::string>{});
  if (recordings) score.metadata = metadata_of(folder, score.verdicts);
  return score;
}

}  // namespace umbsim
