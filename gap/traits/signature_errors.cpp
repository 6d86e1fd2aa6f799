#include "gap/traits/signature_errors.h"

#include <map>

namespace umbsim::gap {

// docs/gap-method.md, "Beside what is there already".
SignatureErrors signature_errors_of(const std::string& effect) {
  static const SignatureErrors rolling{{0.01, 0.01, 0.01, 0.01}, 0.01, 0.1};
  static const std::map<std::string, SignatureErrors> learned{
#include "gap/traits/signature_errors.inc"
  };
  const auto found = learned.find(effect);
  return found == learned.end() ? rolling : found->second;
}

}  // namespace umbsim::gap
