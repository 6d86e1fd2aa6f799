#include "exchange/import/wheels/joint_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "exchange/text/column_meaning.h"

namespace umbsim::exchange {
namespace {

std::string choose(const std::vector<std::string>& joints, const std::string& wanted, char side,
                   const std::string& where) {
  const char* option = side == 'l' ? "--left-joint" : "--right-joint";
  const char* word = side == 'l' ? "left" : "right";
  const std::string all = fmt::format("{}", fmt::join(joints, ", "));
  if (!wanted.empty()) {
    if (std::find(joints.begin(), joints.end(), wanted) != joints.end()) return wanted;
    throw InputError(fmt::format("{}: has no joint '{}' ({}); there are: {}", where, wanted, option, all));
  }
  std::vector<std::string> found, wheels;
  for (const std::string& joint : joints) {
    if (side_of(words_in(joint)) != side) continue;
    found.push_back(joint);
    if (joint.find("wheel") != std::string::npos) wheels.push_back(joint);
  }
  if (!wheels.empty()) found = wheels;  // beside arms and grippers
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    throw InputError(fmt::format("{}: no joint's name says that it is the {} wheel's: give {}; there are: {}", where,
                                 word, option, all));
  }
  throw InputError(fmt::format("{}: several joints may be the {} wheel's: {}; choose one with {}", where, word,
                               fmt::join(found, ", "), option));
}

}  // namespace

std::pair<std::string, std::string> choose_joints(const std::vector<std::string>& joints, const ImportOptions& options,
                                                  const std::string& where) {
  const std::string left = choose(joints, options.left_joint, 'l', where);
  const std::string right = choose(joints, options.right_joint, 'r', where);
  if (left == right) throw InputError(fmt::format("{}: joint '{}' cannot be both wheels'", where, left));
  return {left, right};
}

}  // namespace umbsim::exchange
