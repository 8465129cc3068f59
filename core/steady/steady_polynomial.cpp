#include "core/steady/steady_polynomial.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/compile/tape_builder.hpp"
#include "core/expr/full_turn.hpp"
#include "core/expr/linear.hpp"
#include "core/expr/polynomial_gcd.hpp"
#include "core/expr/rational_function.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/trigonometry.hpp"
#include "core/steady/factors.hpp"
#include "core/steady/numerator.hpp"
#include "core/steady/steady_forces.hpp"

namespace qdot {
namespace {

class PolynomialDerivation {
 public:
  PolynomialDerivation(const Model& model, const Statics& statics, const Graph& graph,
                       const std::vector<Expression>& forces, const std::string& unknown)
      : model_(model),
        statics_(statics),
        reduction_(statics.reduction),
        forces_(forces),
        own_(std::make_shared<Graph>(graph)) {
    for (const Expression& x : reduction_.x) x_.push_back(graph_.adopt(x));
    const std::size_t parameters = reduction_.constants.size() - reduction_.ignored.size();
    for (std::size_t i = 0; i < parameters; ++i) constants_.push_back(graph_.adopt(reduction_.constants[i]));
    for (const std::size_t c : reduction_.ignored) {
      constants_.push_back(graph_.symbol(model.scene.coordinates[c].name + "_dot"));
    }
    u_ = graph_.symbol(unknown);
    zero_ = {u_, graph_.number(0)};
    express_momenta(parameters);
  }

  SteadyPolynomial run() {
    const auto place = std::find(constants_.begin(), constants_.end(), u_);
    result_.place = static_cast<std::size_t>(place - constants_.begin());
    for (std::size_t i = 0; i < forces_.size(); ++i) {
      const Expression g = simplify(apart_from_squares(substitute(graph_.adopt(forces_[i]), momenta_)));
      if (!g.is_zero()) add_force(i, g);
      add_divisors(g);
    }
    describe_coordinates();
    compile();
    if (x_.size() == 1) write_small_motion();
    result_.forms = coefficients_;
    result_.whole = values_;
    result_.pole_forms = poles_;
    result_.graph = own_;
    return std::move(result_);
  }

 private:
  /// p from q' = b + B p, the rates of the ignored coordinates at rest.
  void express_momenta(std::size_t parameters) {
    const std::size_t n = reduction_.ignored.size();
    if (n == 0) return;
    if (n > largest_written_system) {
      throw Error(ErrorCode::not_applicable, "This scene has too many ignorable coordinates to solve for.");
    }
    std::vector<Replacement> none;
    std::vector<Expression> p;
    for (std::size_t k = 0; k < n; ++k) {
      p.push_back(graph_.adopt(reduction_.constants[parameters + k]));
      none.emplace_back(p.back(), graph_.number(0));
    }
    Matrix matrix;
    std::vector<Expression> right;
    const std::vector<Expression> rates = rates_at_rest(reduction_, graph_);
    for (std::size_t k = 0; k < n; ++k) {
      const Expression& rate = rates[k];
      matrix.emplace_back();
      for (const Expression& symbol : p) matrix.back().push_back(simplify(differentiate(rate, symbol)));
      right.push_back(constants_[parameters + k] - substitute(rate, none));
    }
    const std::vector<Expression> solved = cramer(matrix, right);
    for (std::size_t k = 0; k < n; ++k) momenta_.emplace_back(p[k], solved[k]);
  }

  /// sqrt(u)*sqrt(x^2) for sqrt(u*x^2), so that u/sqrt(u*x^2) has no numerator that vanishes at u = 0.
  [[nodiscard]] Expression apart_from_squares(const Expression& g) const {
    std::vector<Replacement> replacements;
    const NodeId root = g.id();
    for (const NodeId id : reachable(graph_, {&root, 1})) {
      const auto* power = std::get_if<Power>(&graph_.node(id));
      if (power == nullptr || power->exponent.is_integer()) continue;
      const Expression inside(graph_, power->base);
      if (!depends_on(inside, u_) || !std::holds_alternative<Product>(graph_.node(power->base))) continue;
      const Number exponent = power->exponent;
      const Expression outside = squares_in(std::get<Product>(graph_.node(power->base)));
      if (outside != graph_.number(1))
        replacements.emplace_back(Expression(graph_, id),
                                  pow(inside / outside, exponent) * pow(outside, exponent));
    }
    return substitute(g, replacements);
  }

  /// What is positive in it, whatever u is.
  [[nodiscard]] Expression squares_in(Product product) const {
    Expression squares =
        graph_.number(product.coefficient.is_negative() ? -product.coefficient : product.coefficient);
    for (const NodeId factor : product.factors) {
      if (is_even_power(factor) && !depends_on({graph_, factor}, u_))
        squares = squares * Expression(graph_, factor);
    }
    return squares;
  }

  [[nodiscard]] bool is_even_power(NodeId id) const {
    const auto* power = std::get_if<Power>(&graph_.node(id));
    return power != nullptr && (power->exponent * Number::ratio(1, 2)).is_integer();
  }

  /// e and its derivatives along u.
  struct Derivatives {
    Expression e, first, second;
    bool is_quadratic;
    std::vector<Expression> poles;
  };

  [[nodiscard]] Derivatives derivatives(const Expression& g) const {
    const Expression e = numerator_of(g, {&u_, 1});
    const Expression first = simplify(differentiate(e, u_)), second = simplify(differentiate(first, u_));
    return {e, first, second, simplify(differentiate(second, u_)).is_zero(), denominators_of(g, {&u_, 1})};
  }

  /// g in lowest terms, also where sin^2 + cos^2 = 1 hides a common factor, such as the inertia by which
  /// momenta are divided.
  [[nodiscard]] Expression in_lowest_terms_of_angles(const Expression& g) {
    const RationalFunction f = rational_function(g);
    return to_expression(
        graph_, in_lowest_terms(with_single_angles(graph_, f.above), with_single_angles(graph_, f.below)));
  }

  /// The numerator of g without what u it shares with the inertia: where both vanish, as with a mass of 0,
  /// the accelerations go on as before. Forces on a surface are not one for each equation.
  [[nodiscard]] Expression without_inertia(std::size_t equation, const Expression& g) const {
    const bool is_one_each = forces_.size() == reduction_.equations.size();
    if (model_.has_constraints() || !is_one_each || !depends_on(g, u_)) return g;
    Polynomial shared = rational_function(g).above;
    const Expression& row = reduction_.equations[equation];
    for (const Expression& x_ddot : reduction_.x_ddot) {
      const Expression entry = graph_.adopt(at_rest(reduction_, differentiate(row, x_ddot)));
      const Polynomial above = rational_function(substitute(entry, momenta_)).above;
      if (!above.empty()) shared = greatest_common_divisor(shared, above);
    }
    Expression result = g;
    for (const Factor& factor : factors_along(to_expression(graph_, shared), u_)) {
      if (depends_on(factor.base, u_) && !depends_on(factor.base, x_))
        result = to_expression(graph_, rational_function(result / factor.base));
    }
    return result == g ? g : simplify(result);
  }

  /// What g divides by, as far as x decides about it: where it is 0 the force has no value, also where
  /// something else is 0 that is multiplied by it.
  void add_divisors(const Expression& g) {
    const NodeId root = g.id();
    for (const NodeId id : reachable(graph_, {&root, 1})) {
      const auto* power = std::get_if<Power>(&graph_.node(id));
      if (power == nullptr || !power->exponent.is_negative()) continue;
      const Expression base(graph_, power->base);
      if (!depends_on(base, x_) || depends_on(base, u_)) continue;
      if (std::ranges::find(divisors_, base) == divisors_.end()) divisors_.push_back(base);
    }
  }

  void add_force(std::size_t equation, const Expression& force) {
    const Expression g = without_inertia(equation, force);
    Derivatives all = derivatives(g);
    if (!momenta_.empty() || !all.poles.empty()) {
      Derivatives other = derivatives(in_lowest_terms_of_angles(g));
      const bool is_shorter = written_length(other.e) < written_length(all.e);
      if (other.is_quadratic && (!all.is_quadratic || is_shorter)) all = std::move(other);
    }
    const auto& [e, first, second, is_quadratic, poles] = all;
    poles_.insert(poles_.end(), poles.begin(), poles.end());
    SteadyPolynomial::Force result{equation, !first.is_zero(), std::nullopt, false};
    std::vector<Expression> c(3, graph_.number(0));
    if (is_quadratic) {
      c[0] = simplify(substitute(e, {&zero_, 1}));
      c[1] = simplify(substitute(first, {&zero_, 1}));
      c[2] = Number::ratio(1, 2) * second;
      result.degree = !second.is_zero() ? 2 : result.depends ? 1 : 0;
      result.linear_vanishes = c[1].is_zero();
    }
    result_.forces.push_back(result);
    coefficients_.insert(coefficients_.end(), c.begin(), c.end());
    values_.push_back(e);
    derivatives_.push_back(first);
  }

  /// With the momenta that the steady motion has, which stay as they are.
  void write_small_motion() {
    const Expression force = graph_.adopt(statics_.rest[0]);
    const Expression inertia =
        at_rest(reduction_, differentiate(reduction_.equations[0], reduction_.x_ddot[0]));
    result_.stiffness = substitute(differentiate(force, x_[0]), momenta_);
    result_.inertia = substitute(graph_.adopt(inertia), momenta_);
  }

  void describe_coordinates() {
    for (std::size_t j = 0; j < x_.size(); ++j) {
      const bool angle =
          model_.scene.coordinates[reduction_.kept[j]].unit == "rad" || model_.scene.without_units;
      result_.turns.push_back(angle && all([&](const Expression& e) { return has_full_turn(e, x_[j]); }));
      if (!all([&](const Expression& e) { return !depends_on(e, x_[j]); })) result_.needed.push_back(j);
    }
    const auto turns = [&](const Expression& e) { return has_full_turn(e, u_); };
    result_.u_turns = all(turns) && std::ranges::all_of(poles_, turns);
  }

  template <class Holds>
  [[nodiscard]] bool all(const Holds& holds) const {
    return std::all_of(values_.begin(), values_.end(), holds);
  }

  [[nodiscard]] CompiledFunction compiled(const std::vector<Expression>& expressions,
                                          std::vector<Expression> variables) {
    std::vector<Expression> constants = constants_;
    if (variables.size() > x_.size()) constants[result_.place] = graph_.symbol("unused constant");
    TapeBuilder tape(graph_, constants, graph_.symbol("t"), variables);
    for (const Expression& e : expressions) tape.output(e);
    return tape.finish();
  }

  void compile() {
    std::vector<Expression> x_and_u = x_;
    x_and_u.push_back(u_);
    result_.coefficients = compiled(coefficients_, x_);
    result_.divisors = compiled(divisors_, x_);
    result_.poles = compiled(poles_, x_and_u);
    std::vector<Expression> slopes;
    if (x_.size() == 1) {
      for (const Expression& c : coefficients_) slopes.push_back(simplify(differentiate(c, x_[0])));
    }
    result_.slopes = compiled(slopes, x_);
    result_.values = compiled(values_, x_and_u);
    result_.derivatives = compiled(derivatives_, x_and_u);
    std::vector<Expression> momenta;
    for (const auto& [symbol, value] : momenta_) momenta.push_back(value);
    result_.momenta = compiled(momenta, x_);
  }

  const Model& model_;
  const Statics& statics_;
  const Reduction& reduction_;
  const std::vector<Expression>& forces_;
  std::shared_ptr<Graph> own_;
  Graph& graph_{*own_};
  std::vector<Expression> x_, constants_;
  Expression u_;
  Replacement zero_;
  std::vector<Replacement> momenta_;
  std::vector<Expression> coefficients_, values_, derivatives_, divisors_, poles_;
  SteadyPolynomial result_;
};

}  // namespace

SteadyPolynomial derive_steady_polynomial(const Model& model, const Statics& statics, const Graph& graph,
                                          const std::vector<Expression>& forces, const std::string& unknown) {
  return PolynomialDerivation(model, statics, graph, forces, unknown).run();
}

}  // namespace qdot
