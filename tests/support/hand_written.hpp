#pragma once
// The systems' mechanics as written on paper: what the derivation from positions must come to.
//
// The practice problems follow the sheet's own solutions and, where it has none or prints a mistake ((61) and
// (62): I12 = -3/2 m l^2 and 53/3), the derivation of each problem from its positions, done independently and
// checked with SymPy. The textbook systems follow the sources that their scenes name.

#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "core/mechanics/model.hpp"

namespace qdot::test {

/// A sum with the size of its terms, by which its round-off is measured.
struct Terms {
  double value{};
  double size{};

  Terms() = default;
  Terms(std::initializer_list<double> terms) {
    for (const double term : terms) {
      value += term;
      size += std::abs(term);
    }
  }
};

inline Terms operator+(Terms a, const Terms& b) {
  a.value += b.value;
  a.size += b.size;
  return a;
}
inline Terms operator*(double factor, Terms a) {
  a.value *= factor;
  a.size *= std::abs(factor);
  return a;
}

/// What the formulas say at one state.
struct Mechanics {
  std::optional<Terms> kinetic, potential;  ///< none where the scene gives only L
  std::vector<Terms> equations;             ///< d/dt dL/dq' - dL/dq - Q, with q'' from the state
  std::vector<Terms> accelerations;         ///< the same equations solved for q''
  std::vector<Terms> momenta;               ///< dL/dq'
  Terms jacobi;                             ///< sum p q' - L
  std::optional<Terms> reaction;            ///< tension or normal force, with q'' from the state
  std::optional<double> determinant;        ///< det d2L/dq'dq', for two degrees of freedom and more
};

/// Throws std::out_of_range for a system that is not in scenes.hpp.
[[nodiscard]] Mechanics mechanics_of(const std::string& system, const Values& state);

}  // namespace qdot::test
