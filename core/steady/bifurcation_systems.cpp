#include "core/steady/bifurcation_systems.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "core/base/error.hpp"
#include "core/compile/tape_builder.hpp"
#include "core/expr/linear.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"
#include "core/steady/exponential_form.hpp"
#include "core/steady/factors.hpp"
#include "core/steady/growing_oscillations.hpp"
#include "core/steady/linear_unknowns.hpp"
#include "core/steady/numerator.hpp"
#include "core/steady/search_region.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_systems = 200;

class SystemsDerivation {
 public:
  SystemsDerivation(const Scene& scene, const Reduction& reduction, const SteadyForces& forces,
                    std::size_t place)
      : forces_(forces), reduction_(reduction), graph_(*forces.graph) {
    for (const Expression& c : reduction.constants) constants_.push_back(graph_.adopt(c));
    p_ = constants_[place];
    constants_[place] = graph_.symbol("unused constant");
    parameters_ = constants_.size() - reduction.ignored.size();
    for (const Expression& x : reduction.x) all_x_.push_back(graph_.adopt(x));
    for (const std::size_t j : forces.unknowns) {
      x_.push_back(all_x_[j]);
      const Domain& domain = scene.coordinates[reduction.kept[j]].domain;
      has_ends_.push_back(domain.lower > -largest_length || domain.upper < largest_length);
    }
  }

  BifurcationSystems run() {
    std::vector<Expression> numerators;
    for (const std::size_t i : forces_.equations) {
      const Expression g = graph_.adopt(forces_.rest[i]);
      result_.depends = result_.depends || depends_on(g, p_);
      numerators.push_back(simplify(numerator_of(g, all_x_)));
    }
    leave_out_linear(numerators);
    if (forces_.charts.empty()) find_growth();
    for (const Expression& numerator : numerators) factors_.push_back(factors_of(numerator));
    if (result_.depends || (growth_ && depends_on(*growth_, p_))) {
      combine({}, 0, factors_.size());
      for (std::size_t i = 0; i < factors_.size(); ++i) add_meetings(i);
    }
    std::vector<Expression> slopes;
    for (const Expression& e : vanishing_) slopes.push_back(differentiate(e, p_));
    std::vector<Expression> square;
    if (!result_.growth.empty() && square_ && knows_all(*square_)) square.push_back(*square_);
    result_.square = compiled(square);
    result_.vanishing = compiled(vanishing_);
    result_.vanishing_slopes = compiled(slopes);
    describe(numerators);
    return std::move(result_);
  }

 private:
  void leave_out_linear(std::vector<Expression>& equations) {
    std::vector<bool> may_go;
    for (std::size_t k = 0; k < x_.size(); ++k)
      may_go.push_back(!has_ends_[k] && !forces_.turns[forces_.unknowns[k]]);
    const std::span parameters = std::span(constants_).first(parameters_);  // those that are 0 are not in it
    LinearUnknowns left = without_linear_unknowns(std::move(equations), x_, may_go, parameters, p_);
    equations = std::move(left.equations);
    std::vector<Expression> x;
    for (const std::size_t k : left.unknowns) {
      x.push_back(x_[k]);
      result_.unknowns.push_back(forces_.unknowns[k]);
    }
    x_ = std::move(x);
    variables_ = x_;
    variables_.push_back(p_);
    result_.values = compiled(left.values);
    for (std::size_t k = 0; k < left.values.size(); ++k)
      by_those_left_.emplace_back(all_x_[forces_.unknowns[k]], left.values[k]);
  }

  /// de_i/dv_j at rest, where the unknowns are what is left of them.
  [[nodiscard]] Matrix slopes_at_rest(const std::vector<Expression>& e,
                                      const std::vector<Expression>& variables) const {
    Matrix result;
    for (const Expression& row : e) {
      result.emplace_back();
      for (const Expression& v : variables)
        result.back().push_back(
            simplify(substitute(substitute(differentiate(row, v), at_rest_), by_those_left_)));
    }
    return result;
  }

  void find_growth() try {
    std::vector<Expression> equations, x_dot, x_ddot, g;
    for (std::size_t i = 0; i < reduction_.x.size(); ++i) {
      equations.push_back(graph_.adopt(reduction_.equations[i]));
      x_dot.push_back(graph_.adopt(reduction_.x_dot[i]));
      x_ddot.push_back(graph_.adopt(reduction_.x_ddot[i]));
      g.push_back(graph_.adopt(forces_.rest[i]));
      for (const Expression& rate : {x_dot.back(), x_ddot.back()})
        at_rest_.emplace_back(rate, graph_.number(0));
    }
    if (equations.size() > largest_written_system) {
      result_.growth_is_unknown = !forces_.symmetric || !rest_without_rates(equations, x_dot);
      return;
    }
    const Matrix rates = slopes_at_rest(equations, x_dot);
    const auto vanishes = [](const std::vector<Expression>& row) {
      return std::ranges::all_of(row, &Expression::is_zero);
    };
    if (forces_.symmetric && std::ranges::all_of(rates, vanishes)) return;
    const auto found =
        growing_oscillations(slopes_at_rest(equations, x_ddot), rates, slopes_at_rest(g, all_x_));
    if (!found) return;
    growth_ = simplify(numerator_of(simplify(found->condition), all_x_));
    result_.growth_is_collision = found->is_collision;
    if (found->square) square_ = simplify(*found->square);
  } catch (const Error& error) {  // the algebra grows too large
    if (error.code() != ErrorCode::too_large) throw;
    growth_.reset();
    result_.growth_is_unknown = true;
  }

  /// No equation has a term that is linear in a velocity, as its derivatives at rest show without algebra.
  [[nodiscard]] bool rest_without_rates(const std::vector<Expression>& equations,
                                        const std::vector<Expression>& x_dot) const {
    return std::ranges::all_of(equations, [&](const Expression& e) {
      return std::ranges::all_of(
          x_dot, [&](const Expression& v) { return substitute(differentiate(e, v), at_rest_).is_zero(); });
    });
  }

  /// Of a family of equilibria. What one of its factors is itself is 0.
  void add_growth(std::vector<Expression> f) {
    if (!growth_) return;
    std::vector<Replacement> zeros;
    for (const Expression& fi : f) {
      if (std::ranges::find(x_, fi) != x_.end()) zeros.emplace_back(fi, graph_.number(0));
    }
    const Expression condition = simplify(substitute(*growth_, zeros));
    if (condition.is_zero() || !knows_all(condition)) return;
    for (const Factor& factor : factors_along(condition, p_)) {
      // Frequencies with a repeated factor pass each other.
      if (!depends_on(factor.base, variables_) || (factor.is_repeated && result_.growth_is_collision))
        continue;
      f.push_back(factor.base);
      add(factor.is_repeated ? BifurcationSystem::Kind::degenerate_growth : BifurcationSystem::Kind::growth,
          f);
      f.pop_back();
    }
  }

  /// No coordinate that is free stands in it.
  [[nodiscard]] bool knows_all(const Expression& e) const {
    return std::ranges::none_of(forces_.free, [&](std::size_t j) { return depends_on(e, all_x_[j]); });
  }

  void describe(const std::vector<Expression>& numerators) {
    result_.numerators = compiled(numerators);
    std::vector<Expression> slopes;
    for (const Expression& e : numerators) {
      for (const Expression& v : variables_) slopes.push_back(simplify(differentiate(e, v)));
    }
    result_.slopes = compiled(slopes);
    for (const Exponential w : {Exponential::rising, Exponential::falling}) add_nested(numerators, w);
    if (x_.size() > 1) return add_mirrors(numerators);
    if (x_.size() != 1 || numerators.size() != 1) return;
    const Expression second = simplify(differentiate(slopes[0], x_[0]));
    result_.higher =
        compiled({second, simplify(differentiate(slopes[0], p_)), simplify(differentiate(second, x_[0]))});
    std::vector<Expression> centres;
    for (const Expression& centre : candidates(numerators[0])) {
      const std::vector<Replacement> reflection{{x_[0], Number(2) * centre - x_[0]}};
      const bool odd = simplify(substitute(numerators[0], reflection) + numerators[0]).is_zero();
      if (odd && std::ranges::find(centres, centre) == centres.end()) centres.push_back(centre);
    }
    if (forces_.turns[result_.unknowns[0]]) {  // half a turn on, the reflection is the same
      const std::vector<Expression> found = centres;
      for (const Expression& centre : found) centres.push_back(centre + graph_.symbol("pi"));
    }
    result_.centres = compiled(centres);
  }

  void add_nested(const std::vector<Expression>& numerators, Exponential w) {
    std::vector<Expression> nested, slopes;
    for (const Expression& e : numerators) nested.push_back(nested_in_exponentials(e, x_, w));
    if (nested == numerators) return;
    for (const Expression& e : nested) {
      for (const Expression& v : variables_) slopes.push_back(simplify(differentiate(e, v)));
    }
    result_.nested.push_back({compiled(nested), compiled(slopes)});
  }

  /// 0, where a factor that is linear in x vanishes, and the middle of the roots of a polynomial in x.
  std::vector<Expression> candidates(const Expression& numerator) {
    std::vector<Expression> found{graph_.number(0)};
    for (const Expression& f : factors_[0]) add_zero_of(f, found);
    constexpr int highest_degree = 8;
    Expression derivative = numerator;
    for (int k = 0; k < highest_degree && !add_zero_of(derivative, found); ++k)
      derivative = simplify(differentiate(derivative, x_[0]));
    return found;
  }

  /// Where f vanishes, if it is linear in x and that is the same for every p.
  bool add_zero_of(const Expression& f, std::vector<Expression>& found) {
    const Expression slope = simplify(differentiate(f, x_[0]));
    if (slope.is_zero()) return true;
    if (depends_on(slope, x_)) return false;
    const std::vector<Replacement> origin{{x_[0], graph_.number(0)}};
    const Expression centre = simplify(Number(-1) * substitute(f, origin) / slope);
    if (!depends_on(centre, variables_)) found.push_back(centre);
    return true;
  }

  void add_mirrors(const std::vector<Expression>& numerators) {
    constexpr std::size_t most = 3;
    if (x_.size() > most) return;
    for (std::size_t set = 1; set < (std::size_t{1} << x_.size()); ++set) {
      std::vector<Replacement> reflection;
      BifurcationSystems::Mirror mirror;
      for (std::size_t j = 0; j < x_.size(); ++j) {
        if ((set >> j & 1U) == 0) continue;
        reflection.emplace_back(x_[j], -x_[j]);
        mirror.turned.push_back(j);
      }
      bool same = true;
      for (std::size_t i = 0; same && i < numerators.size(); ++i) {
        const Expression image = substitute(numerators[i], reflection);
        const bool even = simplify(image - numerators[i]).is_zero();
        if (even) mirror.even.push_back(i);
        same = even || simplify(image + numerators[i]).is_zero();
      }
      if (same) result_.mirrors.push_back(std::move(mirror));
    }
  }

  /// Those that depend on x; what depends on p alone is kept apart.
  std::vector<Expression> factors_of(const Expression& g) {
    std::vector<NodeId> ids{g.id()};
    if (const auto* product = std::get_if<Product>(&g.node())) ids = product->factors;
    std::vector<Expression> result;
    for (const NodeId id : ids) {
      const Expression base = split_power(Expression(graph_, id)).base;
      if (depends_on(base, x_)) {
        for (const Factor& factor : factors_along(base, p_)) {
          if (depends_on(factor.base, x_)) {
            result.push_back(factor.base);
          } else if (depends_on(factor.base, p_)) {
            vanishing_.push_back(factor.base);
          }
        }
      } else if (depends_on(base, p_)) {
        vanishing_.push_back(base);
      }
    }
    return result;
  }

  /// df/dx of one unknown that is no angle, where f = a + p^n b: b a' - a b' = b df/dx - b' f, which knows
  /// nothing of p, so that a search far out, where forces are small, does not depend on how small p is.
  Expression without_parameter(const std::vector<Expression>& f, const Expression& slope) {
    if (f.size() != 1 || forces_.turns[result_.unknowns[0]] || !depends_on(slope, p_)) return slope;
    std::map<int, Polynomial> parts;
    for (const auto& [monomial, coefficient] : multiplied_out(f[0])) {
      const int power = exponent_of(monomial, p_.id());
      const Monomial rest = times(monomial, p_.id(), -power);
      if (depends_on(to_expression(graph_, rest), p_)) return slope;
      qdot::add(parts[power], rest, coefficient);
    }
    if (parts.size() != 2 || parts.begin()->first != 0) return slope;
    const Polynomial &first = parts.begin()->second, &last = parts.rbegin()->second;
    if (!have_no_common_zero(first, last)) return slope;
    const Expression a = to_expression(graph_, first), b = to_expression(graph_, last);
    return simplify(numerator_of(b * differentiate(a, x_[0]) - a * differentiate(b, x_[0]), all_x_));
  }

  /// l^2 + x^2 with a term that knows nothing of x: parameters that are 0 are not in it.
  [[nodiscard]] bool is_sum_of_squares(const Expression& e) {
    if (!std::holds_alternative<Sum>(e.node())) return false;
    const Polynomial terms = multiplied_out(e);
    const auto is_square = [](const auto& term) {
      return !term.second.is_negative() &&
             std::ranges::all_of(term.first, [](const Atom& a) { return a.q == 1 && a.p % 2 == 0; });
    };
    return std::ranges::all_of(terms, is_square) && std::ranges::any_of(terms, [&](const auto& term) {
             return !depends_on(to_expression(graph_, term.first), x_);
           });
  }

  /// Where both vanish, f does for every p. b is one product: of what cannot vanish, or a power of x beside a
  /// polynomial a that has a term without x.
  [[nodiscard]] bool have_no_common_zero(const Polynomial& a, const Polynomial& b) {
    if (b.size() != 1) return false;
    const auto is_positive = [&](const Expression& e) {
      const auto* call = std::get_if<Call>(&e.node());
      return !depends_on(e, x_) || is_sum_of_squares(e) ||
             (call != nullptr && (call->function == Function::exp || call->function == Function::cosh));
    };
    const auto all_are = [&](const Monomial& monomial, const auto& wanted) {
      return std::ranges::all_of(monomial,
                                 [&](const Atom& atom) { return wanted(Expression(graph_, atom.base)); });
    };
    const Monomial& product = b.begin()->first;
    if (all_are(product, is_positive)) return true;
    const auto is_power = [&](const Expression& e) { return e == x_[0] || is_positive(e); };
    const auto is_symbolic = [&](const Expression& e) { return e == x_[0] || !depends_on(e, x_); };
    const auto knows_nothing_of_x = [&](const Expression& e) { return !depends_on(e, x_); };
    return all_are(product, is_power) &&
           std::ranges::all_of(a, [&](const auto& term) { return all_are(term.first, is_symbolic); }) &&
           std::ranges::any_of(a, [&](const auto& term) { return all_are(term.first, knows_nothing_of_x); });
  }

  void add_fold(std::vector<Expression> f) {
    Matrix jacobian;
    for (const Expression& fi : f) {
      jacobian.emplace_back();
      for (const Expression& x : x_) jacobian.back().push_back(differentiate(fi, x));
    }
    const Expression all = without_parameter(f, simplify(determinant(jacobian)));
    if (all.is_zero()) return;
    const std::vector<Factor> factors = factors_along(all, p_);
    Expression constant = graph_.number(1);  // it may be zero for some parameters
    for (const Factor& factor : factors) {
      if (!depends_on(factor.base, variables_)) constant = constant * factor.base;
    }
    for (const Factor& factor : factors) {
      if (!depends_on(factor.base, variables_)) continue;
      f.push_back(constant * factor.base);
      add(factor.is_repeated ? BifurcationSystem::Kind::degenerate_fold : BifurcationSystem::Kind::fold, f);
      f.pop_back();
    }
  }

  void add_meetings(std::size_t i) {
    for (std::size_t a = 0; a < factors_[i].size(); ++a) {
      for (std::size_t b = a + 1; b < factors_[i].size(); ++b) {
        combine({factors_[i][a], factors_[i][b]}, 0, i);
      }
    }
  }

  /// One factor of each force beside what is chosen of the force number `taken`; none taken: a fold.
  void combine(std::vector<Expression> chosen, std::size_t next, std::size_t taken) {
    if (next == factors_.size()) {
      if (taken != factors_.size()) return add(BifurcationSystem::Kind::meeting, chosen);
      add_fold(chosen);
      return add_growth(chosen);
    }
    if (next == taken) return combine(std::move(chosen), next + 1, taken);
    for (const Expression& f : factors_[next]) {
      std::vector<Expression> more = chosen;
      more.push_back(f);
      combine(std::move(more), next + 1, taken);
    }
  }

  void add(BifurcationSystem::Kind kind, const std::vector<Expression>& f) {
    // Without p in it, the system has a zero for every p or for none.
    if (std::none_of(f.begin(), f.end(), [&](const Expression& e) { return depends_on(e, p_); })) return;
    if (result_.systems.size() + result_.growth.size() == most_systems) {
      throw Error(ErrorCode::not_applicable,
                  "The forces have too many factors to follow all their equilibria.");
    }
    std::vector<Expression> values, jacobian;
    for (const Expression& e : f) {
      values.push_back(nested_in_exponentials(e, x_));
      for (const Expression& v : variables_) jacobian.push_back(simplify(differentiate(values.back(), v)));
    }
    const bool is_growth =
        kind == BifurcationSystem::Kind::growth || kind == BifurcationSystem::Kind::degenerate_growth;
    auto& systems = is_growth ? result_.growth : result_.systems;
    systems.push_back({kind, compiled(values), compiled(jacobian)});
  }

  [[nodiscard]] CompiledFunction compiled(const std::vector<Expression>& expressions) {
    TapeBuilder tape(graph_, constants_, graph_.symbol("t"), variables_);
    for (const Expression& e : expressions) tape.output(e);
    return tape.finish();
  }

  const SteadyForces& forces_;
  const Reduction& reduction_;
  Graph graph_;
  std::vector<Expression> constants_, all_x_, x_, variables_;
  std::size_t parameters_{};    ///< how many of the constants are no momenta
  std::vector<bool> has_ends_;  ///< of the forces' unknowns
  Expression p_;
  std::vector<std::vector<Expression>> factors_;  ///< of each force
  std::vector<Expression> vanishing_;
  std::vector<Replacement> at_rest_, by_those_left_;
  std::optional<Expression> growth_, square_;
  BifurcationSystems result_;
};

}  // namespace

BifurcationSystems derive_bifurcation_systems(const Scene& scene, const Reduction& reduction,
                                              const SteadyForces& forces, std::size_t place) {
  return SystemsDerivation(scene, reduction, forces, place).run();
}

}  // namespace qdot
