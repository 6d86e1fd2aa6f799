// The contact solver against the laws themselves, against Bullet's Dantzig solver, and against blocks on a plane.
#include "sim/dynamics/contact_solver.h"

#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <gtest/gtest.h>

#include <iostream>
#include <limits>

#include "tests/sim/contact_laws.h"

namespace umbsim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::law_violation;
using testing::random_delassus;
using testing::random_problem;

// The solver stops at 1e-11 of the largest impulse; conditioning of the random problems and products of two such
// quantities leave a few digits less.
constexpr double kSolved = 1e-9;
// Two solvers, each exact to round-off times the condition number (up to 1e5) of the random matrices.
constexpr double kSameAsDantzig = 1e-9;
constexpr double kOfTheSolver = 1e-12;
constexpr int kProblems = 2000;

TEST(ContactLaws, CheckerSeesEveryKindOfViolation) {
  ContactProblem p;
  p.contacts = p.motors = 1;
  p.contact[0] = {0, 0.5};
  p.motor[0] = {3, 1};
  p.A = RowMatrix::Identity(4, 4);
  p.b = RowVector::Zero(4);
  p.b << -2, 4, 0, -0.5;
  RowVector x(4);
  x << 2, -1, 0, 0.5;  // presses at 2, slides with the whole 0.5 * 2 against +x, motor within its limit
  EXPECT_LT(law_violation(p, x), kOfTheSolver);
  constexpr double kWrong[][4] = {{-2, 0, 0, 0.5},   {3, -1.5, 0, 0.5}, {2, 1, 0, 0.5},  {2, -0.6, -0.8, 0.5},
                                  {2, -1.2, 0, 0.5}, {2, -1, 0, 0.2},   {2, -1, 0, 1.5}, {1, -0.5, 0, 0.5}};
  for (const auto& w : kWrong) {
    x = Eigen::Map<const Eigen::Vector4d>(w);
    EXPECT_GT(law_violation(p, x), 0.01) << x.transpose();
  }
}

TEST(ContactSolver, RandomProblemsSatisfyTheLaws) {
  RandomStream random(7, "contact problems");
  double worst = 0;
  int fallbacks = 0, newton = 0;
  for (int k = 0; k < kProblems; ++k) {
    const ContactProblem p = random_problem(random, 1.0);
    RowVector x;
    const SolveReport report = solve_contacts(p, x);
    newton += report.outcome == SolveOutcome::newton;
    if (report.outcome == SolveOutcome::fallback) {
      ++fallbacks;
      continue;
    }
    const double violation = law_violation(p, x);
    EXPECT_LT(violation, kSolved) << "problem " << k << ", " << p.contacts << " contacts, " << p.motors << " motors";
    worst = std::max(worst, violation);
  }
  std::cout << "random problems: " << kProblems << ", newton " << newton << ", fallbacks " << fallbacks
            << ", worst violation " << worst << "\n";
  RecordProperty("fallbacks", fallbacks);
  EXPECT_GT(newton, kProblems / 2) << "the problems are too easy to test anything";
  EXPECT_EQ(fallbacks, 0);
}

TEST(ContactSolver, AllClosedAndStickingNeedsOneFactorisation) {
  RandomStream random(8, "sticking");
  for (int k = 0; k < 100; ++k) {
    ContactProblem p = random_problem(random, 0.5);
    // Impulses chosen inside all cones and bounds, and b made to fit them.
    RowVector inside = RowVector::Zero(p.b.size());
    for (int i = 0; i < p.contacts; ++i) {
      const auto [n, friction] = p.contact[i];
      inside[n] = random.uniform(0.1, 2);
      if (friction > 0) inside[n + 1] = 0.9 * friction * inside[n];
    }
    for (int i = 0; i < p.motors; ++i) inside[p.motor[i].row] = 0.9 * p.motor[i].limit;
    p.b = -p.A * inside;
    RowVector x;
    EXPECT_EQ(solve_contacts(p, x).outcome, SolveOutcome::stick);
    EXPECT_LT((x - inside).norm(), 1e-8 * inside.norm());  // condition number up to 1e6
  }
}

// Weak friction makes the solution unique: where the solver starts must not matter.
TEST(ContactSolver, WarmStartGivesTheSameAnswer) {
  RandomStream random(9, "warm start");
  double worst = 0;
  for (int k = 0; k < 500; ++k) {
    const ContactProblem p = random_problem(random, 0.1);
    RowVector cold, again, odd = RowVector::Zero(p.b.size());
    const SolveReport first = solve_contacts(p, cold);
    again = cold;
    const SolveReport second = solve_contacts(p, again);
    for (int i = 0; i < odd.size(); ++i) odd[i] = random.normal();
    solve_contacts(p, odd);
    EXPECT_LE(second.iterations, first.iterations);
    for (const RowVector& x : {again, odd}) {
      EXPECT_LT((x - cold).norm(), kSolved * (1 + cold.norm())) << "problem " << k;
      worst = std::max(worst, (x - cold).norm() / (1 + cold.norm()));
    }
  }
  std::cout << "warm starts: largest relative difference " << worst << "\n";
}

// Dantzig's method as Bullet has it: A x = b + w with lo <= x <= hi.
RowVector dantzig(const ContactProblem& p) {
  const int n = int(p.b.size());
  btMatrixXu A(n, n);
  btVectorXu b(n), x(n), lo(n), hi(n);
  btAlignedObjectArray<int> no_dependency;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) A.setElem(i, j, p.A(i, j));
    b[i] = -p.b[i];
    lo[i] = 0;
    hi[i] = std::numeric_limits<double>::infinity();
    no_dependency.push_back(-1);
  }
  for (int i = 0; i < p.motors; ++i) {
    lo[p.motor[i].row] = p.motor[i].lower_share * p.motor[i].limit;
    hi[p.motor[i].row] = p.motor[i].limit;
  }
  x.setZero();
  EXPECT_TRUE(btDantzigSolver().solveMLCP(A, b, x, lo, hi, no_dependency, 100, false));
  RowVector result(n);
  for (int i = 0; i < n; ++i) result[i] = x[i];
  return result;
}

TEST(ContactSolver, AgreesWithDantzigWithoutFriction) {
  RandomStream random(10, "dantzig");
  double worst = 0;
  int open = 0, saturated = 0;
  for (int k = 0; k < 500; ++k) {
    ContactProblem p;
    p.contacts = 1 + int(random.uniform(0, 8));
    for (int i = 0; i < p.contacts; ++i) p.contact[i] = {i, 0};
    p.motors = 2;
    for (int i = 0; i < 2; ++i) p.motor[i] = {p.contacts + i, random.uniform(0.05, 2), i == 0 ? -1.0 : 0.0};
    const int rows = p.contacts + 2;
    p.A = random_delassus(random, rows, rows + 1, 1e-4);
    p.b.resize(rows);
    for (int i = 0; i < rows; ++i) p.b[i] = random.normal(-0.5);
    RowVector x;
    EXPECT_NE(solve_contacts(p, x).outcome, SolveOutcome::fallback);
    const RowVector expected = dantzig(p);
    worst = std::max(worst, (x - expected).norm() / (1 + expected.norm()));
    EXPECT_LT((x - expected).norm(), kSameAsDantzig * (1 + expected.norm())) << "problem " << k;
    for (int i = 0; i < p.contacts; ++i) open += expected[i] == 0;
    for (int i = 0; i < 2; ++i) saturated += std::abs(expected[rows - 1 - i]) == p.motor[1 - i].limit;
  }
  std::cout << "against Dantzig: largest relative difference " << worst << ", open contacts " << open
            << ", saturated motors " << saturated << "\n";
  EXPECT_GT(open, 100);
  EXPECT_GT(saturated, 100);
}

// A block of mass m on a plane: one contact, A = 1/m.
struct Block {
  double mass_kg = 3;
  double friction = 0.4;
  double step_s = 0.01;

  Vector3d step(const Vector3d& v, const Vector2d& push_n = {0, 0}) const {
    ContactProblem p;
    p.contacts = 1;
    p.contact[0] = {0, friction};
    p.A = RowMatrix::Identity(3, 3) / mass_kg;
    p.b.resize(3);
    const double g = 9.81;
    p.b << v.z() - g * step_s, v.x() + push_n.x() / mass_kg * step_s, v.y() + push_n.y() / mass_kg * step_s;
    RowVector x;
    EXPECT_NE(solve_contacts(p, x).outcome, SolveOutcome::fallback);
    EXPECT_NEAR(x[0], mass_kg * g * step_s, kOfTheSolver);
    const RowVector w = p.A * x + p.b;
    return {w[1], w[2], w[0]};
  }
};

// v' = v - mu g h v / |v| in every direction: the cone, not a pyramid. A pyramid would brake up to 41 % too much.
TEST(ContactSolver, SlidingBlockBrakesAlikeInEveryDirection) {
  const Block block;
  for (int degree = 0; degree < 360; degree += 7) {
    const Vector2d d(std::cos(degree * M_PI / 180), std::sin(degree * M_PI / 180));
    const Vector3d v = block.step({0.5 * d.x(), 0.5 * d.y(), 0});
    const Vector2d expected = (0.5 - 0.4 * 9.81 * block.step_s) * d;
    EXPECT_LT((v.head<2>() - expected).norm(), kSolved) << degree << " degrees";
  }
}

TEST(ContactSolver, BlockSticksUpToTheConeAndNoFurther) {
  const Block block;
  const double limit_n = block.friction * block.mass_kg * 9.81;
  for (int degree = 0; degree < 360; degree += 15) {
    const Vector2d d(std::cos(degree * M_PI / 180), std::sin(degree * M_PI / 180));
    EXPECT_LT(block.step({0, 0, 0}, 0.999 * limit_n * d).norm(), kSolved);
    const Vector3d v = block.step({0, 0, 0}, 1.01 * limit_n * d);
    EXPECT_LT((v.head<2>() - 0.01 * limit_n / block.mass_kg * block.step_s * d).norm(), kSolved);
  }
}

// Both wheels' lateral rows lie on one line: A is singular but for the compliance. Lateral push of `push` on a body
// of mass m with loads N1, N2.
RowVector two_wheels(double push, double N1, double N2, SolveReport& report) {
  constexpr double kCompliance = 1e-7, kMass = 40, kFriction = 0.9;
  ContactProblem p;
  p.contacts = 2;
  p.contact[0] = {0, kFriction};
  p.contact[1] = {3, kFriction};
  p.A = RowMatrix::Zero(6, 6);
  p.A.diagonal() << 1, 1, kCompliance, 1, 1, kCompliance;
  for (int i : {2, 5}) {
    for (int j : {2, 5}) p.A(i, j) += 1 / kMass;
  }
  p.b.resize(6);
  p.b << -N1, 0, -push / kMass, -N2, 0, -push / kMass;
  RowVector x;
  report = solve_contacts(p, x);
  EXPECT_LT(law_violation(p, x), kSolved);
  return x;
}

TEST(ContactSolver, SingularLateralRowsShareTheForce) {
  // Stiffness 1/m against compliance: 1e-7 * 40 / 2 of the force is missing at the most.
  constexpr double kComplianceError = 1e-5;
  SolveReport report;
  RowVector x = two_wheels(160, 300, 100, report);
  EXPECT_EQ(report.outcome, SolveOutcome::stick);
  EXPECT_NEAR(x[2], 80, 160 * kComplianceError);
  EXPECT_NEAR(x[5], 80, 160 * kComplianceError);
  // An equal share of 125 is more than 0.9 * 100: the light wheel gives what it can, the heavy one the rest.
  x = two_wheels(250, 300, 100, report);
  EXPECT_EQ(report.outcome, SolveOutcome::newton);
  EXPECT_NEAR(x[2], 160, 250 * kComplianceError);
  EXPECT_NEAR(x[5], 90, 1e-6);
  // 400 is more than both can hold: both slide.
  x = two_wheels(400, 300, 100, report);
  EXPECT_NEAR(x[2], 270, 1e-6);
  EXPECT_NEAR(x[5], 90, 1e-6);
}

TEST(ContactSolver, NoRowsIsNoProblem) {
  ContactProblem p;
  p.b.resize(0);
  p.A.resize(0, 0);
  RowVector x;
  EXPECT_EQ(solve_contacts(p, x).outcome, SolveOutcome::stick);
}

}  // namespace
}  // namespace umbsim
