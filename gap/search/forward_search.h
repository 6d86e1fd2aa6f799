#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gap/search/addition.h"
#include "gap/search/search.h"

namespace umbsim::gap {

/// Forward from single effects, with a look back at what the first one should have been (exchange.cpp).
class ForwardSearch {
 public:
  ForwardSearch(const Model& model, const Screen& screen, const Thresholds& thresholds,
                const ProgressCallback& progress)
      : model_(model),
        screen_(screen),
        thresholds_(thresholds),
        progress_(progress),
        none_(model.none()),
        fits_{none_} {}

  Found run();

 private:
  /// From which share of a stage on, and how much of it.
  struct Part {
    double from;
    double size;
  };

  void begin(const std::string& stage);
  void done(double share) const { progress_(stage_, share); }
  std::optional<Fit> tried(const Fit& base, const Screen::Candidate& c, double least);
  void keep_doubtful(const Fit& base, const Needed& needed, Fit fit);
  bool large_enough(const Fit& base, const Fit& fit) const;
  bool mends_the_place(const Fit& base, const Fit& fit);
  void fit_singles();
  void fit_promising(std::vector<Screen::Candidate>& singles, bool local, Part part);
  void fit_dimensions();
  bool idle(Screen::Candidate& c, double most) const;
  void add_to(const Fit& base, std::size_t most, Part part, std::vector<Fit>& paying);
  void swap(std::vector<Fit>& frontier);
  void swap_one(const Fit& whole, std::vector<Fit>& paying);
  void exchange(const Fit& whole, std::size_t out, std::vector<Fit>& paying);

  const Model& model_;
  const Screen& screen_;
  const Thresholds& thresholds_;
  const ProgressCallback& progress_;
  std::string stage_;
  const Fit none_;
  std::vector<Fit> fits_;
  std::vector<Fit> doubtful_;
  std::map<std::string, double> p_values_;
};

}  // namespace umbsim::gap
