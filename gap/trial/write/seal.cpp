#include "gap/trial/write/seal.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text/text_file.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHashDigits = 64;

}  // namespace

std::optional<std::string> read_seal(const TrialFolder& folder) {
  if (!fs::exists(folder.seal())) return std::nullopt;
  const std::string text = read_text_file(folder.seal(), 4096);
  const std::string hash = text.substr(0, kHashDigits);
  if (hash.size() != kHashDigits || hash.find_first_not_of("0123456789abcdef") != std::string::npos) {
    throw InputError(fmt::format("{}: must begin with a SHA-256 of 64 hexadecimal digits", folder.seal().string()));
  }
  return hash;
}

std::string seal_answers(const TrialFolder& folder, const std::string& answers) {
  const std::string hash = sha256(answers);
  write_file_whole(folder.answers(), answers);
  write_file_whole(folder.seal(), hash + "  " + folder.answers().filename().string() + "\n");
  return hash;
}

bool check_seal(const fs::path& answers, const std::optional<std::string>& sealed_hash) {
  const std::string hash = sha256(read_text_file(answers, kMaxAnswerBytes));
  if (!sealed_hash) return false;
  if (hash != *sealed_hash) {
    throw InputError(
        fmt::format("{}: its SHA-256 is {}, but {} was sealed before the diagnoses: the answers were "
                    "changed, or belong to another trial",
                    answers.string(), hash, *sealed_hash));
  }
  return true;
}

}  // namespace umbsim
