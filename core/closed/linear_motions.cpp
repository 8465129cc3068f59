#include "core/closed/linear_motions.hpp"

#include <algorithm>
#include <numeric>

namespace qdot {
namespace {

using Entries = std::vector<std::vector<RationalFunction>>;

Matrix derivatives(const Reduction& reduction, const std::vector<Expression>& rows,
                   const std::vector<Expression>& variables) {
  Matrix result;
  for (const Expression& row : rows) {
    result.emplace_back();
    for (const Expression& v : variables) result.back().push_back(at_rest(reduction, differentiate(row, v)));
  }
  return result;
}

/// Groups of coordinates that no entry couples to others.
std::vector<std::vector<std::size_t>> groups(const Entries& mass, const Entries& damping,
                                             const Entries& stiffness) {
  const std::size_t n = mass.size();
  std::vector<std::size_t> group(n);
  std::iota(group.begin(), group.end(), 0);
  const auto coupled = [](const Entries& a, std::size_t i, std::size_t j) {
    return !a[i][j].is_zero() || !a[j][i].is_zero();
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (group[i] != group[j] && (coupled(mass, i, j) || coupled(damping, i, j) || coupled(stiffness, i, j)))
        std::ranges::replace(group, std::max(group[i], group[j]), std::min(group[i], group[j]));
    }
  }
  std::vector<std::vector<std::size_t>> result(n);
  for (std::size_t i = 0; i < n; ++i) result[group[i]].push_back(i);
  std::erase_if(result, [](const auto& members) { return members.empty(); });
  return result;
}

const RationalFunction number_one{{{Monomial{}, Number(1)}}};

class Pair {
 public:
  Pair(const Entries& mass, const Entries& damping, const Entries& stiffness, std::size_t first,
       std::size_t second)
      : m_(mass), d_(damping), k_(stiffness), i_(first), j_(second) {}

  /// Whether what is in front of odd powers of s vanishes in det(M s^2 + D s + K): s^2 is real or complex as
  /// lambda is.
  [[nodiscard]] bool is_even() const {
    const auto mixed = [&](const Entries& a) { return d_[i_][j_] * a[j_][i_] + d_[j_][i_] * a[i_][j_]; };
    return d_[i_][i_].is_zero() && d_[j_][j_].is_zero() && mixed(m_).is_zero() && mixed(k_).is_zero();
  }

  [[nodiscard]] std::vector<LinearMode> modes() const {
    const RationalFunction a = m_[i_][i_] * m_[j_][j_] - m_[i_][j_] * m_[j_][i_];
    const RationalFunction gyroscopic = d_[i_][j_] * d_[j_][i_];
    const RationalFunction b = m_[i_][j_] * k_[j_][i_] + m_[j_][i_] * k_[i_][j_] - m_[i_][i_] * k_[j_][j_] -
                               m_[j_][j_] * k_[i_][i_] + gyroscopic;
    const RationalFunction c = k_[i_][i_] * k_[j_][j_] - k_[i_][j_] * k_[j_][i_];
    std::vector<LinearMode> found;
    for (Surd& lambda : quadratic_roots(a, b, c)) {
      std::vector<Surd> shape = gyroscopic.is_zero() ? shape_of(lambda) : std::vector<Surd>{};
      found.push_back({std::move(lambda), std::move(shape), {i_, j_}});
    }
    return found;
  }

 private:
  [[nodiscard]] Surd entry(std::size_t i, std::size_t j, const Surd& lambda) const {
    return Surd(k_[i][j]) - lambda * Surd(m_[i][j]);
  }
  /// (1, y) from the first equation that tells y, else (0, 1).
  [[nodiscard]] std::vector<Surd> shape_of(const Surd& lambda) const {
    std::vector<Surd> shape(m_.size());
    for (const std::size_t row : {i_, j_}) {
      const Surd factor = entry(row, j_, lambda);
      if (factor.is_zero()) continue;
      shape[i_] = number_one;
      shape[j_] = -entry(row, i_, lambda) / factor;
      return shape;
    }
    shape[j_] = number_one;
    return shape;
  }

  const Entries& m_;
  const Entries& d_;
  const Entries& k_;
  std::size_t i_, j_;
};

Entries entries(const Matrix& matrix, const ExactPlace& place, std::span<const Replacement> relations) {
  Entries result;
  for (const auto& row : matrix) {
    result.emplace_back();
    for (const Expression& e : row)
      result.back().push_back(rational_function(substitute(place.at(e), relations)));
  }
  return result;
}

}  // namespace

LinearMotions linear_motions(const Statics& statics, bool momenta_vanish) {
  LinearMotions result;
  result.graph = std::make_shared<Graph>(*statics.reduction.graph);
  Graph& graph = *result.graph;
  Reduction own = statics.reduction;
  own.graph = result.graph;
  std::vector<Replacement> zeros;
  for (auto* symbols :
       {&own.x, &own.x_dot, &own.x_ddot, &own.constants, &own.ignored_rates, &own.equations}) {
    for (Expression& e : *symbols) e = graph.adopt(e);
  }
  if (momenta_vanish) {
    for (std::size_t i = own.constants.size() - own.ignored.size(); i < own.constants.size(); ++i)
      zeros.emplace_back(own.constants[i], graph.number(0));
    for (Expression& e : own.equations) e = substitute(e, zeros);
    for (Expression& e : own.ignored_rates) e = substitute(e, zeros);
  }
  result.x = own.x;
  for (const Expression& e : own.equations) result.forces.push_back(at_rest(own, e));
  result.stiffness = derivatives(own, result.forces, own.x);
  result.mass = derivatives(own, own.equations, own.x_ddot);
  result.damping = derivatives(own, own.equations, own.x_dot);
  result.ignored_rates = derivatives(own, own.ignored_rates, own.x_dot);
  result.ignored_slopes = derivatives(own, own.ignored_rates, own.x);
  return result;
}

bool momenta_vanish(const Dynamics& dynamics, const Statics& statics, const Reals& parameters,
                    std::span<const double> y) {
  if (statics.reduction.ignored.empty()) return true;
  const auto columns = momentum_columns(dynamics.model(), statics.reduction.ignored);
  return std::ranges::all_of(values_at(dynamics, columns, parameters, 0, y), [](double p) { return p == 0; });
}

PlaceProblem place_problem(const LinearMotions& motions, const Statics& statics, const ExactValues& values,
                           std::span<const Interval> near) {
  PlaceProblem problem{motions.x, {}, motions.forces, {}, {}, {}};
  const Scene& scene = values.model().scene;
  for (const std::size_t i : statics.reduction.kept) {
    problem.is_angle.push_back(scene.coordinates[i].unit == "rad");
    problem.near.push_back(near[i]);
  }
  for (std::size_t i = 0; i < scene.parameters.size(); ++i) {
    if (scene.parameters[i].unit != "rad") continue;
    problem.offsets.push_back(values.symbols()[i]);
    problem.offset_values.push_back(values.parameters()[i]);
  }
  return problem;
}

std::vector<LinearMode> modes_at(const LinearMotions& motions, const ExactPlace& place,
                                 std::span<const Replacement> relations) {
  const Entries damping = entries(motions.damping, place, relations);
  const Entries mass = entries(motions.mass, place, relations);
  const Entries stiffness = entries(motions.stiffness, place, relations);
  std::vector<LinearMode> found;
  for (const std::vector<std::size_t>& group : groups(mass, damping, stiffness)) {
    if (group.size() == 1) {
      const std::size_t i = group[0];
      if (!damping[i][i].is_zero()) continue;
      LinearMode mode{stiffness[i][i] / mass[i][i], std::vector<Surd>(mass.size()), group};
      mode.shape[i] = number_one;
      found.push_back(std::move(mode));
    } else if (group.size() == 2) {
      const Pair pair(mass, damping, stiffness, group[0], group[1]);
      if (!pair.is_even()) continue;
      for (LinearMode& mode : pair.modes()) found.push_back(std::move(mode));
    }
  }
  return found;
}

}  // namespace qdot
