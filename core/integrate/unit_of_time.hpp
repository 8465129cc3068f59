#pragma once
// Motions by a clock whose unit u is a power of two of seconds: t/u, and y = (q, u v). But for numbers next
// to the ends of the doubles this rounds nothing.

#include <cstddef>
#include <span>
#include <vector>

#include "core/numerics/double_double.hpp"

namespace qdot {

[[nodiscard]] inline double multiplied(double x, double power_of_two) { return x * power_of_two; }
[[nodiscard]] inline DoubleDouble multiplied(const DoubleDouble& x, double power_of_two) {
  return {x.high * power_of_two, x.low * power_of_two};
}

/// In states one after the other; none of a dimension of 0.
template <class Number>
void multiply_velocities(std::span<Number> states, std::size_t dimension, double power_of_two) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (i % dimension >= dimension / 2) states[i] = multiplied(states[i], power_of_two);
  }
}

template <class Number>
[[nodiscard]] std::vector<Number> with_velocities_multiplied(std::span<const Number> states,
                                                             std::size_t dimension, double power_of_two) {
  std::vector<Number> result(states.begin(), states.end());
  multiply_velocities(std::span(result), dimension, power_of_two);
  return result;
}

}  // namespace qdot
