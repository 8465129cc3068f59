// The bound of what rounding does to a force, against the force in twice the digits at many places of a step.

#include "core/compile/taylor/rounding.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/compile/tape_evaluator.hpp"
#include "core/compile/taylor/expansion.hpp"
#include "core/numerics/ball.hpp"
#include "tests/core/compile/taylor/formula.hpp"

namespace qdot {
namespace {

/// A step of q'' = f(t, q, q') from t_0 and q_0, at rest.
class RoundedStep {
 public:
  RoundedStep(const std::string& formula, double t_0, double q_0, double h)
      : tape_(test::function_of(formula)), workspace_(tape_.bind({})), exact_(tape_, {}), t_0_(t_0), h_(h) {
    constexpr unsigned order = 22;
    c_.resize(2 * (order + 1));
    std::vector<double> defect(2);
    TaylorExpansion expansion(tape_, {});
    EXPECT_EQ(expansion.expand(t_0, std::vector{q_0, 0.0}, order, c_), Evaluation::ok);
    (void)expansion.bound_defect(h, {}, defect);
    expansion.bound_rounding({&bound_, 1});
  }

  [[nodiscard]] double bound() const { return bound_; }

  /// The largest error of f in doubles over the step, and the largest |f|.
  [[nodiscard]] std::pair<double, double> error_and_size() {
    double error = 0, size = 0;
    for (int i = 0; i <= 400; ++i) {
      const double s = h_ * i / 400, t = t_0_ + s;
      const std::vector<double> y{value(0, s), value(1, s)};
      double f{};
      EXPECT_EQ(tape_.evaluate(t, y, workspace_, {&f, 1}), Evaluation::ok);
      Ball right;
      exact_.set_time(Ball(t));
      exact_(std::vector<Ball>(y.begin(), y.end()), {&right, 1});
      error = std::max(error, std::abs((right - Ball(f)).value()));
      size = std::max(size, std::abs(f));
    }
    return {error, size};
  }

 private:
  [[nodiscard]] double value(std::size_t i, double s) const {
    const std::size_t width = c_.size() / 2;
    double sum = 0;
    for (std::size_t k = width; k-- > 0;) sum = sum * s + c_[i * width + k];
    return sum;
  }

  CompiledFunction tape_;
  Workspace workspace_;
  TapeEvaluator<Ball> exact_;
  double t_0_, h_;
  std::vector<double> c_;
  double bound_{};
};

struct Cancelling {
  const char* formula;
  double t, q, h;
};
constexpr Cancelling cancelling[]{
    {"exp(-(t^2 - 7.158*t + 12.809241)/0.00841)", 3.5, 0.1, 0.05},
    {"1/(1 + (t^2 - 7.158*t + 12.809241)/1e-8)", 3.579, 0.1, 1e-5},
    {"(cosh(1e-7*q) - 1)*1e14", 0, 1, 0.3},
    {"(1 - cos(1e-6*q))*1e12/q", 0, 1, 0.3},
    {"(sqrt(1 + (1e-6*q)^2) - 1)*1e12", 0, 1, 0.3},
    {"(exp(1e-9*q) - 1)*1e9", 0, 1, 0.3},
    {"log(1 + 1e-9*q)*1e9", 0, 1, 0.3},
    {"1e9*(sin(q + 1e-9) - sin(q))", 0, 0.7, 0.3},
    {"1e8*(1/(q + 2) - 1/(q + 2.00000001))", 0, 0.7, 0.3},
    {"1e10*(q^3 - (q - 1e-10)^3)", 0, 0.7, 0.3},
    {"sin(1e5 + q + t)", 0, 0.7, 0.3},
    {"tan(1.57079632 + 1e-9*q)/1e8", 0, 0.7, 0.3},
    {"(tanh(18 + q) - 1)*1e16", 0, 0.1, 0.2},
    {"1e9*(atan(q + 1e-9) - atan(q))", 0, 0.7, 0.3},
    {"1e6*(asin(q) - asin(q - 1e-6))", 0, 0.3, 0.1},
    {"1e9*(sinh(q + 1e-9) - sinh(q))", 0, 0.3, 0.1},
    {"1e6*((1 + q^2)^(1/3) - (1 + q^2 - 1e-6)^(1/3))", 0, 0.3, 0.1},
};

TEST(Rounding, OfAForceThatCancelsIsNeverAboveItsBound) {
  for (const auto& [formula, t, q, h] : cancelling) {
    RoundedStep step(formula, t, q, h);
    const auto [error, size] = step.error_and_size();
    EXPECT_LE(error, step.bound() + 0x1p-47 * size) << formula;
    EXPECT_LT(step.bound(), 500 * error) << formula;
  }
}

TEST(Rounding, OfAPulseIsSeenThatLiesBetweenTheEndsOfAStep) {
  RoundedStep step("1e3*exp(-(t^2 - 7.158*t + 12.809241)/0.000841)", 3.5, 0, 0.15);
  EXPECT_GT(step.bound(), 100 * 0x1p-53 * 1e3);
}

TEST(Rounding, OfAnOrdinaryForceIsOfItsLastDigits) {
  for (const char* formula :
       {"-sin(q)", "-4*q", "q/(1 + q^2)^(3/2)", "cos(3*t)*q - 0.1*q_dot", "exp(-q^2)"}) {
    EXPECT_EQ(RoundedStep(formula, 0.3, 0.7, 0.2).bound(), 0) << formula;
  }
}

TEST(Rounding, OfWhatDividesByAnOverflowIsNone) {
  for (const char* formula :
       {"1/cosh(1e3*(t - 5))^2", "exp(-cosh(1e3*(t - 5)))", "1/(1 + exp(1e3*(5 - t)))^2",
        "1/(2 + sinh(1e3*(t - 5))^2)", "exp(-sqrt(1 + (1e6*(t - 5))^2))"}) {
    EXPECT_LT(RoundedStep(formula, 4.4, 0, 0.1).bound(), 1e-100) << formula;
    EXPECT_LT(RoundedStep(formula, 4.58, 0, 0.127).bound(), 1e-100) << formula;  // the terms alone overflow
  }
}

TEST(Rounding, OfADifferenceThatHasBecomeZeroIsThatOfItsTerms) {
  RoundedStep step("-(cosh(1e-20*q) - 1)*2e40/q", 0, 1, 0.5);
  EXPECT_GT(step.bound(), 1e23);
  EXPECT_LT(step.bound(), 1e26);
}

}  // namespace
}  // namespace qdot
