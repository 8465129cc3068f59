#include "core/steady/modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/error.hpp"
#include "core/base/short_number.hpp"
#include "core/dynamics/missing_values.hpp"
#include "core/steady/cones.hpp"
#include "core/steady/free_direction.hpp"
#include "core/steady/inertia.hpp"
#include "core/steady/mode_matrices.hpp"
#include "core/steady/mode_search.hpp"
#include "core/steady/steady_forces.hpp"

namespace qdot {
namespace {

using Balls = std::vector<Ball>;

class Analysis {
 public:
  Analysis(const Dynamics& dynamics, const Reals& parameters, const Reals& initial)
      : dynamics_(dynamics),
        statics_(dynamics.statics(parameters)),
        parameters_(parameters),
        constants_(parameters.as<Ball>()),
        start_(initial),
        y_(initial.begin(), initial.end()) {
    smooth_ = dynamics.derived<SmoothForces>(
        "smooth forces", parameters, [](const Statics& statics) { return derive_smooth_forces(statics); });
    Balls at = initial.as<Ball>();
    for (const std::size_t k : statics_->reduction.kept) {
      y_[total() + k] = 0;  // steady motions are at rest
      start_.set(total() + k, 0);
      at[total() + k] = 0;
    }
    add_momenta(at);
    refuse_dry_friction(dynamics, parameters, vanishing_momenta());
  }

  Modes at(const std::optional<std::vector<double>>& given) {
    std::vector<double> guess;
    for (const std::size_t k : statics_->reduction.kept) guess.push_back(given ? (*given)[k] : y_[k]);
    place_ = found_from(guess, given.has_value());
    refuse_kink();
    for (std::size_t c : statics_->reduction.ignored) y_[c] = given ? (*given)[c] : y_[c];
    const std::size_t n = statics_->reduction.degrees_of_freedom();
    reduced_ = {matrix(statics_->inertia, n), matrix(statics_->stiffness, n), matrix(statics_->damping, n)};
    whole_ = reduced_;
    if (statics_->linearized) {
      const Balls all = evaluated(*statics_->linearized, constants_, place_.x);
      const std::size_t entries = total() * total();
      whole_ = {square_matrix(all, total(), total()), square_matrix(all, total(), total(), entries),
                square_matrix(all, total(), total(), 2 * entries)};
    }
    write_state();
    refuse_missing();
    std::tie(result_.mass, result_.stiffness, result_.gyroscopic, result_.damping) = matrices_by_rows(whole_);
    write_modes();
    write_stability();
    return std::move(result_);
  }

 private:
  /// Newton's iteration does not end at a kink or a cone; where there are some, that may be why.
  [[nodiscard]] Equilibrium found_from(const std::vector<double>& guess, bool is_given) {
    try {
      if (is_given) return equilibrium_near(dynamics_, *statics_, constants_, guess);
      auto found = equilibrium_downhill(dynamics_, *statics_, *smooth_, constants_, guess);
      result_.arrival = found.arrival;
      return std::move(found.place);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::not_applicable) throw;
      const SteadyProblem problem = steady_problem(dynamics_, parameters_, start_);
      refuse_cones(problem, guess);
      if (problem.forces->smooth.kinks() == 0 && dynamics_.kinks() == nullptr) throw;
      throw Error(error.code(), std::string(error.what()) +
                                    " An abs() or a sign() in the forces has kinks; an equilibrium at one "
                                    "has no modes, and 'equilibria' lists it.");
    }
  }

  /// The system rests at one that holds it, wherever the search began; of others 'equilibria' knows more.
  void refuse_cones(const SteadyProblem& problem, const std::vector<double>& guess) const {
    for (const Cone& cone : cones_of(problem)) {
      std::vector<double> place = guess;
      bool is_guessed = true;
      for (std::size_t j = 0; j < cone.place.size(); ++j) {
        double& x = place[problem.forces->unknowns[j]];
        is_guessed = is_guessed && cone.place[j].contains(x);
        x = cone.place[j].middle();
      }
      if (cone.what != AtCone::held && !is_guessed) continue;
      throw Error(
          ErrorCode::not_applicable,
          "At " + written(place) + " a distance in the forces is 0, where they have no single " +
              "direction: " + (cone.what == AtCone::held ? "the system rests there, but " : "") +
              "small motions have no frequency. 'equilibria' says " +
              (cone.what == AtCone::held ? "whether it is stable." : "whether the system rests there."));
    }
  }

  /// A place of the kept coordinates.
  [[nodiscard]] std::string written(std::span<const double> x) const {
    std::string place;
    for (std::size_t i = 0; i < x.size(); ++i)
      place += (i == 0 ? "" : ", ") + dynamics_.model().scene.coordinates[reduction().kept[i]].name + " = " +
               short_number(x[i], 6);
    return place;
  }

  void refuse_kink() const {
    Balls variables = place_.x;
    variables.resize(variables.size() + smooth_->kinks());
    for (std::size_t k = 0; k < smooth_->kinks(); ++k)
      variables[place_.x.size() + k] = Ball(DoubleDouble{}, 1);
    for (const Ball& u : evaluated(smooth_->arguments, constants_, variables)) {
      if (!u.contains_zero()) continue;
      throw Error(ErrorCode::not_applicable,
                  "At this equilibrium an abs() or a sign() in the forces has its kink, so that they have no "
                  "slope there and small motions no frequency; 'equilibria' says whether it is stable.");
    }
  }

  /// Where the potential has no value, such as log(x) where x < 0, its slope may have one, and vanish.
  void refuse_missing() const {
    constexpr double rounding = std::numeric_limits<double>::epsilon();
    Reals y;
    for (const double x : result_.y) y.push_back({x, 0, rounding * std::abs(x)});
    const std::string names = missing_values(dynamics_.model(), parameters_, std::nullopt, y);
    if (names.empty()) return;
    std::vector<double> place;
    for (const std::size_t i : reduction().kept) place.push_back(result_.y[i]);
    throw Error(ErrorCode::not_applicable, "The forces vanish at " + written(place) +
                                               ", but there is no finite value of " + names +
                                               " there, so that nothing can rest. 'equilibria' lists where "
                                               "something does.");
  }

  [[nodiscard]] std::size_t total() const { return y_.size() / 2; }
  [[nodiscard]] const Reduction& reduction() const { return statics_->reduction; }
  [[nodiscard]] SquareMatrix<Ball> matrix(const CompiledFunction& function, std::size_t n) const {
    return square_matrix(evaluated(function, constants_, place_.x), n, n);
  }

  void add_momenta(const Balls& y) {
    if (reduction().ignored.empty()) return;
    const auto momenta = dynamics_.columns(momentum_columns(dynamics_.model(), reduction().ignored));
    const Balls p = evaluated(*momenta, constants_, y);
    constants_.insert(constants_.end(), p.begin(), p.end());
    for (const Ball& momentum : p) result_.momenta.emplace_back(momentum.value(), 0, momentum.error());
  }

  [[nodiscard]] std::vector<bool> vanishing_momenta() const {
    std::vector<bool> vanishing;
    for (const Ball& p : std::span(constants_).last(reduction().ignored.size()))
      vanishing.push_back(p.value() == 0 && p.error() == 0);
    return vanishing;
  }

  void write_state() {
    result_.y = y_;
    result_.y_error.assign(y_.size(), 0.0);
    for (std::size_t i = 0; i < reduction().kept.size(); ++i) put(reduction().kept[i], place_.x[i]);
    const Balls rates = evaluated(statics_->ignored_rates, constants_, place_.x);
    for (std::size_t c = 0; c < rates.size(); ++c) put(total() + reduction().ignored[c], rates[c]);
    for (const std::size_t i : place_.held) result_.held.push_back(reduction().kept[i]);
  }
  void put(std::size_t i, const Ball& value) {
    if (!value.is_finite()) throw Error(ErrorCode::invalid_state, "A steady rate has no finite value there.");
    result_.y[i] = value.value();
    const bool proven = place_.isolated || value.error() == 0;
    result_.y_error[i] = proven ? std::optional(value.error()) : std::nullopt;
  }

  void write_modes() {
    result_.modes = modes_of({*statics_, constants_, place_, total(), reduced_, whole_, {}});
  }

  void write_stability() {
    const auto has = [&](ModeKind kind) {
      return std::any_of(result_.modes.begin(), result_.modes.end(),
                         [&](const Mode& mode) { return mode.kind == kind; });
    };
    const bool is_freed = std::ranges::any_of(result_.modes, is_freed_from_damping);
    result_.stability = Stability::neutral;
    if (has(ModeKind::growth)) {
      result_.stability = Stability::unstable;
    } else if (std::ranges::any_of(result_.modes, [](const Mode& mode) {
                 return mode.kind == ModeKind::oscillation && mode.rate_error.value_or(0) > 0;
               })) {
      result_.undecided =
          "An eigenvalue lies on the imaginary axis to within its error: whether that motion grows or decays "
          "is not decided.";
    } else if (has(ModeKind::neutral) && !energy_decides()) {
      result_.undecided =
          "The linearized equations have the eigenvalue 0 to within the rounding of the parameters, and the forces "
          "have no potential that would decide: whether small motions grow is not looked at.";
    } else if (has(ModeKind::neutral)) {
      result_.undecided =
          "Along the neutral mode the stiffness is zero to within the rounding of the parameters: higher "
          "terms of the potential decide.";
    } else if (!has(ModeKind::oscillation) && !has(ModeKind::decay)) {
      result_.undecided = "Every place is an equilibrium: nothing drives the system back or away.";
    } else if (has(ModeKind::oscillation) && reduced_.undamped() && !has_one_sign(reduced_.mass)) {
      const bool is_exact = are_apart() && has_linear_equations(*statics_);
      result_.stability = is_exact ? Stability::stable : Stability::neutral;
      if (!is_exact) result_.undecided = two_signs;
    } else if (reduced_.undamped() && !reduced_.depends_on_squares() && minimum() != Minimum::proven) {
      result_.undecided =
          std::string(minimum() == Minimum::none
                          ? "The potential has no minimum here; gyroscopic"
                          : "Whether the potential has a minimum here is not decided; gyroscopic") +
          " terms hold the system to first order, and linearization does not decide.";
    } else if (is_freed && !reduced_.undamped() && !reduced_.depends_on_squares()) {
      write_stability_beside_damping();
    } else if (has(ModeKind::oscillation) && !energy_decides() && !frequencies_are_apart()) {
      result_.undecided =
          "Frequencies of small motions are one to within their errors, and the forces have no potential: by "
          "them one motion may drive another, and whether small motions grow is not decided.";
    } else if (has(ModeKind::oscillation) && !energy_decides()) {
      result_.undecided =
          "Small motions neither grow nor decay to first order, and the forces have no potential that would "
          "decide: they are not the gradient of one, or depend on velocities.";
    } else {
      result_.stability = Stability::stable;
    }
  }

  static bool is_freed_from_damping(const Mode& mode) {
    return mode.kind == ModeKind::oscillation && !mode.rate_error;
  }

  /// With simple eigenvalues, none of them 0: else what oscillates or drifts may drive what has no damping.
  [[nodiscard]] bool are_apart() const {
    const auto is_rigid = [](const Mode& mode) { return mode.kind == ModeKind::rigid; };
    return std::ranges::none_of(result_.modes, is_rigid) && frequencies_are_apart();
  }

  [[nodiscard]] bool frequencies_are_apart() const {
    std::optional<Interval> last;
    for (const Mode& mode : result_.modes) {
      if (mode.kind != ModeKind::oscillation) continue;
      if (mode.multiplicity > 1 || !mode.omega_error) return false;
      const Interval omega = Interval(mode.omega) + Interval(-*mode.omega_error, *mode.omega_error);
      if (last && !(last->upper < omega.lower)) return false;
      last = omega;
    }
    return true;
  }

  void write_stability_beside_damping() {
    result_.undecided = "What damps the system does nothing along the mode that oscillates: ";
    if (!are_apart()) {
      result_.undecided +=
          "by itself it neither grows nor decays. Whether another that oscillates or drifts drives it is not "
          "looked at.";
    } else if (has_linear_equations(*statics_)) {
      result_.stability = Stability::stable;
      result_.undecided +=
          "it neither grows nor decays, and the equations of motion are linear, so that this is exact.";
    } else {
      result_.undecided += "to first order it neither grows nor decays, and nonlinear terms decide.";
    }
  }

  [[nodiscard]] bool energy_decides() const {
    struct Potential {
      bool exists{};
    };
    return dynamics_
        .derived<Potential>(
            "potential of small motions", parameters_,
            [&](const Statics& statics) { return Potential{has_potential(dynamics_.model(), statics)}; })
        ->exists;
  }

  /// Of the potential, along the directions that are not rigid.
  enum class Minimum { proven, none, unknown };
  [[nodiscard]] Minimum minimum() const {
    const SmallMotions at_rest{reduced_.mass, reduced_.stiffness, SquareMatrix<Ball>(reduced_.size())};
    const Eigensystem<Ball> found = squares(at_rest);
    std::size_t positive = 0;
    for (std::size_t i = 0; i < found.values.size(); ++i) {
      const double lambda = found.values[i].middle.high;
      if (lambda < -found.radii[i]) return Minimum::none;
      if (lambda > found.radii[i]) ++positive;
    }
    const auto is_rigid = [](const Mode& mode) { return mode.kind == ModeKind::rigid; };
    const auto rigid = static_cast<std::size_t>(std::ranges::count_if(result_.modes, is_rigid));
    return positive + rigid == total() ? Minimum::proven : Minimum::unknown;
  }

  const Dynamics& dynamics_;
  std::shared_ptr<const Statics> statics_;
  std::shared_ptr<const SmoothForces> smooth_;
  Reals parameters_;
  Balls constants_;
  Reals start_;  ///< `initial` with the kept coordinates at rest
  std::vector<double> y_;
  Equilibrium place_;
  SmallMotions reduced_{SquareMatrix<Ball>(0), SquareMatrix<Ball>(0), SquareMatrix<Ball>(0)};
  SmallMotions whole_ = reduced_;
  Modes result_;
};

}  // namespace

const char* name(Stability stability) {
  switch (stability) {
    case Stability::stable:
      return "stable";
    case Stability::unstable:
      return "unstable";
    case Stability::neutral:
      break;
  }
  return "neutral";
}

Modes normal_modes(const Dynamics& dynamics, const Reals& parameters, const Reals& initial,
                   const std::optional<std::vector<double>>& guess) {
  return Analysis(dynamics, parameters, initial).at(guess);
}

}  // namespace qdot
