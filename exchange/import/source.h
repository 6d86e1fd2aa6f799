#pragma once

#include <memory>
#include <string>

#include "exchange/import/log.h"
#include "exchange/import/options.h"

namespace umbsim::exchange {

/// One file (or folder) of what people have. Both readers throw InputError: what is wrong with it, or what it cannot
/// tell, with the option that says it.
class Source {
 public:
  virtual ~Source() = default;
  /// Fills in left and right, commands where there are any, and lines of `found`.
  virtual void wheels(Log& log) const = 0;
  virtual void truth(Log& log) const = 0;
  /// Whether it says anything of a truth.
  virtual bool has_truth() const = 0;
};

/// Finds out what `file` is from what it begins with.
std::unique_ptr<Source> open_source(const std::string& file, const ImportOptions& options);

/// Both from the source, or the truth from --truth-file.
Log read_log(const ImportOptions& options);

}  // namespace umbsim::exchange
