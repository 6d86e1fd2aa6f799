#include "gap/hypotheses/felt_through.h"

#include <algorithm>
#include <boost/math/special_functions/lambert_w.hpp>
#include <cmath>
#include <utility>

#include "gap/hypotheses/parametrisations.h"

namespace umbsim::gap {

Effect creeping(double along, double across) {
  Effect creep = neutral_effect(find_effect("tyre_creep"));
  creep.values.numbers[index_of(*creep.info, "along")] = along;
  creep.values.numbers[index_of(*creep.info, "across")] = across;
  return creep;
}

GivesWay motors(double inertia_kgm2) {
  const EffectInfo& info = find_effect("motor_response");
  const std::size_t droop = index_of(info, "droop_radps_per_nm");
  const double typical = kGivesWay_s / inertia_kgm2, most = info.parameters[droop].bounds.max;
  return {"motors that give way", {"log motor_response.droop", 0, 0.2, 1, -1.5, 4}, [=, &info](double times) {
            Effect response = neutral_effect(info);
            response.values.numbers[droop] = std::min(most, typical * times);
            return response;
          }};
}

GivesWay tyres() {
  constexpr double kTypical = 0.01;  // slip per traction ratio, of hard tyres; no pull is felt on harder ones
  return {"tyres that creep", {"log tyre_creep", 0, 0.2, 1.5, 0, 3.9}, [](double times) {
            return creeping(kTypical * times, kTypical * times);
          }};
}

GivesWay soft_tyres() {
  constexpr double kTypical_m_per_n = 5e-7;
  return {"tyres that give", {"log tyre_compliance", 0, 0.2, 1.5, -2, 4}, [](double times) {
            Effect compliance = neutral_effect(find_effect("tyre_compliance"));
            compliance.values.numbers[index_of(*compliance.info, "metres_per_newton")] = kTypical_m_per_n * times;
            return compliance;
          }};
}

namespace {

// The likeliest logarithm t of how many times as much as is typical gives way, where the product is `standard_pulls`
// times as large as a pull's standard deviation: (standard_pulls exp(-t))^2 + (t / sd)^2 is least, 2 t exp(2 t) there
// 2 (standard_pulls sd)^2.
double likeliest_log_times(double standard_pulls, double sd) {
  return boost::math::lambert_w0(2 * std::pow(standard_pulls * sd, 2)) / 2;
}

}  // namespace

Hypothesis felt_through(const GivesWay& gives_way, Hypothesis pull) {
  const Eigen::Index own = Eigen::Index(pull.parameters.size());
  const FreeParameter log_times = gives_way.log_times;
  const Eigen::VectorXd pull_sd = prior_sd_of({pull});
  pull.likelier = [=](Eigen::VectorXd& p) {
    const double t = likeliest_log_times(p.head(own).cwiseQuotient(pull_sd).norm(), log_times.prior_sd);
    p[own] = std::clamp(t, log_times.min, log_times.max);
  };
  pull.variant += ", " + gives_way.what;
  pull.parameters.push_back(gives_way.log_times);
  pull.of_others = 1;
  pull.values = [values = pull.values, own](const Eigen::VectorXd& p) {
    return values(p.head(own) * std::exp(-p[own]));
  };
  pull.with = [effect = gives_way.effect, own](const Eigen::VectorXd& p) {
    return std::vector<Effect>{effect(std::exp(p[own]))};
  };
  return pull;
}

Hypothesis on_soft_tyres(Hypothesis hypothesis) {
  hypothesis.variant += ", soft tyres";
  const Eigen::Index own = Eigen::Index(hypothesis.parameters.size());
  // Shares of slip per traction ratio; their logarithms, for scrub depends on their order of magnitude.
  constexpr double kAlong = 0.1;
  constexpr double kAcross = 0.01;
  hypothesis.parameters.push_back({"log tyre_creep.along", 0, 0.2, 1.5, -5, 1.6});
  hypothesis.parameters.push_back({"log tyre_creep.across", 0, 0.2, 1.5, -5, 3.9});
  hypothesis.of_others = 2;
  hypothesis.from_zero = false;
  hypothesis.parameters.front().start = hypothesis.parameters.front().step * 2;
  hypothesis.with = [own](const Eigen::VectorXd& p) {
    return std::vector<Effect>{creeping(kAlong * std::exp(p[own]), kAcross * std::exp(p[own + 1]))};
  };
  return hypothesis;
}

}  // namespace umbsim::gap
