#pragma once
// When a number counts as right: the rules of the systems that courses are graded with, to their last < and
// <=. s is what was submitted, e what is expected.
//
//   relabs          |s - e| <= atol + rtol |e|                                      PrairieLearn
//   (numpy.allclose) sigfig          |s - e| < 0.51 10^-n, n = digits - 1 - floor(log10 |e|) PrairieLearn
//   decdig          |s - e| < 0.51 10^-digits                                       PrairieLearn
//   stack_relative  |s - e| <= tolerance |e|                                        STACK, NumRelative
//   stack_absolute  |s - e| < tolerance                                             STACK, NumAbsolute
//   webwork         |s - e| < tolerance |e|, or zeroLevelTol where |s| or |e| is
//                   below zeroLevel; with tolType absolute |s - e| < tolerance      WeBWorK, Value::Real
//
// An expected number has an error of its own. A verdict holds for every number within it; where they differ,
// there is none.

#include <optional>
#include <span>
#include <vector>

namespace qdot {

enum class Comparison { relabs, sigfig, decdig, stack_relative, stack_absolute, webwork };

struct NumberRule {
  Comparison comparison{Comparison::relabs};
  double rtol{1e-2}, atol{1e-8};                    ///< relabs
  int digits{2};                                    ///< sigfig, decdig
  double tolerance{0.05};                           ///< stack_*, webwork
  double zero_level{1e-14}, zero_tolerance{1e-12};  ///< webwork
  bool is_relative{true};                           ///< webwork
};

[[nodiscard]] bool accepts(const NumberRule& rule, double submitted, double expected);

/// A number known to lie within `error` of `value`.
struct KnownNumber {
  double value{};
  double error{};
};

enum class Agreement { no, yes, unknown };

/// How several numbers belong together.
struct Grouping {
  bool any_order{};                ///< a set: some order of them agrees
  bool any_scale{};                ///< a direction: some multiple of them, not zero, agrees
  std::optional<double> period{};  ///< angles: they agree modulo this
};

/// Whether all numbers agree with those expected. Different counts never do.
[[nodiscard]] Agreement compare(const NumberRule& rule, const Grouping& grouping,
                                std::span<const double> submitted, std::span<const KnownNumber> expected);

}  // namespace qdot
