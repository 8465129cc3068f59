#include "core/steady/linearization.hpp"

#include <algorithm>
#include <cmath>

#include "core/compile/tape_evaluator.hpp"
#include "core/steady/inertia.hpp"

namespace qdot {
namespace {

/// The coordinate that v_f is, by its row of the unit matrix.
std::size_t place_of_free(const BallMatrix& allowed, std::size_t f) {
  const auto is_it = [&](const std::vector<Ball>& row) {
    for (std::size_t g = 0; g < row.size(); ++g) {
      if (!(row[g] - Ball(f == g ? 1 : 0)).is_zero()) return false;
    }
    return true;
  };
  return static_cast<std::size_t>(std::ranges::find_if(allowed, is_it) - allowed.begin());
}

/// w and w.M v, with w.K v = lambda w.M v for every w: v itself, or where v.M v may be zero, as beside a
/// kinetic energy of two signs, the displacement with most of M v.
struct Weights {
  Shape w;
  Ball inertia;
};
Weights weights(const Linearization& at, const Shape& v) {
  const std::size_t n = v.size();
  std::vector<Ball> momenta(n);
  Weights result{v, {}};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) momenta[i] = momenta[i] + at.reduced.mass(i, j) * v[j].re;
    result.inertia = result.inertia + v[i].re * momenta[i];
  }
  if (!result.inertia.contains_zero()) return result;
  const auto largest =
      std::ranges::max_element(momenta, {}, [](const Ball& p) { return std::abs(p.value()); });
  result.w.assign(n, {});
  result.w[static_cast<std::size_t>(largest - momenta.begin())] = Ball(1);
  result.inertia = *largest;
  return result;
}

Inertia signs_of(const SquareMatrix<Ball>& a) {
  std::vector<Interval> entries;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j) entries.push_back(a(i, j).interval());
  }
  return inertia_of(entries, a.size());
}

}  // namespace

std::vector<Ball> evaluated(const CompiledFunction& function, const std::vector<Ball>& constants,
                            const std::vector<Ball>& x) {
  std::vector<Ball> out(function.outputs());
  TapeEvaluator<Ball>(function, constants)(x, out);
  return out;
}

std::vector<Shape> directions_of_family(const Linearization& at) {
  std::vector<Shape> result;
  for (const std::vector<Ball>& direction : at.place.family) {
    result.emplace_back(direction.begin(), direction.end());
    if (at.allowed.empty()) continue;
    Shape v;
    for (std::size_t f = 0; f < at.allowed[0].size(); ++f)
      v.push_back(result.back()[place_of_free(at.allowed, f)]);
    result.back() = std::move(v);
  }
  return result;
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
  const auto [w, inertia] = weights(at, shape);
  const Shape u = displaced(at, shape), along = displaced(at, w);
  double moved = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    for (std::size_t j = 0; j < u.size(); ++j)
      moved += magnitude(along[i]) * k[i * at.place.x.size() + j].radius * magnitude(u[j]);
  }
  return moved / std::abs(inertia.middle.high);
}

std::size_t undamped_among(const SmallMotions& motions, const std::vector<Shape>& shapes) {
  if (motions.undamped()) return shapes.size();
  std::vector<Shape> damped;
  for (const Shape& v : shapes) {
    damped.emplace_back();
    for (std::size_t i = 0; i < v.size(); ++i) {
      ComplexBall sum;
      for (std::size_t j = 0; j < v.size(); ++j) sum = sum + ComplexBall(motions.rates(i, j)) * v[j];
      damped.back().push_back(sum);
    }
  }
  return static_cast<std::size_t>(std::ranges::count_if(echelon_form(std::move(damped)), [](const Shape& v) {
    return std::ranges::all_of(v, [](const ComplexBall& entry) { return magnitude(middle_of(entry)) == 0; });
  }));
}

bool has_one_sign(const SquareMatrix<Ball>& mass) {
  const Inertia signs = signs_of(mass);
  return signs.positive == mass.size() || signs.negative == mass.size();
}

bool held_by_potential(const SmallMotions& motions) {
  const Inertia mass = signs_of(motions.mass), stiffness = signs_of(motions.stiffness);
  const std::size_t n = motions.size();
  return (mass.positive == n && stiffness.positive == n) || (mass.negative == n && stiffness.negative == n);
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
