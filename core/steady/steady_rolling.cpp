#include "core/steady/steady_rolling.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "core/compile/tape_evaluator.hpp"
#include "core/mechanics/friction.hpp"
#include "core/steady/surface_statics.hpp"

namespace qdot {
namespace {

/// What determines the accelerations: no motion changes where none of it does.
std::vector<Expression> equations_of(const Model& model) {
  std::vector<Expression> all = model.system.right;
  for (const auto& row : model.system.matrix) all.insert(all.end(), row.begin(), row.end());
  for (const ConstraintEquation& constraint : model.lagrangian.constraints) all.push_back(constraint.rate);
  return all;
}

bool any_depends_on(const std::vector<Expression>& expressions, const Expression& symbol) {
  return std::ranges::any_of(expressions, [&](const Expression& e) { return depends_on(e, symbol); });
}

void check_kind(const Dynamics& dynamics, const Lagrangian& own) {
  const Model& model = dynamics.model();
  if (!model.scene.inputs.empty()) undetermined_on_surface("inputs act on it.");
  if (has_forces_of_multipliers(own))
    undetermined_on_surface("a force depends on their reactions, as friction does.");
  if (dynamics.kinks() != nullptr) undetermined_on_surface("an abs() or a sign() stands in its forces.");
  if (any_depends_on(equations_of(model), model.parsed.symbols.t))
    undetermined_on_surface(
        "the time enters the equations of motion, so that small motions have no frequencies.");
}

/// Lagrange's equations, all that is in them on one side.
std::vector<Expression> all_on_one_side(const Lagrangian& lagrangian) {
  const Symbols::Varying& q = lagrangian.symbols.coordinates;
  std::vector<Expression> equations;
  for (std::size_t i = 0; i < q.value.size(); ++i) {
    const Expression momentum = differentiate(lagrangian.lagrangian, q.rate[i]);
    equations.push_back(total_derivative(momentum, lagrangian.symbols.rates()) -
                        differentiate(lagrangian.lagrangian, q.value[i]) - lagrangian.generalized_forces[i]);
  }
  return equations;
}

/// What is evaluated at the steady motion, where nothing accelerates: q'', E, M, D, K and its slopes along
/// the multipliers, w with phi, A and B.
std::vector<Expression> linearized(const Lagrangian& lagrangian) {
  const Symbols::Varying& q = lagrangian.symbols.coordinates;
  const Expression zero = lagrangian.graph->number(0);
  std::vector<Replacement> none;
  for (const Expression& acceleration : q.second_rate) none.emplace_back(acceleration, zero);
  for (const Expression& lambda : lagrangian.symbols.multipliers) none.emplace_back(lambda, zero);
  std::vector<Expression> all = q.second_rate;
  const std::vector<Expression> equations = all_on_one_side(lagrangian);
  const auto append = [&](const Expression& e) { all.push_back(substitute(e, none)); };
  std::ranges::for_each(equations, append);
  for (const auto* variables : {&q.second_rate, &q.rate, &q.value}) {
    for (const Expression& equation : equations)
      for (const Expression& v : *variables) append(differentiate(equation, v));
  }
  for (const Expression& lambda : lagrangian.symbols.multipliers) {
    for (const Expression& equation : equations)
      for (const Expression& v : q.value) append(differentiate(differentiate(equation, lambda), v));
  }
  for (const ConstraintEquation& constraint : lagrangian.constraints) {
    append(constraint.rate);
    append(constraint.position.value_or(zero));
  }
  for (const auto* variables : {&q.rate, &q.value}) {
    for (const ConstraintEquation& constraint : lagrangian.constraints)
      for (const Expression& v : *variables) append(differentiate(constraint.rate, v));
  }
  return all;
}

/// Takes what linearized() has written, piece by piece.
class Pieces {
 public:
  explicit Pieces(std::span<const Ball> values) : left_(values) {}

  std::span<const Ball> next(std::size_t count) {
    const std::span<const Ball> taken = left_.first(count);
    left_ = left_.subspan(count);
    return taken;
  }
  SquareMatrix<Ball> matrix(std::size_t n) {
    SquareMatrix<Ball> result(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) result(i, j) = next(1)[0];
    }
    return result;
  }
  BallMatrix rows(std::size_t m, std::size_t n) {
    BallMatrix result;
    for (std::size_t j = 0; j < m; ++j) {
      const std::span<const Ball> row = next(n);
      result.emplace_back(row.begin(), row.end());
    }
    return result;
  }

 private:
  std::span<const Ball> left_;
};

/// lambda with A^T lambda = E, exactly zero where E is.
std::vector<Ball> multipliers_of(const BallMatrix& slope, std::span<const Ball> e) {
  const SolvedSlopes solved = solved_slopes(slope, e.size());
  std::vector<Ball> lambda(slope.size(), Ball(0));
  for (std::size_t k = 0; k < slope.size(); ++k) {
    for (std::size_t j = 0; j < slope.size(); ++j)
      lambda[j] = lambda[j] + solved.inverse[k][j] * e[solved.dependent[k]];
  }
  return lambda;
}

void add_scaled(SquareMatrix<Ball>& sum, const Ball& factor, const SquareMatrix<Ball>& a) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j) sum(i, j) = sum(i, j) + factor * a(i, j);
  }
}

/// Those that nothing depends on move as `initial` has them.
std::vector<Ball> resting_but_for_free(const Model& model, const Reals& initial,
                                       const std::optional<std::vector<double>>& guess) {
  std::vector<Ball> y = initial.as<Ball>();
  const std::vector<Expression> equations = equations_of(model);
  const std::size_t n = model.degrees_of_freedom();
  for (std::size_t i = 0; i < n; ++i) {
    if (guess && (*guess)[i] != y[i].value()) y[i] = Ball((*guess)[i]);
    if (any_depends_on(equations, model.parsed.symbols.coordinates.value[i])) y[n + i] = Ball(0);
  }
  return y;
}

constexpr std::string_view exactly =
    "Give a steady state in 'initial'; a value that is no short decimal, as an expression such as "
    "\"2*sqrt(g/l)\".";

/// `residuals`: w and phi of each constraint.
void check_steady(const Scene& scene, std::span<const Ball> accelerations, std::span<const Ball> residuals) {
  for (std::size_t j = 0; j < scene.constraints.size(); ++j) {
    if (!residuals[2 * j].contains_zero() || !residuals[2 * j + 1].contains_zero())
      undetermined_on_surface("'" + scene.constraints[j].name +
                              "' is not obeyed where all coordinates rest that something depends on. " +
                              std::string(exactly));
  }
  for (std::size_t i = 0; i < accelerations.size(); ++i) {
    const Ball& a = accelerations[i];
    if (!a.is_finite()) undetermined_on_surface("the accelerations have no values there.");
    if (!a.contains_zero())
      undetermined_on_surface("this state is no equilibrium and no steady motion, as " +
                              scene.coordinates[i].name + "_ddot is not 0 in it ('energy' shows it). " +
                              std::string(exactly));
  }
}

}  // namespace

bool has_constraint_in_velocities(const Model& model) {
  return std::ranges::any_of(model.lagrangian.constraints,
                             [](const ConstraintEquation& constraint) { return !constraint.position; });
}

SteadyRolling steady_rolling(const Dynamics& dynamics, const Reals& parameters, const Reals& initial,
                             const std::optional<std::vector<double>>& guess) {
  const Model& model = dynamics.model();
  const Lagrangian own = copied(model.lagrangian);
  check_kind(dynamics, own);
  const std::size_t n = model.degrees_of_freedom(), m = model.scene.constraints.size();
  const CompiledFunction function = dynamics.compiled(*own.graph, linearized(own));
  SteadyRolling result{resting_but_for_free(model, initial, guess),
                       SquareMatrix<Ball>(n),
                       SquareMatrix<Ball>(n),
                       SquareMatrix<Ball>(n),
                       {},
                       {},
                       {}};
  std::vector<Ball> values(function.outputs());
  TapeEvaluator<Ball>(function, parameters.as<Ball>())(result.y, values);
  Pieces pieces(values);
  const auto accelerations = pieces.next(n), e = pieces.next(n);
  result.mass = pieces.matrix(n);
  result.rates = pieces.matrix(n);
  result.stiffness = pieces.matrix(n);
  std::vector<SquareMatrix<Ball>> along_multipliers;
  for (std::size_t j = 0; j < m; ++j) along_multipliers.push_back(pieces.matrix(n));
  check_steady(model.scene, accelerations, pieces.next(2 * m));
  result.slope = pieces.rows(m, n);
  result.drift = pieces.rows(m, n);
  const std::vector<Ball> lambda = multipliers_of(result.slope, e);
  for (std::size_t j = 0; j < m; ++j) add_scaled(result.stiffness, lambda[j], along_multipliers[j]);
  for (const ConstraintEquation& constraint : model.lagrangian.constraints)
    result.holonomic.push_back(constraint.position.has_value());
  return result;
}

}  // namespace qdot
