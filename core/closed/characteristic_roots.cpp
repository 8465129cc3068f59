#include "core/closed/characteristic_roots.hpp"

#include <algorithm>
#include <bit>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/closed/joined_numbers.hpp"
#include "core/closed/place_algebra.hpp"
#include "core/expr/polynomial_gcd.hpp"
#include "core/steady/factors.hpp"

namespace qdot {
namespace {

/// A determinant that costs more has no short factors.
constexpr std::uint64_t most_work = 60'000;

const Polynomial one{{Monomial{}, Number(1)}};

class Characteristic {
 public:
  Characteristic(Graph& graph, const LinearMatrices& matrices, const std::vector<std::size_t>& group)
      : graph_(graph), lambda_(graph.symbol("lambda of modes")) {
    for (const std::size_t i : group) {
      rows_.push_back(row(matrices, group, i));
      if (rows_.back().empty()) return;
    }
    is_whole_ = true;
  }

  [[nodiscard]] std::vector<Surd> roots() {
    std::vector<Surd> found;
    if (!is_whole_) return found;
    const Polynomial whole = without_factor(determinant(), lambda_);
    if (whole.empty()) return found;
    for (const Polynomial& factor : factors(whole)) {
      const auto c = coefficients(factor);
      if (!c) continue;
      for (const Surd& root : quadratic_roots((*c)[2], (*c)[1], (*c)[0]))
        found.push_back(joined_numbers(graph_, root));
    }
    return found;
  }

 private:
  /// That of K - lambda M, times what is below its entries. Empty where roots stand in it as symbols do.
  [[nodiscard]] std::vector<Polynomial> row(const LinearMatrices& matrices,
                                            const std::vector<std::size_t>& group, std::size_t i) const {
    Polynomial common = one;
    for (const std::size_t j : group) {
      for (const RationalFunction& f : {matrices.mass[i][j], matrices.stiffness[i][j]})
        common = common * *exact_quotient(f.below, greatest_common_divisor(common, f.below));
    }
    const auto times_common = [&](const RationalFunction& f) {
      return exact_quotient(f.above * common, f.below);
    };
    std::vector<Polynomial> result;
    for (const std::size_t j : group) {
      const auto mass = times_common(matrices.mass[i][j]), stiffness = times_common(matrices.stiffness[i][j]);
      if (!mass || !stiffness) return {};
      Polynomial entry = *stiffness;
      add(entry, scaled(*mass, times({}, lambda_.id(), 1), Number(-1)));
      result.push_back(joined_numbers(graph_, entry));
    }
    return result;
  }

  /// By the first rows' minors, one for each set of columns.
  [[nodiscard]] Polynomial determinant() const {
    const std::size_t n = rows_.size(), sets = std::size_t{1} << n;
    std::vector<Polynomial> minors(sets);
    minors[0] = one;
    for (std::size_t set = 1; set < sets; ++set) {
      const std::size_t last = static_cast<std::size_t>(std::popcount(set)) - 1;
      for (std::size_t j = 0; j < n; ++j) {
        const std::size_t bit = std::size_t{1} << j;
        const Polynomial &entry = rows_[last][j], &minor = minors[set & ~bit];
        if ((set & bit) == 0 || entry.empty() || minor.empty()) continue;
        const int behind = std::popcount(set & ~(2 * bit - 1));
        add(minors[set], joined_numbers(graph_, entry * minor), Number(behind % 2 == 0 ? 1 : -1));
      }
    }
    return minors.back();
  }

  [[nodiscard]] std::vector<Polynomial> factors(const Polynomial& whole) const {
    std::vector<Expression> found{to_expression(graph_, whole)};
    for (const NodeId symbol : symbols_of(whole)) {
      std::vector<Expression> next;
      for (const Expression& e : found) {
        for (const Factor& factor : factors_along(e, Expression(graph_, symbol))) {
          if (depends_on(factor.base, lambda_) && std::ranges::find(next, factor.base) == next.end())
            next.push_back(factor.base);
        }
      }
      found = std::move(next);
    }
    std::vector<Polynomial> result;
    for (const Expression& e : found) result.push_back(multiplied_out(e));
    return result;
  }

  [[nodiscard]] std::vector<NodeId> symbols_of(const Polynomial& a) const {
    std::vector<NodeId> found;
    for (const auto& [monomial, coefficient] : a) {
      for (const Atom& atom : monomial) {
        if (atom.base != lambda_.id() && std::ranges::find(found, atom.base) == found.end())
          found.push_back(atom.base);
      }
    }
    if (found.empty()) found.push_back(lambda_.id());
    return found;
  }

  /// Of 1, lambda and lambda^2.
  [[nodiscard]] std::optional<std::vector<RationalFunction>> coefficients(const Polynomial& factor) const {
    if (highest_power(factor, lambda_) > 2) return std::nullopt;
    std::vector<Polynomial> parts(3);
    for (const auto& [monomial, coefficient] : factor) {
      const int power = exponent_of(monomial, lambda_.id());
      add(parts[static_cast<std::size_t>(power)], times(monomial, lambda_.id(), -power), coefficient);
    }
    return std::vector<RationalFunction>{{parts[0]}, {parts[1]}, {parts[2]}};
  }

  Graph& graph_;
  Expression lambda_;
  std::vector<std::vector<Polynomial>> rows_;
  bool is_whole_{};
};

using Rows = std::vector<std::vector<Surd>>;

/// The column's pivot goes to `row`, and 0 into the column beside it; false where it is 0 from there on.
bool eliminates(const Graph& graph, Rows& a, std::size_t row, std::size_t column) {
  std::size_t found = row;
  while (found < a.size() && a[found][column].is_zero()) ++found;
  if (found == a.size()) return false;
  std::swap(a[found], a[row]);
  for (std::size_t r = 0; r < a.size(); ++r) {
    if (r == row || a[r][column].is_zero()) continue;
    const Surd factor = a[r][column] / a[row][column];
    for (std::size_t j = column; j < a.size(); ++j) {
      if (!a[row][j].is_zero()) a[r][j] = joined_numbers(graph, a[r][j] - factor * a[row][j]);
    }
  }
  return true;
}

}  // namespace

std::vector<Surd> characteristic_roots(Graph& graph, const LinearMatrices& matrices,
                                       const std::vector<std::size_t>& group) {
  try {
    const WorkScope budget(std::min(most_work, work_left()));
    return Characteristic(graph, matrices, group).roots();
  } catch (const Error&) {  // as said beside most_work
    return {};
  }
}

std::vector<Surd> null_vector(const Graph& graph, const LinearMatrices& matrices,
                              const std::vector<std::size_t>& group, const Surd& lambda) {
  const std::size_t n = group.size();
  Rows a(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (const std::size_t j : group) {
      const RationalFunction &k = matrices.stiffness[group[i]][j], &m = matrices.mass[group[i]][j];
      a[i].push_back(joined_numbers(graph, m.is_zero() ? Surd(k) : Surd(k) - lambda * Surd(m)));
    }
  }
  std::size_t free = 0;
  while (free < n && eliminates(graph, a, free, free)) ++free;
  if (free == n) return {};
  std::vector<Surd> v(matrices.mass.size());
  v[group[free]] = Surd(RationalFunction{one});
  for (std::size_t k = 0; k < free; ++k) {
    if (!a[k][free].is_zero()) v[group[k]] = joined_numbers(graph, -a[k][free] / a[k][k]);
  }
  return v;
}

}  // namespace qdot
