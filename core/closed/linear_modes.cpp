#include "core/closed/linear_modes.hpp"

#include <algorithm>
#include <optional>

#include "core/closed/characteristic_roots.hpp"
#include "core/closed/equal_parts.hpp"
#include "core/closed/joined_numbers.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

const RationalFunction number_one{{{Monomial{}, Number(1)}}};

class Pair {
 public:
  Pair(const LinearMatrices& matrices, std::size_t first, std::size_t second)
      : m_(matrices.mass), d_(matrices.damping), k_(matrices.stiffness), i_(first), j_(second) {}

  /// Whether what is in front of odd powers of s vanishes in det(M s^2 + D s + K): s^2 is real or complex as
  /// lambda is.
  [[nodiscard]] bool is_even() const {
    const auto mixed = [&](const Entries& a) { return d_[i_][j_] * a[j_][i_] + d_[j_][i_] * a[i_][j_]; };
    return d_[i_][i_].is_zero() && d_[j_][j_].is_zero() && mixed(m_).is_zero() && mixed(k_).is_zero();
  }

  [[nodiscard]] std::vector<LinearMode> modes(Graph& graph) const {
    const RationalFunction a = m_[i_][i_] * m_[j_][j_] - m_[i_][j_] * m_[j_][i_];
    const RationalFunction gyroscopic = d_[i_][j_] * d_[j_][i_];
    const RationalFunction b = m_[i_][j_] * k_[j_][i_] + m_[j_][i_] * k_[i_][j_] - m_[i_][i_] * k_[j_][j_] -
                               m_[j_][j_] * k_[i_][i_] + gyroscopic;
    const RationalFunction c = k_[i_][i_] * k_[j_][j_] - k_[i_][j_] * k_[j_][i_];
    std::vector<LinearMode> found;
    for (Surd& lambda : quadratic_roots(a, b, c)) {
      std::vector<Surd> shape = gyroscopic.is_zero() ? shape_of(lambda) : std::vector<Surd>{};
      const auto root = gyroscopic.is_zero() ? root_by_entries(graph, lambda) : std::nullopt;
      found.push_back({std::move(lambda), std::move(shape), {i_, j_}, {}, root});
    }
    return found;
  }

 private:
  [[nodiscard]] Surd entry(std::size_t i, std::size_t j, const Surd& lambda) const {
    return Surd(k_[i][j]) - lambda * Surd(m_[i][j]);
  }
  [[nodiscard]] std::optional<Expression> root_by_entries(Graph& graph, const Surd& lambda) const {
    if (lambda.is_rational() || !m_[i_][j_].is_zero() || !m_[j_][i_].is_zero()) return std::nullopt;
    const RationalFunction apart = k_[i_][i_] * m_[j_][j_] - k_[j_][j_] * m_[i_][i_], &coupling = k_[i_][j_];
    const RationalFunction four{{{Monomial{}, Number(4)}}}, masses = four * m_[i_][i_] * m_[j_][j_];
    const Surd share =
        square_root((apart * apart + masses * coupling * coupling) / RationalFunction{lambda.n});
    const auto written = [&](const RationalFunction& f) { return simplify(to_expression(graph, f)); };
    const Expression factor = written(share.p);
    if (!share.is_rational() || factor.number() == nullptr) return std::nullopt;
    const RationalFunction by{{{Monomial{}, Number(1) / *factor.number()}}};
    return sqrt(pow(written(by * apart), Number(2)) +
                written(masses) * pow(written(by * coupling), Number(2)));
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

/// Of more than two coordinates, as far as the determinant falls into short factors.
std::vector<LinearMode> modes_of_several(Graph& graph, const LinearMatrices& matrices,
                                         const std::vector<std::size_t>& group) {
  std::vector<LinearMode> found;
  const CharacteristicRoots roots = characteristic_roots(graph, matrices, group);
  for (const Surd& lambda : roots.surds) {
    std::vector<Surd> shape = null_vector(graph, matrices, group, lambda);
    if (!shape.empty()) found.push_back({lambda, std::move(shape), group, {}});
  }
  for (const Surd& lambda : roots.by_angles) found.push_back({lambda, {}, group, {}});
  return found;
}

std::vector<LinearMode> undamped_modes(Graph& graph, const LinearMatrices& matrices,
                                       const std::vector<std::size_t>& group) {
  if (group.size() > 2) return modes_of_several(graph, matrices, group);
  if (group.size() == 2) return Pair(matrices, group[0], group[1]).modes(graph);
  const std::size_t i = group[0];
  LinearMode mode{
      matrices.stiffness[i][i] / matrices.mass[i][i], std::vector<Surd>(matrices.mass.size()), group, {}};
  mode.shape[i] = number_one;
  return {std::move(mode)};
}

std::vector<Surd> product(const Entries& a, const std::vector<Surd>& v) {
  std::vector<Surd> result(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    for (std::size_t j = 0; j < v.size(); ++j) {
      if (!a[i][j].is_zero() && !v[j].is_zero()) result[i] = result[i] + Surd(a[i][j]) * v[j];
    }
  }
  return result;
}

/// d with D v = d M v.
std::optional<Surd> decay_along(Graph& graph, const LinearMatrices& matrices, const std::vector<Surd>& v) {
  const std::vector<Surd> forces = product(matrices.damping, v), momenta = product(matrices.mass, v);
  const auto known = std::ranges::find_if_not(momenta, &Surd::is_zero);
  if (known == momenta.end()) return std::nullopt;
  const auto simple = [&](const Surd& x) { return joined_numbers(graph, x); };
  const Surd decay = simple(forces[static_cast<std::size_t>(known - momenta.begin())] / simple(*known));
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (!simple(forces[i] - decay * momenta[i]).is_zero()) return std::nullopt;
  }
  return decay;
}

/// Those that damping leaves in shape.
std::vector<LinearMode> damped_modes(Graph& graph, const LinearMatrices& matrices,
                                     const std::vector<std::size_t>& group) {
  LinearMatrices without = matrices;
  for (auto& row : without.damping) row.assign(row.size(), RationalFunction{});
  std::vector<LinearMode> found;
  for (LinearMode& mode : undamped_modes(graph, without, group)) {
    const auto decay = decay_along(graph, matrices, mode.shape);
    if (!decay) continue;
    mode.decay = *decay;
    found.push_back(std::move(mode));
  }
  return found;
}

std::vector<LinearMode> modes_of(Graph& graph, const LinearMatrices& matrices,
                                 const std::vector<std::size_t>& group) {
  if (!is_damped(matrices, group)) return undamped_modes(graph, matrices, group);
  if (group.size() == 2) {
    const Pair pair(matrices, group[0], group[1]);
    if (pair.is_even()) return pair.modes(graph);
  }
  return damped_modes(graph, matrices, group);
}

Entries entries(const Matrix& matrix, const ExactPlace& place, std::span<const Replacement> relations) {
  Entries result;
  for (const auto& row : matrix) {
    result.emplace_back();
    for (const Expression& e : row)
      result.back().push_back(rational_function(substitute(place.at(e), relations)));
  }
  return result;
}

std::vector<Surd> in_given_coordinates(const std::vector<std::vector<int>>& basis,
                                       const std::vector<Surd>& shape) {
  std::vector<Surd> result(shape.size());
  for (std::size_t i = 0; i < shape.size(); ++i) {
    for (std::size_t k = 0; k < shape.size(); ++k) {
      if (basis[i][k] == 0 || shape[k].is_zero()) continue;
      const RationalFunction factor{{{Monomial{}, Number(basis[i][k])}}};
      result[i] = result[i] + Surd(factor) * shape[k];
    }
  }
  return result;
}

}  // namespace

std::vector<LinearMode> modes_at(const LinearMotions& motions, const ExactPlace& place,
                                 std::span<const Replacement> relations) {
  const auto at_place = [&](const Matrix& matrix) { return entries(matrix, place, relations); };
  const FallenApart parts =
      fallen_apart({at_place(motions.mass), at_place(motions.damping), at_place(motions.stiffness)});
  std::vector<LinearMode> found;
  for (const std::vector<std::size_t>& group : coupled_groups(parts.matrices)) {
    for (LinearMode& mode : modes_of(*motions.graph, parts.matrices, group)) {
      if (!mode.shape.empty()) mode.shape = in_given_coordinates(parts.basis, mode.shape);
      mode.lambda = joined_numbers(*motions.graph, mode.lambda);
      mode.decay = joined_numbers(*motions.graph, mode.decay);
      for (Surd& component : mode.shape) component = joined_numbers(*motions.graph, component);
      found.push_back(std::move(mode));
    }
  }
  return found;
}

Expression shortest_root(Graph& graph, std::span<const LinearMode> modes, const Polynomial& n) {
  Expression best = root_form(graph, n);
  for (const LinearMode& mode : modes) {
    if (mode.root && mode.lambda.n == n && written_length(*mode.root) < written_length(best))
      best = *mode.root;
  }
  return best;
}

}  // namespace qdot
