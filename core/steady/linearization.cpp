#include "core/steady/linearization.hpp"

#include <algorithm>
#include <cmath>

#include "core/compile/tape_evaluator.hpp"
#include "core/steady/inertia.hpp"

namespace qdot {

std::vector<Ball> evaluated(const CompiledFunction& function, const std::vector<Ball>& constants,
                            const std::vector<Ball>& x) {
  std::vector<Ball> out(function.outputs());
  TapeEvaluator<Ball>(function, constants)(x, out);
  return out;
}

Shape displaced(const Linearization& at, const Shape& v) {
  if (at.allowed.empty()) return v;
  Shape u;
  for (const std::vector<Ball>& row : at.allowed) {
    u.emplace_back();
    for (std::size_t f = 0; f < v.size(); ++f) u.back() = u.back() + ComplexBall(row[f]) * v[f];
  }
  return u;
}

double rounding_of_parameters(const Linearization& at, const Shape& shape) {
  std::vector<Ball> constants = at.constants;
  for (Ball& c : constants) c.radius += 0x1p-53 * std::abs(c.middle.high);
  const std::vector<Ball> k = evaluated(at.statics.stiffness, constants, at.place.x);
  const Shape u = displaced(at, shape);
  double moved = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    for (std::size_t j = 0; j < u.size(); ++j)
      moved += magnitude(u[i]) * k[i * at.place.x.size() + j].radius * magnitude(u[j]);
  }
  Ball inertia;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    for (std::size_t j = 0; j < shape.size(); ++j)
      inertia = inertia + shape[i].re * at.reduced.mass(i, j) * shape[j].re;
  }
  return moved / std::abs(inertia.middle.high);
}

bool is_undamped_along(const SmallMotions& motions, const Shape& v) {
  for (std::size_t i = 0; i < v.size(); ++i) {
    ComplexBall sum;
    for (std::size_t j = 0; j < v.size(); ++j) sum = sum + ComplexBall(motions.rates(i, j)) * v[j];
    if (!sum.re.contains_zero() || !sum.im.contains_zero()) return motions.undamped();
  }
  return true;
}

bool held_by_potential(const SmallMotions& motions) {
  const std::size_t n = motions.size();
  std::vector<Interval> stiffness;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const Ball& k = motions.stiffness(i, j);
      stiffness.emplace_back(k.value() - k.error(), k.value() + k.error());
    }
  }
  return inertia_of(stiffness, n).positive == n;
}

SquareMatrix<ComplexBall> dynamic_stiffness(const SmallMotions& motions, const ComplexBall& s) {
  const std::size_t n = motions.size();
  SquareMatrix<ComplexBall> result(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      result(i, j) = s * s * ComplexBall(motions.mass(i, j)) + s * ComplexBall(motions.rates(i, j)) +
                     ComplexBall(motions.stiffness(i, j));
    }
  }
  return result;
}

}  // namespace qdot
