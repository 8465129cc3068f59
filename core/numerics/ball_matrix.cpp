#include "core/numerics/ball_matrix.hpp"

#include <cmath>

namespace qdot {
namespace {

/// The squares of larger numbers, or of their inverses, have no place among doubles.
constexpr int largest_squared = 300;

}  // namespace

ComplexBall operator/(const ComplexBall& a, const ComplexBall& b) {
  const int exponent = size_of(magnitude(b.re) > magnitude(b.im) ? b.re : b.im);
  if (std::abs(exponent) > largest_squared) {
    const auto comparable = [=](const ComplexBall& c) {
      return ComplexBall(scaled(c.re, -exponent), scaled(c.im, -exponent));
    };
    return comparable(a) / comparable(b);
  }
  const Ball size = square(b.re) + square(b.im);
  return {(a.re * b.re + a.im * b.im) / size, (a.im * b.re - a.re * b.im) / size};
}

}  // namespace qdot
