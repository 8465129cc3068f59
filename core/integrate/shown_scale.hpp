#pragma once
// How many times as far beside it a motion is to be looked at for doubles to show how forces differ there.
//
// Of a force such as sqrt(1 + x) - 1 doubles tell nothing from x = 1e-30, though it grows as x does. With F
// times what is apart they tell it where r times as far away it differs r times as much,
//
//   a(y - r F e) - a(y) = r (a(y - F e) - a(y)),
//
// very nearly. F is the smallest of those tried with which most components do so: with a larger one forces
// would not be linear any more. This is a sample of two places, and no bound.

#include <span>
#include <vector>

#include "core/integrate/run.hpp"

namespace qdot {

class ShownScale {
 public:
  /// Keeps a reference to the equations, which have an expansion.
  explicit ShownScale(const RightHandSide& system) : system_(system) {}

  /// F from `least` to `most`, of what is e apart from y at t.
  [[nodiscard]] double find(double t, std::span<const double> y, std::span<const double> e, double least,
                            double most);

 private:
  [[nodiscard]] std::size_t shown(double t, std::span<const double> y, std::span<const double> e,
                                  double factor);
  [[nodiscard]] bool take_accelerations(double t, std::span<const double> y, std::span<const double> e,
                                        double factor, std::vector<double>& a);

  const RightHandSide& system_;
  std::vector<double> beside_, c_, here_, near_, far_;  ///< scratch
};

}  // namespace qdot
