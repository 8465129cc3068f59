#include "core/symmetry/gauge_terms.hpp"

#include <algorithm>
#include <optional>

#include "core/base/error.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/zeroness.hpp"

namespace qdot {
namespace {

using Expressions = std::vector<Expression>;

bool is_quadratic(const Expressions& momenta, const Expressions& rates) {
  return std::ranges::all_of(momenta, [&](const Expression& p) {
    return std::ranges::none_of(
        rates, [&](const Expression& rate) { return depends_on(differentiate(p, rate), rates); });
  });
}

class GaugeTerms {
 public:
  explicit GaugeTerms(const Lagrangian& lagrangian)
      : graph_(*lagrangian.graph),
        q_(lagrangian.symbols.coordinates.value),
        rates_(lagrangian.symbols.coordinates.rate),
        inputs_(lagrangian.symbols.inputs.value),
        t_(lagrangian.symbols.t),
        lagrangian_(lagrangian.lagrangian),
        momenta_(conjugate_momenta(lagrangian)) {}

  /// a.q' + b.
  [[nodiscard]] Expression sum() const {
    if (!is_quadratic(momenta_, rates_)) return graph_.number(0);
    Expressions linear;
    for (const Expression& p : momenta_) linear.push_back(at_rest(p));
    for (const Expressions& a : {linear, beside_a_uniform_field(linear), terms_apart(linear)}) {
      if (std::ranges::all_of(a, &Expression::is_zero) || !is_gradient(a)) continue;
      if (const auto b = rate_of_time(a)) return with(a, *b);
    }
    return graph_.number(0);
  }

 private:
  [[nodiscard]] Expression at_rest(const Expression& e) const {
    std::vector<Replacement> stopped;
    for (const Expression& rate : rates_) stopped.emplace_back(rate, graph_.number(0));
    return substitute(e, stopped);
  }

  template <class IsKept>
  [[nodiscard]] Expressions selected(const Expressions& a, IsKept is_kept) const {
    Expressions result;
    for (std::size_t i = 0; i < a.size(); ++i) {
      Expressions kept = terms_of(a[i]);
      std::erase_if(kept, [&](const Expression& term) { return !is_kept(i, term); });
      result.push_back(graph_.sum(kept));
    }
    return result;
  }

  /// Without what is linear in the coordinates, as the potential of a uniform magnetic field.
  [[nodiscard]] Expressions beside_a_uniform_field(const Expressions& a) const {
    return selected(a, [&](std::size_t, const Expression& term) {
      return depends_on(term, t_) || degree_of(term) != Number(1);
    });
  }

  /// Of each a_i what has to do with q_i and t alone.
  [[nodiscard]] Expressions terms_apart(const Expressions& a) const {
    return selected(a, [&](std::size_t i, const Expression& term) {
      Expressions others = q_;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      return !depends_on(term, others) && !depends_on(term, inputs_);
    });
  }

  [[nodiscard]] bool is_gradient(const Expressions& a) const {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (depends_on(a[i], inputs_)) return false;
      for (std::size_t j = 0; j < i; ++j) {
        if (zeroness(differentiate(a[i], q_[j]) - differentiate(a[j], q_[i])) != Zeroness::zero) return false;
      }
    }
    return true;
  }

  /// b for a: the integral of what has a degree in the coordinates, and terms of L for the rest.
  [[nodiscard]] std::optional<Expression> rate_of_time(const Expressions& a) const {
    Expressions slopes;
    for (const Expression& one : a) slopes.push_back(differentiate(one, t_));
    const auto has_degree = [&](std::size_t, const Expression& term) {
      const auto degree = degree_of(term);
      return degree && *degree != Number(-1);
    };
    const Expressions even = selected(slopes, has_degree);
    Expressions rest;
    for (std::size_t i = 0; i < slopes.size(); ++i) rest.push_back(expand(slopes[i] - even[i]));
    const Expression b = along_rays(even) + terms_with(rest);
    return has_slopes(b, slopes) ? std::optional(b) : std::nullopt;
  }

  [[nodiscard]] bool has_slopes(const Expression& b, const Expressions& slopes) const {
    for (std::size_t i = 0; i < q_.size(); ++i) {
      if (zeroness(differentiate(b, q_[i]) - slopes[i]) != Zeroness::zero) return false;
    }
    return true;
  }

  /// The integral of slopes(s q).q over s from 0 to 1: term / (degree + 1) for each.
  [[nodiscard]] Expression along_rays(const Expressions& slopes) const {
    Expressions terms;
    for (std::size_t i = 0; i < q_.size(); ++i) {
      for (const Expression& term : terms_of(slopes[i]))
        terms.push_back(q_[i] * term / graph_.number(*degree_of(term) + Number(1)));
    }
    return graph_.sum(terms);
  }

  /// q.d(term)/dq over the term.
  [[nodiscard]] std::optional<Number> degree_of(const Expression& term) const {
    Expressions parts;
    for (const Expression& q : q_) parts.push_back(q * differentiate(term, q));
    const Expression degree = simplify(graph_.sum(parts) / term);
    return degree.number() ? std::optional(*degree.number()) : std::nullopt;
  }

  /// Those terms of L without velocities whose slopes are among these, one after another.
  [[nodiscard]] Expression terms_with(Expressions slopes) const {
    Expressions found;
    if (std::ranges::all_of(slopes, &Expression::is_zero)) return graph_.number(0);
    for (const Expression& term : terms_of(at_rest(lagrangian_))) {
      Expressions left;
      for (std::size_t i = 0; i < q_.size(); ++i)
        left.push_back(expand(slopes[i] - differentiate(term, q_[i])));
      if (number_of_terms(left) >= number_of_terms(slopes)) continue;
      slopes = std::move(left);
      found.push_back(term);
    }
    return graph_.sum(found);
  }

  [[nodiscard]] static std::size_t number_of_terms(const Expressions& sums) {
    std::size_t number = 0;
    for (const Expression& sum : sums) number += sum.is_zero() ? 0 : terms_of(sum).size();
    return number;
  }

  [[nodiscard]] Expression with(const Expressions& a, const Expression& b) const {
    Expressions terms{b};
    for (std::size_t i = 0; i < a.size(); ++i) terms.push_back(a[i] * rates_[i]);
    return graph_.sum(terms);
  }

  Graph& graph_;
  const Expressions &q_, &rates_, &inputs_;
  const Expression& t_;
  const Expression& lagrangian_;
  Expressions momenta_;
};

}  // namespace

Expression without_gauge_terms(const Lagrangian& lagrangian) {
  try {
    const Expression gauge = GaugeTerms(lagrangian).sum();
    return gauge.is_zero() ? lagrangian.lagrangian : lagrangian.lagrangian - gauge;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return lagrangian.lagrangian;
  }
}

}  // namespace qdot
