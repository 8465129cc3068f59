#include "core/steady/constrained_modes.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mechanics/friction.hpp"
#include "core/steady/mode_search.hpp"

namespace qdot {
namespace {

using BallMatrix = std::vector<std::vector<Ball>>;

[[noreturn]] void undetermined(const std::string& why) {
  throw Error(ErrorCode::not_applicable, "This is undetermined for a scene with constraints: " + why);
}

/// L + sum of lambda phi, the multipliers coordinates of their own.
std::shared_ptr<const Model> with_multipliers_as_coordinates(const Model& model) {
  auto result = std::make_shared<Model>(model);
  Lagrangian& own = result->lagrangian = copied(model.lagrangian);
  Graph& graph = *own.graph;
  std::vector<Replacement> no_forces;
  Expression terms = graph.number(0);
  for (std::size_t j = 0; j < own.constraints.size(); ++j) {
    const Expression& lambda = own.symbols.multipliers[j];
    const std::string name = multiplier_name(model.scene.constraints[j]);
    no_forces.emplace_back(lambda, graph.number(0));
    terms = terms + lambda * *own.constraints[j].position;
    own.symbols.coordinates.value.push_back(lambda);
    own.symbols.coordinates.rate.push_back(graph.symbol(name + "_dot"));
    own.symbols.coordinates.second_rate.push_back(graph.symbol(name + "_ddot"));
    result->scene.coordinates.push_back(
        {name, model.parsed.constraints[j].multiplier_unit, "", "", "", {}, "", ""});
  }
  for (Expression& force : own.generalized_forces) force = substitute(force, no_forces);
  own.generalized_forces.resize(own.symbols.coordinates.value.size(), graph.number(0));
  own.lagrangian = own.lagrangian + terms;
  if (own.potential_energy) own.potential_energy = *own.potential_energy - terms;
  own.symbols.multipliers.clear();
  own.constraints.clear();
  result->scene.constraints.clear();
  result->equations = {};
  result->parsed.graph = own.graph;
  result->parsed.symbols = own.symbols;
  return result;
}

void check_constraints(const Model& model) {
  for (std::size_t j = 0; j < model.scene.constraints.size(); ++j) {
    const ConstraintEquation& constraint = model.lagrangian.constraints[j];
    const std::string name = "'" + model.scene.constraints[j].name + "'";
    if (!constraint.position)
      undetermined(name +
                   " holds velocities, so that the system may rest in any place where the forces allow it.");
    if (!is_workless(constraint, model.parsed.symbols)) undetermined(name + " moves, so that nothing rests.");
  }
}

/// Z with A Z = 0: for each coordinate that is left free a column.
BallMatrix allowed_displacements(BallMatrix a, std::size_t n) {
  const std::size_t m = a.size();
  std::vector<std::size_t> dependent;
  for (std::size_t k = 0; k < m; ++k) {
    std::size_t row = k, column = 0;
    for (std::size_t i = k; i < m; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (std::abs(a[i][j].value()) > std::abs(a[row][column].value())) row = i, column = j;
      }
    }
    if (a[row][column].contains_zero()) undetermined("at the equilibrium they depend on each other.");
    std::swap(a[k], a[row]);
    dependent.push_back(column);
    const Ball pivot = a[k][column];
    for (Ball& entry : a[k]) entry = entry / pivot;
    a[k][column] = Ball(1);
    for (std::size_t i = 0; i < m; ++i) {
      if (i == k) continue;
      const Ball factor = a[i][column];
      for (std::size_t j = 0; j < n; ++j) a[i][j] = a[i][j] - factor * a[k][j];
      a[i][column] = Ball(0);
    }
  }
  BallMatrix z(n, std::vector<Ball>(n - m, Ball(0)));
  std::size_t f = 0;
  for (std::size_t j = 0; j < n; ++j) {
    if (std::ranges::find(dependent, j) != dependent.end()) continue;
    z[j][f] = Ball(1);
    for (std::size_t k = 0; k < m; ++k) z[dependent[k]][f] = -a[k][j];
    ++f;
  }
  return z;
}

class ConstrainedAnalysis {
 public:
  ConstrainedAnalysis(const Dynamics& dynamics, const Reals& parameters)
      : dynamics_(dynamics),
        n_(dynamics.model().degrees_of_freedom()),
        m_(dynamics.model().scene.constraints.size()),
        whole_(with_multipliers_as_coordinates(dynamics.model())),
        statics_(whole_.statics(parameters)),
        constants_(parameters.as<Ball>()) {
    if (!statics_->reduction.ignored.empty())
      undetermined("a coordinate is ignorable, and steady motions under constraints are not computed yet.");
    if (!statics_->potential) undetermined("not all forces have a potential.");
  }

  Modes at(const Reals& parameters, std::vector<double> guess) {
    std::vector<double> y = guess;
    y.resize(2 * n_);
    const auto forces = values_at(dynamics_, multiplier_columns(dynamics_.model()), parameters, 0, y);
    guess.insert(guess.end(), forces.begin(), forces.end());
    place_ = find_equilibrium(whole_, *statics_, constants_, guess, EquilibriumSearch::nearest);
    const std::vector<Ball> k = of(statics_->stiffness);
    const std::vector<Ball> rates = of(statics_->damping);
    if (!std::ranges::all_of(rates, [](const Ball& d) { return d.is_zero(); }))
      undetermined("forces depend on velocities.");
    mass_ = corner(of(statics_->inertia));
    stiffness_ = corner(k);
    BallMatrix slopes(m_);
    for (std::size_t j = 0; j < m_; ++j) {
      for (std::size_t i = 0; i < n_; ++i) slopes[j].push_back(k[(n_ + j) * (n_ + m_) + i]);
    }
    z_ = allowed_displacements(std::move(slopes), n_);
    write_place();
    if (n_ > m_) write_modes();
    write_stability();
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::vector<Ball> of(const CompiledFunction& function) const {
    return evaluated(function, constants_, place_.x);
  }

  /// Of all coordinates, without the multipliers.
  [[nodiscard]] BallMatrix corner(const std::vector<Ball>& all) const {
    BallMatrix result(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) result[i].push_back(all[i * (n_ + m_) + j]);
    }
    return result;
  }

  [[nodiscard]] static std::vector<double> by_rows(const BallMatrix& a) {
    std::vector<double> values;
    for (const auto& row : a) {
      for (const Ball& entry : row) values.push_back(entry.contains_zero() ? 0.0 : entry.value());
    }
    return values;
  }

  /// Z^T a Z
  [[nodiscard]] SquareMatrix<Ball> restricted(const BallMatrix& a) const {
    SquareMatrix<Ball> result(n_ - m_);
    for (std::size_t f = 0; f < result.size(); ++f) {
      for (std::size_t g = 0; g < result.size(); ++g) {
        Ball sum(0);
        for (std::size_t i = 0; i < n_; ++i) {
          for (std::size_t j = 0; j < n_; ++j) sum = sum + z_[i][f] * a[i][j] * z_[j][g];
        }
        result(f, g) = sum;
      }
    }
    return result;
  }

  void write_place() {
    for (std::size_t i = 0; i < n_; ++i) {
      const Ball& x = place_.x[i];
      result_.y.push_back(x.value());
      const bool proven = place_.isolated || x.error() == 0;
      result_.y_error.push_back(proven ? std::optional(x.error()) : std::nullopt);
    }
    result_.y.resize(2 * n_);
    result_.y_error.resize(2 * n_, 0.0);
    result_.mass = by_rows(mass_);
    result_.stiffness = by_rows(stiffness_);
  }

  void write_modes() {
    const SmallMotions motions{restricted(mass_), restricted(stiffness_), SquareMatrix<Ball>(n_ - m_)};
    const Eigensystem<Ball> found = squares(motions);
    if (found.values.size() != n_ - m_) undetermined("no bound of their frequencies could be proven.");
    for (std::size_t first = 0; first < found.values.size(); ++first) {
      std::vector<std::size_t> members;
      for (std::size_t i = 0; i < found.values.size(); ++i) {
        if (found.group[i] == first) members.push_back(i);
      }
      write_group(found, members);
    }
    std::ranges::stable_sort(result_.modes, {}, &Mode::omega);
  }

  void write_group(const Eigensystem<Ball>& found, const std::vector<std::size_t>& members) {
    std::vector<std::vector<ComplexBall>> shapes;
    for (const std::size_t i : members) shapes.push_back(shape_of(found, i));
    if (!shapes.empty()) shapes = echelon_form(std::move(shapes));
    for (std::size_t k = 0; k < members.size(); ++k) {
      Mode mode = mode_of(found.values[members[k]], found.radii[members[k]]);
      mode.multiplicity = members.size();
      for (const ComplexBall& entry : shapes[k]) mode.shape.emplace_back(entry.re.value(), entry.im.value());
      result_.modes.push_back(std::move(mode));
    }
  }

  [[nodiscard]] std::vector<ComplexBall> shape_of(const Eigensystem<Ball>& found, std::size_t i) const {
    std::vector<ComplexBall> shape(n_);
    for (std::size_t j = 0; j < n_; ++j) {
      Ball sum(0);
      for (std::size_t f = 0; f < n_ - m_; ++f) {
        Ball entry = found.vectors(f, i);
        entry.radius += found.bounds[f * found.values.size() + i];
        sum = sum + z_[j][f] * entry;
      }
      shape[j] = ComplexBall(sum);
    }
    return shape;
  }

  [[nodiscard]] static Mode mode_of(const Ball& value, double radius) {
    if (!std::isfinite(radius)) undetermined("no bound of their frequencies could be proven.");
    const Ball lambda(value.middle, radius);
    Mode mode;
    mode.lambda = 0.0;
    mode.kind = ModeKind::neutral;
    mode.omega_error = std::sqrt(lambda.magnitude());
    if (lambda.contains_zero()) return mode;
    const bool grows = lambda.value() < 0;
    const Ball root = sqrt(grows ? -lambda : lambda);
    mode.kind = grows ? ModeKind::growth : ModeKind::oscillation;
    mode.lambda = lambda.value();
    (grows ? mode.rate : mode.omega) = root.value();
    mode.omega_error = grows ? std::nullopt : std::optional(root.error());
    if (grows) mode.rate_error = root.error();
    return mode;
  }

  void write_stability() {
    const auto has = [&](ModeKind kind) {
      return std::ranges::any_of(result_.modes, [&](const Mode& mode) { return mode.kind == kind; });
    };
    result_.stability = Stability::stable;
    if (has(ModeKind::growth)) {
      result_.stability = Stability::unstable;
    } else if (has(ModeKind::neutral)) {
      result_.stability = Stability::neutral;
      result_.undecided =
          "Along the neutral mode the stiffness is zero to within its error: higher terms of the potential "
          "decide.";
    }
  }

  const Dynamics& dynamics_;
  std::size_t n_, m_;
  Dynamics whole_;
  std::shared_ptr<const Statics> statics_;
  std::vector<Ball> constants_;
  Equilibrium place_;
  BallMatrix mass_, stiffness_, z_;
  Modes result_;
};

}  // namespace

Modes constrained_modes(const Dynamics& dynamics, const Reals& parameters, const Reals& initial,
                        const std::optional<std::vector<double>>& guess) {
  check_constraints(dynamics.model());
  if (!dynamics.model().scene.inputs.empty()) undetermined("inputs act on it.");
  if (dynamics.kinks() != nullptr) undetermined("an abs() or a sign() stands in its forces.");
  if (has_forces_of_multipliers(dynamics.model().lagrangian))
    undetermined("a force depends on their reactions, as friction does.");
  const std::size_t n = dynamics.model().degrees_of_freedom();
  const std::vector<double> start(initial.begin(), initial.begin() + static_cast<std::ptrdiff_t>(n));
  return ConstrainedAnalysis(dynamics, parameters).at(parameters, guess.value_or(start));
}

}  // namespace qdot
