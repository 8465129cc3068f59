#include "core/steady/force_system.hpp"

#include <algorithm>
#include <cmath>

namespace qdot {
namespace {

/// A value whose one end is as small, or infinite, may have lost its sign to the range of doubles.
bool out_of_range(const Interval& g) {
  constexpr double nearly_underflown = 1e-200;
  return !g.is_finite() || std::min(std::abs(g.lower), std::abs(g.upper)) < nearly_underflown;
}

std::vector<LogInterval> by_logarithms(std::span<const Interval> x) {
  return std::vector<LogInterval>(x.begin(), x.end());
}

}  // namespace

ForceSystem::ForceSystem(const SteadyForces& forces, std::span<const Interval> constants, Box place)
    : forces_(forces),
      equations_(forces.equations),
      n_(place.size()),
      kinks_(forces.smooth.kinks()),
      values_(forces.smooth.forces, constants),
      stiffness_(forces.smooth.stiffness, constants),
      numerators_(forces.smooth.numerators, constants),
      combinations_(forces.smooth.combinations, constants),
      arguments_(forces.smooth.arguments, constants),
      slopes_(forces.smooth.slopes, constants),
      determinants_(forces.determinants, constants),
      log_values_(forces.smooth.forces, by_logarithms(constants)),
      log_numerators_(forces.smooth.numerators, by_logarithms(constants)),
      variables_(std::move(place)),
      g_(forces.rest.size()),
      k_(forces.rest.size() * (n_ + kinks_)),
      c_(forces.smooth.combinations.outputs()),
      u_(kinks_),
      du_(kinks_ * (n_ + kinks_)),
      d_(forces.charts.size()) {
  variables_.resize(n_ + kinks_);
}

void ForceSystem::use(const Chart& chart, std::span<const double> sizes) {
  chart_ = static_cast<std::size_t>(&chart - forces_.charts.data());
  equations_ = chart.equations;
  weights_.clear();
  for (const Chart& other : forces_.charts) {
    double weight = 1;
    for (const std::size_t j : other.determinant) weight *= sizes[j];
    weights_.push_back(weight);
  }
}

std::vector<Sides> ForceSystem::patterns() const {
  std::vector<Sides> result{{}};
  for (std::size_t k = 0; k < kinks_; ++k) {
    std::vector<Sides> longer;
    for (const Sides& sides : result) {
      for (const int side : {-1, 0, 1}) {
        if (side == 0 && !forces_.smooth.jumps[k]) continue;
        longer.push_back(sides);
        longer.back().push_back(side);
      }
    }
    result = std::move(longer);
  }
  return result;
}

SquareSystem ForceSystem::at(const Sides& sides) {
  const auto active = static_cast<std::size_t>(std::ranges::count(sides, 0));
  return {forces_.unknowns.size() + active, [this, sides](auto x, auto out) { write_values(sides, x, out); },
          [this, sides](auto x, auto out) { write_jacobian(sides, x, out); },
          [this, sides](auto x, auto values) { return excludes(sides, x, values); }};
}

Box ForceSystem::place_of(std::span<const Interval> unknowns) const {
  Box x(variables_.begin(), variables_.begin() + static_cast<std::ptrdiff_t>(n_));
  for (std::size_t j = 0; j < forces_.unknowns.size(); ++j) x[forces_.unknowns[j]] = unknowns[j];
  return x;
}

std::span<const Interval> ForceSystem::arguments(const Sides& sides, std::span<const Interval> unknowns) {
  std::size_t next = 0;
  for (const std::size_t j : forces_.unknowns) variables_[j] = unknowns[next++];
  for (std::size_t k = 0; k < kinks_; ++k) {
    variables_[n_ + k] = sides[k] == 0 ? unknowns[next++] : Interval(sides[k]);
  }
  return variables_;
}

void ForceSystem::write_values(const Sides& sides, std::span<const Interval> unknowns,
                               std::span<Interval> out) {
  const auto v = arguments(sides, unknowns);
  values_(v, g_);
  std::size_t next = 0;
  bool pole = false;
  for (const std::size_t i : equations_) {
    out[next] = g_[i];
    pole = pole || !out[next].is_finite();
    ++next;
  }
  if (pole && forces_.has_poles) {  // the numerator has the same zeros
    numerators_(v, g_);
    for (std::size_t k = 0; k < next; ++k) {
      if (!out[k].is_finite()) out[k] = g_[equations_[k]];
    }
  }
  if (next == out.size()) return;
  arguments_(v, u_);
  for (std::size_t k = 0; k < kinks_; ++k) {
    if (sides[k] == 0) out[next++] = u_[k];
  }
}

void ForceSystem::write_jacobian(const Sides& sides, std::span<const Interval> unknowns,
                                 std::span<Interval> out) {
  const auto v = arguments(sides, unknowns);
  std::size_t next = 0;
  if (forces_.has_poles) values_(v, g_);
  const auto write_row = [&](const Box& rows, std::size_t row) {
    const std::size_t first = row * (n_ + kinks_);
    for (const std::size_t j : forces_.unknowns) out[next++] = rows[first + j];
    for (std::size_t k = 0; k < kinks_; ++k) {
      if (sides[k] == 0) out[next++] = rows[first + n_ + k];
    }
  };
  stiffness_(v, k_);
  for (const std::size_t i : equations_) {
    const std::span<Interval> row = out.subspan(next);
    write_row(k_, i);
    // A slope may have a bound where its force jumps: that of sqrt(x^2)/x is 0.
    if (forces_.has_poles && !g_[i].is_finite())
      std::ranges::fill(row.first(row.size() - (out.size() - next)), Interval::whole());
  }
  if (next == out.size()) return;
  slopes_(v, du_);
  for (std::size_t k = 0; k < kinks_; ++k) {
    if (sides[k] == 0) write_row(du_, k);
  }
}

bool ForceSystem::excludes(const Sides& sides, std::span<const Interval> unknowns,
                           std::span<const Interval> values) {
  const auto v = arguments(sides, unknowns);
  if (kinks_ > 0) {
    arguments_(v, u_);
    for (std::size_t k = 0; k < kinks_; ++k) {
      if (sides[k] > 0 ? u_[k].upper < 0 : sides[k] < 0 && u_[k].lower > 0) return true;
    }
  }
  if (combination_excludes(v) || kinks_are_apart(sides, v) || is_outside_of_chart(v)) return true;
  const auto forces = values.first(equations_.size());
  return std::ranges::any_of(forces, out_of_range) && never_vanishes(v);
}

bool ForceSystem::combination_excludes(std::span<const Interval> variables) {
  if (c_.empty()) return false;
  combinations_(variables, c_);
  return std::ranges::any_of(c_, [](const Interval& c) { return !c.contains(0.0); });
}

/// Where two of those at which the place is go alike, one less a multiple of the other does not vanish,
///   u_k(c) - r u_l(c) + (du_k - r du_l) (X - c),   c in X.
bool ForceSystem::kinks_are_apart(const Sides& sides, std::span<const Interval> variables) {
  if (std::ranges::count(sides, 0) < 2) return false;
  const Box center = middle(Box(variables.begin(), variables.end()));
  slopes_(variables, du_);
  arguments_(center, u_);
  const auto row = [&](std::size_t k) { return std::span(du_).subspan(k * center.size(), center.size()); };
  const auto may_meet = [&](std::size_t k, std::size_t l) {
    const auto steepest = std::ranges::max_element(row(l), {}, &Interval::magnitude) - row(l).begin();
    const auto j = static_cast<std::size_t>(steepest);
    const double ratio = row(k)[j].middle() / row(l)[j].middle();
    if (!std::isfinite(ratio)) return true;
    Interval apart = u_[k] - Interval(ratio) * u_[l];
    for (std::size_t i = 0; i < center.size(); ++i)
      apart = apart + (row(k)[i] - Interval(ratio) * row(l)[i]) * (variables[i] - center[i]);
    return apart.contains(0.0);
  };
  for (std::size_t k = 0; k < kinks_; ++k) {
    for (std::size_t l = 0; l < k; ++l) {
      if (sides[k] == 0 && sides[l] == 0 && !may_meet(k, l)) return true;
    }
  }
  return false;
}

const Box& ForceSystem::weighted_determinants(std::span<const Interval> variables) {
  determinants_(variables.first(n_), d_);
  for (std::size_t k = 0; k < d_.size(); ++k)
    d_[k] = Interval(d_[k].least_magnitude(), d_[k].magnitude()) * Interval(weights_[k]);
  return d_;
}

bool ForceSystem::is_outside_of_chart(std::span<const Interval> variables) {
  if (d_.empty()) return false;
  values_(variables, g_);
  if (std::ranges::any_of(g_, [](const Interval& g) { return !g.contains(0.0); })) return true;
  if (d_.size() == 1) return false;
  const Box& d = weighted_determinants(variables);
  return std::ranges::any_of(d, [&](const Interval& other) { return 2 * d[chart_].upper < other.lower; });
}

std::optional<bool> ForceSystem::is_in_chart(std::span<const Interval> unknowns) {
  if (d_.empty()) return true;
  const Box& d = weighted_determinants(arguments(Sides(kinks_, 1), unknowns));
  if (d[chart_].lower > 0) return true;
  const bool is_elsewhere =
      std::ranges::any_of(d, [&](const Interval& other) { return d[chart_].upper < other.lower; });
  return is_elsewhere ? std::optional(false) : std::nullopt;
}

bool ForceSystem::never_vanishes(std::span<const Interval> variables) {
  const std::vector<LogInterval> v = by_logarithms(variables);
  std::vector<LogInterval> g(forces_.rest.size());
  for (auto* function : {&log_values_, &log_numerators_}) {
    (*function)(v, g);
    for (const std::size_t i : equations_) {
      if (!g[i].contains_zero()) return true;
    }
  }
  return false;
}

std::optional<bool> ForceSystem::holds(const Sides& sides, std::span<const Interval> unknowns) {
  const auto v = arguments(sides, unknowns);
  arguments_(v, u_);
  bool certain = true;
  for (std::size_t k = 0; k < kinks_; ++k) {
    const Interval& s = v[n_ + k];
    const Interval inside = sides[k] == 0 ? Interval(1) - square(s) : sides[k] > 0 ? u_[k] : -u_[k];
    if (inside.upper < 0) return false;
    certain = certain && inside.lower > 0;
  }
  return certain ? std::optional(true) : std::nullopt;
}

bool ForceSystem::is_pole(const Sides& sides, std::span<const Interval> unknowns) {
  values_(arguments(sides, unknowns), g_);
  return std::ranges::any_of(g_, [](const Interval& g) { return !g.is_finite(); });
}

}  // namespace qdot
