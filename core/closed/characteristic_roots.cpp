#include "core/closed/characteristic_roots.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/work.hpp"
#include "core/closed/cosine_roots.hpp"
#include "core/closed/joined_numbers.hpp"
#include "core/closed/place_algebra.hpp"
#include "core/expr/polynomial_gcd.hpp"
#include "core/steady/factors.hpp"

namespace qdot {
namespace {

/// A determinant that costs more has no short factors.
constexpr std::uint64_t most_work = 60'000;

const Polynomial one{{Monomial{}, Number(1)}};

using Numbers = std::vector<Number>;  ///< coefficients of 1, x, x^2, ...

Number value_at(const Numbers& c, const Number& x) {
  Number sum(0);
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * x + c[k];
  return sum;
}

/// c / (x - root).
Numbers divided_by_root(const Numbers& c, const Number& root) {
  Numbers result(c.size() - 1);
  Number carry(0);
  for (std::size_t k = c.size(); k-- > 1;) result[k - 1] = carry = carry * root + c[k];
  return result;
}

/// Those of the first degree with small numbers, and what is left if it is of the second; what is of a higher
/// degree stays in c.
std::vector<Numbers> rational_factors(Numbers& c) {
  constexpr int largest = 60;
  std::vector<Numbers> result;
  for (int q = 1; q <= 6; ++q) {
    for (int p = 1; p <= largest && c.size() > 3; ++p) {
      for (const int sign : {1, -1}) {
        const Number root = Number::ratio(sign * p, q);
        if (std::gcd(p, q) != 1 || c.size() < 4 || !value_at(c, root).is_zero()) continue;
        result.push_back({-root, Number(1)});
        c = divided_by_root(c, root);
      }
    }
  }
  if (c.size() == 3) {
    result.push_back(std::move(c));
    c.clear();
  }
  return result;
}

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

  [[nodiscard]] CharacteristicRoots roots() {
    if (!is_whole_) return {};
    const Polynomial whole = without_factor(determinant(), lambda_);
    if (whole.empty()) return {};
    for (const Polynomial& factor : factors(whole)) {
      for (const std::vector<RationalFunction>& c : coefficients(factor)) {
        for (const Surd& root : quadratic_roots(c[2], c[1], c[0]))
          found_.surds.push_back(joined_numbers(graph_, root));
      }
    }
    return std::move(found_);
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

  /// Of 1, lambda and lambda^2, in each part of the factor that is known to be one.
  [[nodiscard]] std::vector<std::vector<RationalFunction>> coefficients(const Polynomial& factor) {
    const int degree = highest_power(factor, lambda_);
    std::vector<Polynomial> parts(static_cast<std::size_t>(degree) + 1);
    for (const auto& [monomial, coefficient] : factor) {
      const int power = exponent_of(monomial, lambda_.id());
      add(parts[static_cast<std::size_t>(power)], times(monomial, lambda_.id(), -power), coefficient);
    }
    if (degree > 2) return by_one_unit(parts);
    parts.resize(3);
    return {{{parts[0]}, {parts[1]}, {parts[2]}}};
  }

  /// Where lambda = mu r, r a product of parameters, leaves numbers only: factors of the first degree with
  /// rational mu, and the rest if it is short; or mu by cosines.
  std::vector<std::vector<RationalFunction>> by_one_unit(const std::vector<Polynomial>& parts) {
    std::vector<Number> numbers;
    for (const Polynomial& part : parts) {
      if (part.size() > 1) return {};
      numbers.push_back(part.empty() ? Number(0) : part.begin()->second);
    }
    const std::size_t top = parts.size() - 1;
    const auto first = std::ranges::find_if(parts, [](const Polynomial& part) { return !part.empty(); });
    const auto low = static_cast<std::size_t>(first - parts.begin());
    if (low + 1 > top || parts[low + 1].empty()) return {};
    const Monomial r = first->begin()->first * inverse(parts[low + 1].begin()->first);
    Monomial unit = first->begin()->first;
    for (std::size_t k = low; k <= top; ++k) {
      if (!parts[k].empty() && parts[k].begin()->first != unit) return {};
      unit = unit * inverse(r);
    }
    const RationalFunction by_unit = in_lowest_terms({{Monomial{}, Number(1)}}, {{r, Number(1)}});
    std::vector<std::vector<RationalFunction>> result;
    for (const std::vector<Number>& c : rational_factors(numbers)) {
      result.emplace_back(3);
      RationalFunction power{one};
      for (std::size_t k = 0; k < c.size(); ++k) {
        if (!c[k].is_zero()) result.back()[k] = RationalFunction{{{Monomial{}, c[k]}}} * power;
        power = power * by_unit;
      }
    }
    const RationalFunction unit_of_lambda{{{r, Number(1)}}};
    for (const Expression& mu : cosine_roots(graph_, std::move(numbers)))
      found_.by_angles.emplace_back(rational_function(mu) * unit_of_lambda);
    return result;
  }

  Graph& graph_;
  Expression lambda_;
  std::vector<std::vector<Polynomial>> rows_;
  bool is_whole_{};
  CharacteristicRoots found_;
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

CharacteristicRoots characteristic_roots(Graph& graph, const LinearMatrices& matrices,
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
