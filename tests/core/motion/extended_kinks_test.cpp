// Motions with kinks in double-doubles, against their pieces in closed form.

#include "core/motion/extended_kinks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/numerics/double_double_function.hpp"
#include "tests/support/motions.hpp"

namespace qdot::extended_kinks_test {
namespace {

constexpr double of_double_doubles = 1e-28;
constexpr double of_mixed_form = 1e-19;  ///< where series do not end

struct Place {
  DoubleDouble x, v;
};

class KinkedMass : public testing::Test {
 protected:
  /// Of 1 kg on a line, until t = 4.
  ExtendedRun run(const std::string& force, const Values& given) {
    return run(force, given, test::instants(4, 7));
  }
  ExtendedRun run(const std::string& force, const Values& given, const std::vector<double>& rows) {
    const auto model = test::mass_under(force);
    const Dynamics dynamics(model);
    SimulationRequest request = test::request_for(*model, given, rows);
    request.method = Method::taylor;
    request.tolerances = {1e-9, 1e-12};
    motion_ = simulate(dynamics, request);
    const auto extended = extended_request(request.parameters, request.y_start, 0, request.grid);
    t_ = request.grid;
    return extended_states_along(motion_.pieces, dynamics, extended);
  }

  template <class Truth>
  void expect(const ExtendedRun& run, const Truth& truth) const {
    ASSERT_EQ(run.rows, t_.size());
    for (std::size_t i = 0; i < t_.size(); ++i) {
      const Place place = truth(DoubleDouble(t_[i]));
      EXPECT_LT(std::abs((run.states[2 * i] - place.x).high), of_double_doubles) << i;
      EXPECT_LT(std::abs((run.states[2 * i + 1] - place.v).high), of_double_doubles) << i;
    }
  }

  Simulation motion_;
  std::vector<double> t_;
};

/// V = |x|: x = 1 - t^2/2 until sqrt(2), then the same upside down, about 2 sqrt(2).
TEST_F(KinkedMass, PassesKinksWithAllDigits) {
  const auto found = run("-F*sign(x)", {{"x", 1}});
  EXPECT_EQ(motion_.pieces.size(), 2U);
  expect(found, [](const DoubleDouble& t) {
    const DoubleDouble half(0.5), quarter = sqrt(DoubleDouble(2));
    if (is_before(t, quarter)) return Place{DoubleDouble(1) - half * t * t, -t};
    const DoubleDouble s = t - quarter - quarter;
    return Place{half * s * s - DoubleDouble(1), s};
  });
}

/// V = m |x| w^2 + m w^2 x^2/2: cosines about -1 on the right, and about 1 on the left. Of this fast motion
/// the coefficients of order 30 are no doubles.
TEST_F(KinkedMass, PassesAKinkHoweverFastItIs) {
  const double w = 0x1p44, quarter = std::acos(0.5);
  const std::vector<double> rows{0, 0.5 / w, 1 / w, 1.25 / w, 1.5 / w, 2 / w};
  const auto found = run("-F*sign(x) - F*x/L", {{"x", 1}, {"F", w * w}}, rows);
  ASSERT_EQ(motion_.pieces.size(), 2U);
  ASSERT_EQ(found.rows, rows.size());
  // x = 2 cos(w t) - 1 until w t = pi/3, then 1 + A cos(w t) + B sin(w t), where -1 = A/2 + B sqrt(3)/2 and
  // -sqrt(3) = -A sqrt(3)/2 + B/2.
  const DoubleDouble root = sqrt(DoubleDouble(3)), one(1), two(2);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto [sine, cosine] = sine_cosine(DoubleDouble(rows[i] * w));
    const bool is_right = rows[i] * w < quarter;
    const DoubleDouble x = is_right ? two * cosine - one : one + cosine - root * sine;
    const DoubleDouble v = is_right ? -two * sine : -sine - root * cosine;
    EXPECT_LT(std::abs((found.states[2 * i] - x).high), of_mixed_form) << i;
    EXPECT_LT(std::abs((scaled(found.states[2 * i + 1], -44) - v).high), of_mixed_form) << i;
  }
}

/// The same kink found a little early or late, as a motion in doubles with its errors may find it.
TEST_F(KinkedMass, HasRowsBetweenAKinkAndWhereItIsKnownOnTheRightSide) {
  const double kink = std::sqrt(2.0);
  for (const double off : {1e-9, -1e-9}) {
    const auto model = test::mass_under("-F*sign(x)");
    const Dynamics dynamics(model);
    t_ = {1, kink - 0.6e-9, kink - 0.4e-9, kink, kink + 0.4e-9, kink + off, kink + 1.3e-9, 2};
    std::ranges::sort(t_);
    const SimulationRequest request = test::request_for(*model, {{"x", 1}}, t_);
    const std::vector<PieceRecord> pieces{{kink + off, kink, {1}, {0}}, {2, 2 - kink, {-1}, {}}};
    auto extended = extended_request(request.parameters, request.y_start, 0, t_);
    extended.look_for_hidden = true;
    const ExtendedRun found = extended_states_along(pieces, dynamics, extended);
    ASSERT_EQ(found.passed.size(), found.states.size());
    ASSERT_EQ(found.apart.size(), found.states.size());
    expect(found, [](const DoubleDouble& t) {
      const DoubleDouble half(0.5), quarter = sqrt(DoubleDouble(2));
      if (is_before(t, quarter)) return Place{DoubleDouble(1) - half * t * t, -t};
      const DoubleDouble s = t - quarter - quarter;
      return Place{half * s * s - DoubleDouble(1), s};
    });
  }
}

/// v = (t^2 - 3 t + 1)/4 until it is 0, at (3 - sqrt(5))/2; friction holds the mass until the drive t/2 is
/// 3/4, and then v = (t - 3/2)^2/4.
TEST_F(KinkedMass, StaysAndLeavesWithAllDigits) {
  const auto found = run("0.5*F*t/T - 0.75*F*sign(x_dot)", {{"x_dot", 0.25}});
  ASSERT_EQ(motion_.pieces.size(), 3U);
  EXPECT_EQ(motion_.pieces[1].sides, std::vector<int>{0});
  expect(found, [](const DoubleDouble& t) {
    const auto x_before = [](const DoubleDouble& s) {
      return (s * s * s / DoubleDouble(3) - DoubleDouble(1.5) * s * s + s) / DoubleDouble(4);
    };
    const DoubleDouble stop = (DoubleDouble(3) - sqrt(DoubleDouble(5))) / DoubleDouble(2);
    if (is_before(t, stop)) {
      return Place{x_before(t), (t * t - DoubleDouble(3) * t + DoubleDouble(1)) / DoubleDouble(4)};
    }
    if (is_before(t, DoubleDouble(1.5))) return Place{x_before(stop), DoubleDouble(0)};
    const DoubleDouble s = t - DoubleDouble(1.5);
    return Place{x_before(stop) + s * s * s / DoubleDouble(12), s * s / DoubleDouble(4)};
  });
}

/// Two kinks at t = sqrt(2), those of two different functions of x: there are two rows before.
TEST_F(KinkedMass, IsNotFollowedOverTwoKinksAtOnce) {
  EXPECT_EQ(run("-0.5*F*sign(x) - 0.5*F*sign(x + x^3/L^2)", {{"x", 1}}).rows, 3U);
}

}  // namespace
}  // namespace qdot::extended_kinks_test
