#include "core/closed/linear_modes.hpp"

#include <algorithm>

#include "core/closed/equal_parts.hpp"
#include "core/closed/joined_numbers.hpp"

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

/// Three coordinates that can move together without a force, det K = 0. What else they do has
///
///   det(K - lambda M) = lambda (b + c lambda + d lambda^2).
class FreeTriple {
 public:
  FreeTriple(const LinearMatrices& matrices, const std::vector<std::size_t>& group)
      : m_(matrices.mass), k_(matrices.stiffness), group_(group) {}

  [[nodiscard]] bool is_free() const { return with_masses({}).is_zero(); }

  [[nodiscard]] std::vector<LinearMode> modes() const {
    const RationalFunction d = -with_masses({0, 1, 2});
    const RationalFunction c = with_masses({0, 1}) + with_masses({0, 2}) + with_masses({1, 2});
    const RationalFunction b = -(with_masses({0}) + with_masses({1}) + with_masses({2}));
    std::vector<LinearMode> found;
    for (Surd& lambda : quadratic_roots(d, c, b)) {
      std::vector<Surd> shape = shape_of(lambda);
      if (!shape.empty()) found.push_back({std::move(lambda), std::move(shape), group_});
    }
    return found;
  }

 private:
  /// det K with some rows those of M.
  [[nodiscard]] RationalFunction with_masses(const std::vector<std::size_t>& rows) const {
    const auto e = [&](std::size_t i, std::size_t j) -> const RationalFunction& {
      const Entries& from = std::ranges::find(rows, i) == rows.end() ? k_ : m_;
      return from[group_[i]][group_[j]];
    };
    return e(0, 0) * (e(1, 1) * e(2, 2) - e(1, 2) * e(2, 1)) +
           e(0, 1) * (e(1, 2) * e(2, 0) - e(1, 0) * e(2, 2)) +
           e(0, 2) * (e(1, 0) * e(2, 1) - e(1, 1) * e(2, 0));
  }

  /// The cross product of two rows of K - lambda M.
  [[nodiscard]] std::vector<Surd> shape_of(const Surd& lambda) const {
    const auto e = [&](std::size_t i, std::size_t j) {
      return Surd(k_[group_[i]][group_[j]]) - lambda * Surd(m_[group_[i]][group_[j]]);
    };
    for (const auto& [a, b] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
      std::vector<Surd> shape(m_.size());
      bool is_found = false;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        shape[group_[i]] = e(a, j) * e(b, k) - e(a, k) * e(b, j);
        is_found = is_found || !shape[group_[i]].is_zero();
      }
      if (is_found) return shape;
    }
    return {};
  }

  const Entries& m_;
  const Entries& k_;
  const std::vector<std::size_t>& group_;
};

std::vector<LinearMode> modes_of(const LinearMatrices& matrices, const std::vector<std::size_t>& group) {
  if (group.size() == 1) {
    const std::size_t i = group[0];
    if (!matrices.damping[i][i].is_zero()) return {};
    LinearMode mode{matrices.stiffness[i][i] / matrices.mass[i][i], std::vector<Surd>(matrices.mass.size()),
                    group};
    mode.shape[i] = number_one;
    return {std::move(mode)};
  }
  if (group.size() == 2) {
    const Pair pair(matrices, group[0], group[1]);
    return pair.is_even() ? pair.modes() : std::vector<LinearMode>{};
  }
  if (group.size() != 3 || is_damped(matrices, group)) return {};
  const FreeTriple triple(matrices, group);
  return triple.is_free() ? triple.modes() : std::vector<LinearMode>{};
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
    for (LinearMode& mode : modes_of(parts.matrices, group)) {
      mode.shape = in_given_coordinates(parts.basis, mode.shape);
      mode.lambda = joined_numbers(*motions.graph, mode.lambda);
      for (Surd& component : mode.shape) component = joined_numbers(*motions.graph, component);
      found.push_back(std::move(mode));
    }
  }
  return found;
}

}  // namespace qdot
