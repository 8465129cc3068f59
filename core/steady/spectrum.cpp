#include "core/steady/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

/// Coordinates that act on each other, directly or through others.
std::vector<std::vector<std::size_t>> coupled_coordinates(const SmallMotions& motions) {
  const std::size_t n = motions.size();
  std::vector<std::vector<bool>> reaches(n, std::vector<bool>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      reaches[i][j] = i == j || !motions.mass(i, j).is_zero() || !motions.rates(i, j).is_zero() ||
                      !motions.stiffness(i, j).is_zero();
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (reaches[i][k] && reaches[k][j]) reaches[i][j] = true;
      }
    }
  }
  std::vector<std::vector<std::size_t>> blocks;
  for (std::size_t i = 0; i < n; ++i) {
    const auto block = std::ranges::find_if(
        blocks, [&](const auto& other) { return reaches[i][other[0]] && reaches[other[0]][i]; });
    if (block == blocks.end()) {
      blocks.push_back({i});
    } else {
      block->push_back(i);
    }
  }
  return blocks;
}

SquareMatrix<Ball> part_of(const SquareMatrix<Ball>& a, const std::vector<std::size_t>& block) {
  SquareMatrix<Ball> part(block.size());
  for (std::size_t i = 0; i < block.size(); ++i) {
    for (std::size_t j = 0; j < block.size(); ++j) part(i, j) = a(block[i], block[j]);
  }
  return part;
}

double power_of_two(double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  return std::isfinite(x) && x > 0 ? std::ldexp(1.0, exponent) : 1;
}

/// Coordinates in units in which M has about ones on its diagonal, and the time in one in which K has at most
/// about ones: powers of two, which round nothing.
double make_comparable(SmallMotions& motions) {
  const std::size_t n = motions.size();
  std::vector<double> unit;
  for (std::size_t i = 0; i < n; ++i)
    unit.push_back(power_of_two(1 / std::sqrt(std::abs(motions.mass(i, i).middle.high))));
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const Ball both(unit[i] * unit[j]);
      for (auto* matrix : {&motions.mass, &motions.rates, &motions.stiffness})
        (*matrix)(i, j) = (*matrix)(i, j) * both;
      largest =
          std::max({largest, motions.stiffness(i, j).magnitude(), square(motions.rates(i, j)).magnitude()});
    }
  }
  const double rate = power_of_two(std::sqrt(largest));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      motions.rates(i, j) = motions.rates(i, j) * Ball(1 / rate);
      motions.stiffness(i, j) = motions.stiffness(i, j) * Ball(1 / rate) * Ball(1 / rate);
    }
  }
  return rate;
}

SquareMatrix<ComplexBall> complex(const SquareMatrix<Ball>& a) {
  SquareMatrix<ComplexBall> result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j) result(i, j) = a(i, j);
  }
  return result;
}

bool apart(const EnclosedEigenvalue& a, const EnclosedEigenvalue& b) {
  return magnitude(a.middle - b.middle) * (1 - 0x1p-40) > a.radius + b.radius;
}

/// Of a single eigenvalue whose mirror image is one, too: it lies on the mirror if its disc, made symmetric,
/// meets no other.
template <class Turned>
bool is_own_image(const std::vector<EnclosedEigenvalue>& all, std::size_t i, const Turned& onto_mirror) {
  EnclosedEigenvalue wide = all[i];
  wide.middle = onto_mirror(all[i].middle);
  wide.radius = (all[i].radius + magnitude(all[i].middle - wide.middle)) * (1 + 0x1p-40);
  if (all[i].members != 1 || !(magnitude(all[i].middle - wide.middle) <= all[i].radius)) return false;
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (j != i && !apart(all[j], wide)) return false;
  }
  return true;
}

/// s = +-sqrt(-lambda), lambda from K v = lambda M v.
std::vector<Exponent> from_squares(const SmallMotions& motions) {
  const auto squares = enclose_eigenvalues(complex(motions.stiffness), complex(motions.mass));
  std::vector<Exponent> result;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const auto& [middle, radius, members] = squares[i];
    const std::complex<double> c(middle.re.value(), middle.im.value());
    const bool real = is_own_image(squares, i, [](ComplexBall z) { return ComplexBall(z.re); });
    if (!(radius < std::abs(c) / 2)) {  // they may be zero
      const Exponent near_zero{{}, std::sqrt(std::abs(c) + radius) * (1 + 0x1p-40), 2 * members, false};
      result.insert(result.end(), 2, near_zero);
      continue;
    }
    // Balls take roots of positive numbers only; Newton's step from the double gives the digits.
    ComplexBall s;
    if (real) {
      (c.real() < 0 ? s.re : s.im) = middle_of(sqrt(c.real() < 0 ? -middle.re : middle.re));
    } else {
      const std::complex<double> root = std::sqrt(-c);
      s = ComplexBall(Ball(root.real()), Ball(root.imag()));
      const ComplexBall half(Ball(0.5));
      s = middle_of(half * (s + (ComplexBall() - middle) / s));
    }
    // |sqrt(a) - sqrt(b)| = |a - b|/|sqrt(a) + sqrt(b)|, with sqrt(b) = s: the square of s is near -middle.
    const double off = radius + magnitude(s * s + middle);
    const double reach = off / std::sqrt(std::abs(c)) * (1 + 0x1p-30) + 1e-300;
    result.push_back({s, reach, members, real && c.real() > 0});
    result.push_back({ComplexBall() - s, reach, members, real && c.real() > 0});
  }
  return result;
}

std::vector<Exponent> from_states(const SmallMotions& motions) {
  const auto [a, b] = state_pencil(motions);
  const bool mirrored = motions.undamped();
  const std::vector<EnclosedEigenvalue> found = enclose_eigenvalues(a, b);
  std::vector<Exponent> result;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool on_axis =
        mirrored && is_own_image(found, i, [](ComplexBall z) { return ComplexBall(Ball(0), z.im); });
    result.push_back({found[i].middle, found[i].radius, found[i].members, on_axis});
  }
  return result;
}

std::vector<Exponent> of_one_coordinate(const SmallMotions& motions) {
  const Eigensystem<ComplexBall> found = exponents(motions);
  const std::size_t members = found.group[0] == found.group[1] ? 2 : 1;
  const bool undamped = motions.depends_on_squares() &&
                        motions.stiffness(0, 0).middle.high * motions.mass(0, 0).middle.high > 0;
  std::vector<Exponent> result;
  for (std::size_t i = 0; i < 2; ++i)
    result.push_back({found.values[i], found.radii[i], members, undamped && members == 1});
  return result;
}

std::vector<Exponent> of_block(SmallMotions motions) {
  if (motions.size() == 1) return of_one_coordinate(motions);
  const double rate = make_comparable(motions);
  std::vector<Exponent> result = motions.depends_on_squares() ? from_squares(motions) : from_states(motions);
  for (Exponent& e : result) {
    e.middle = middle_of(e.middle * ComplexBall(Ball(rate)));
    e.radius = e.radius * rate + 0x1p-100 * magnitude(e.middle);
  }
  return result;
}

}  // namespace

std::vector<Exponent> spectrum(const SmallMotions& motions) {
  std::vector<Exponent> result;
  for (const auto& block : coupled_coordinates(motions)) {
    const std::vector<Exponent> found = of_block(
        {part_of(motions.mass, block), part_of(motions.stiffness, block), part_of(motions.rates, block)});
    result.insert(result.end(), found.begin(), found.end());
  }
  return result;
}

Damping damping_of(const std::vector<Exponent>& exponents) {
  const auto real_part = [](const Exponent& e) { return Ball(e.middle.re.middle, e.radius); };
  const auto grows = [&](const Exponent& e) {
    return std::isfinite(e.radius) && !e.undamped && !real_part(e).contains_zero() &&
           e.middle.re.middle.high > 0;
  };
  const auto decays = [&](const Exponent& e) {
    return std::isfinite(e.radius) && !real_part(e).contains_zero() && e.middle.re.middle.high < 0;
  };
  if (std::ranges::any_of(exponents, grows)) return Damping::one_grows;
  return std::ranges::all_of(exponents, decays) ? Damping::all_decay : Damping::undecided;
}

}  // namespace qdot
