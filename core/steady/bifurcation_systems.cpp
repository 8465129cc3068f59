#include "core/steady/bifurcation_systems.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/compile/tape_builder.hpp"
#include "core/expr/linear.hpp"
#include "core/expr/simplify.hpp"
#include "core/steady/centred_form.hpp"
#include "core/steady/exponential_form.hpp"
#include "core/steady/factors.hpp"
#include "core/steady/fold_condition.hpp"
#include "core/steady/fold_on_curve.hpp"
#include "core/steady/growth_condition.hpp"
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
    std::vector<Expression> numerators, denominators;
    for (const std::size_t i : forces_.equations) {
      const Expression g = graph_.adopt(forces_.rest[i]);
      result_.depends = result_.depends || depends_on(g, p_);
      numerators.push_back(simplify(numerator_of(g, all_x_)));
      std::ranges::copy(denominators_of(g, all_x_), std::back_inserter(denominators));
    }
    leave_out_linear(numerators);
    if (x_.size() == 1 && numerators.size() == 1) middle_ = middle_of_roots(numerators[0], variables_);
    for (Expression& e : denominators) e = substitute(e, by_those_left_);
    std::erase_if(denominators, [&](const Expression& e) { return !knows_all(e); });
    result_.denominators = compiled(denominators);
    if (forces_.charts.empty()) {
      growth_ = derive_growth_condition(reduction_, forces_, graph_, all_x_, by_those_left_);
      result_.growth_is_collision = growth_.is_collision;
      result_.growth_is_unknown = growth_.is_unknown;
    }
    for (const Expression& numerator : numerators) factors_.push_back(factors_of(numerator));
    if (result_.depends || (growth_.condition && depends_on(*growth_.condition, p_))) {
      combine({}, 0, factors_.size());
      for (std::size_t i = 0; i < factors_.size(); ++i) add_meetings(i);
      if (x_.size() == 1) add_poles(denominators);
    }
    std::vector<Expression> slopes;
    for (const Expression& e : vanishing_) slopes.push_back(differentiate(e, p_));
    std::vector<Expression> square;
    if (!result_.growth.empty() && growth_.square && knows_all(*growth_.square))
      square.push_back(*growth_.square);
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

  /// Adds the condition of growth for the equilibria at which these factors vanish; coordinates among them
  /// are 0.
  void add_growth(std::vector<Expression> f) {
    if (!growth_.condition) return;
    std::vector<Replacement> zeros;
    for (const Expression& fi : f) {
      if (std::ranges::find(x_, fi) != x_.end()) zeros.emplace_back(fi, graph_.number(0));
    }
    const Expression condition = simplify(substitute(*growth_.condition, zeros));
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

  /// Whether e depends on no coordinate that is free.
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
    if (x_.size() > 1) result_.mirrors = mirrors_of(numerators, x_);
    if (x_.size() != 1 || numerators.size() != 1) return;
    const Expression second = simplify(differentiate(slopes[0], x_[0]));
    result_.higher =
        compiled({second, simplify(differentiate(slopes[0], p_)), simplify(differentiate(second, x_[0]))});
    std::vector<Expression> centres = centres_of_reflection(numerators[0], factors_[0], variables_);
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

  /// The factors of g that depend on x. Those that depend on p alone are kept elsewhere.
  std::vector<Expression> factors_of(const Expression& g) {
    std::vector<NodeId> ids{g.id()};
    if (const auto* product = std::get_if<Product>(&g.node())) ids = product->factors;
    std::vector<Expression> result;
    for (const NodeId id : ids) {
      const Expression base = split_power(Expression(graph_, id)).base;
      if (depends_on(base, x_)) {
        for (const Factor& factor : factors_and_curves(base, p_)) {
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

  /// df/dx, or for one unknown that is no angle a function with the same zeros and without p.
  Expression fold_of(const std::vector<Expression>& f, const Expression& slope) {
    if (f.size() != 1 || forces_.turns[result_.unknowns[0]] || !depends_on(slope, p_)) return slope;
    return fold_without_parameter(f[0], x_[0], p_, all_x_).value_or(slope);
  }

  void add_fold(std::vector<Expression> f) {
    Matrix jacobian;
    for (const Expression& fi : f) {
      jacobian.emplace_back();
      for (const Expression& x : x_) jacobian.back().push_back(differentiate(fi, x));
    }
    const Expression all = fold_of(f, simplify(determinant(jacobian)));
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

  void add_poles(const std::vector<Expression>& denominators) {
    for (const Expression& d : denominators) {
      for (const Expression& f : factors_[0]) {
        const bool is_same = !depends_on(simplify(f / d), variables_);
        if (depends_on(d, x_) && !is_same) add(BifurcationSystem::Kind::pole, {f, d});
      }
    }
  }

  /// Adds the systems in which one factor of each force vanishes beside those that are chosen already. The
  /// force number `taken` has given two of them; where none has, the system is a fold.
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
    if (result_.systems.size() + result_.growth.size() + result_.poles.size() == most_systems) {
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
    const bool is_pole = kind == BifurcationSystem::Kind::pole;
    auto& systems = is_growth ? result_.growth : is_pole ? result_.poles : result_.systems;
    systems.push_back({kind, compiled(values), compiled(jacobian), compiled(folds_of(kind, f))});
  }

  [[nodiscard]] std::vector<Expression> folds_of(BifurcationSystem::Kind kind,
                                                 const std::vector<Expression>& f) const {
    if (kind != BifurcationSystem::Kind::meeting || x_.size() != 1) return {};
    for (const auto& [curve, other] : {std::pair(f[0], f[1]), std::pair(f[1], f[0])}) {
      if (const auto h = no_fold_on_curve(curve, other, variables_)) return {*h};
    }
    return {};
  }

  [[nodiscard]] CompiledFunction compiled(const std::vector<Expression>& expressions) {
    TapeBuilder tape(graph_, constants_, graph_.symbol("t"), variables_);
    for (const Expression& e : expressions) tape.output(middle_ ? in_powers_from(*middle_, e, x_[0]) : e);
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
  std::vector<Replacement> by_those_left_;
  std::optional<Expression> middle_;  ///< of what is compiled
  GrowthCondition growth_;
  BifurcationSystems result_;
};

}  // namespace

BifurcationSystems derive_bifurcation_systems(const Scene& scene, const Reduction& reduction,
                                              const SteadyForces& forces, std::size_t place) {
  return SystemsDerivation(scene, reduction, forces, place).run();
}

}  // namespace qdot
