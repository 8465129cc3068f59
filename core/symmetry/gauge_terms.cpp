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
    for (const Expressions& a : {linear, terms_apart(linear)}) {
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

  /// Of each a_i what has to do with q_i and t alone.
  [[nodiscard]] Expressions terms_apart(const Expressions& a) const {
    Expressions apart;
    for (std::size_t i = 0; i < a.size(); ++i) {
      Expressions others = q_, kept;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      for (const Expression& term : terms_of(a[i])) {
        if (!depends_on(term, others) && !depends_on(term, inputs_)) kept.push_back(term);
      }
      apart.push_back(graph_.sum(kept));
    }
    return apart;
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

  /// b for a.
  [[nodiscard]] std::optional<Expression> rate_of_time(const Expressions& a) const {
    Expressions slopes;
    for (const Expression& one : a) slopes.push_back(differentiate(one, t_));
    for (const auto& proposed : {along_rays(slopes), std::optional(terms_in_time())}) {
      if (proposed && has_slopes(*proposed, slopes)) return proposed;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool has_slopes(const Expression& b, const Expressions& slopes) const {
    for (std::size_t i = 0; i < q_.size(); ++i) {
      if (zeroness(differentiate(b, q_[i]) - slopes[i]) != Zeroness::zero) return false;
    }
    return true;
  }

  /// The integral of slopes(s q).q over s from 0 to 1: term / (degree + 1) for each that has a degree in q.
  [[nodiscard]] std::optional<Expression> along_rays(const Expressions& slopes) const {
    Expressions terms;
    for (std::size_t i = 0; i < q_.size(); ++i) {
      for (const Expression& term : terms_of(slopes[i])) {
        const auto degree = degree_of(term);
        if (!degree || *degree == Number(-1)) return std::nullopt;
        terms.push_back(q_[i] * term / graph_.number(*degree + Number(1)));
      }
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

  /// What of L without velocities has to do with coordinates and the time.
  [[nodiscard]] Expression terms_in_time() const {
    Expressions terms;
    for (const Expression& term : terms_of(at_rest(lagrangian_))) {
      if (depends_on(term, t_) && depends_on(term, q_)) terms.push_back(term);
    }
    return graph_.sum(terms);
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
