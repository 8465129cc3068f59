#include "core/steady/constrained_modes.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/dynamics/consistent_state.hpp"
#include "core/steady/inertia.hpp"
#include "core/steady/mode_matrices.hpp"
#include "core/steady/mode_search.hpp"
#include "core/steady/mode_shapes.hpp"
#include "core/steady/model_conditions.hpp"
#include "core/steady/rolling_modes.hpp"
#include "core/steady/steady_forces.hpp"
#include "core/steady/steady_rolling.hpp"
#include "core/steady/surface_descent.hpp"

namespace qdot {
namespace {

constexpr const char* no_stiffness =
    "Along a neutral mode the stiffness is zero to within its error: higher terms of the potential decide.";

/// Newton's iteration from where a way down has ended goes no farther, in parts of the sizes or of the way.
constexpr double next_to_low = 1e-3;

constexpr const char* no_drive = "Every place is an equilibrium: nothing drives the system back or away.";

class SurfaceAnalysis {
 public:
  SurfaceAnalysis(const SurfaceStatics& whole, const std::vector<Ball>& constants,
                  const std::vector<double>& y)
      : whole_(whole), n_(whole.coordinates), m_(whole.constraints), constants_(constants), y_(y) {}

  SurfaceModes near(const std::vector<double>& guess) {
    place_ = equilibrium_near(*whole_.dynamics, *whole_.statics, constants_, guess);
    return about_place(solved_slopes(slopes(), n_));
  }

  [[nodiscard]] bool constraints_are_independent(std::span<const Interval> q) {
    put(q);
    try {
      return solved_slopes(slopes(), n_).dependent.size() == m_;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::not_applicable) throw;
      return false;
    }
  }

  /// Whether what the constraints leave of the mass matrix has an inverse.
  bool has_inertia(std::span<const Interval> q) {
    put(q);
    z_ = solved_slopes(slopes(), n_).allowed;
    const SquareMatrix<Ball> mass = restricted(matrix(whole_.statics->inertia));
    const Inertia inertia = inertia_of(intervals(mass), mass.size());
    return inertia.undecided == 0 || inertia.negative > 0;
  }

  SurfaceModes at(std::span<const Interval> q) {
    put(q);
    const std::vector<Ball> g = of(whole_.statics->forces);
    SolvedSlopes a = solved_slopes(slopes(), n_);
    for (std::size_t j = 0; j < m_; ++j) {
      // Row n + j of the forces is -phi_j, so that the slopes are -A.
      Ball lambda(0);
      for (std::size_t k = 0; k < m_; ++k) lambda = lambda - a.inverse[k][j] * g[a.dependent[k]];
      place_.x[n_ + j] = lambda;
    }
    return about_place(std::move(a));
  }

 private:
  [[nodiscard]] const Reduction& reduction() const { return whole_.statics->reduction; }
  [[nodiscard]] std::size_t total() const { return y_.size() / 2; }
  [[nodiscard]] std::vector<Ball> of(const CompiledFunction& function) const {
    return evaluated(function, constants_, place_.x);
  }
  /// The part of a function's matrix that belongs to the coordinates, without the multipliers.
  [[nodiscard]] SquareMatrix<Ball> matrix(const CompiledFunction& function) const {
    return square_matrix(of(function), n_, n_ + m_);
  }

  [[nodiscard]] BallMatrix slopes() const {
    const std::vector<Ball> k = of(whole_.statics->stiffness);
    BallMatrix result(m_);
    for (std::size_t j = 0; j < m_; ++j) {
      for (std::size_t i = 0; i < n_; ++i) result[j].push_back(k[(n_ + j) * (n_ + m_) + i]);
    }
    return result;
  }

  /// Without multipliers, on which neither slopes nor masses depend.
  void put(std::span<const Interval> q) {
    place_ = {};
    place_.isolated = true;
    for (const Interval& x : q) place_.x.push_back(Ball::of(x));
    place_.x.resize(n_ + m_, Ball(0));
  }

  [[nodiscard]] static std::vector<Interval> intervals(const SquareMatrix<Ball>& a) {
    std::vector<Interval> entries;
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < a.size(); ++j) entries.push_back(a(i, j).interval());
    }
    return entries;
  }

  SurfaceModes about_place(SolvedSlopes a) {
    z_ = std::move(a.allowed);
    const Statics& statics = *whole_.statics;
    const SmallMotions kept{matrix(statics.inertia), matrix(statics.stiffness), matrix(statics.damping)};
    const SmallMotions on_surface{restricted(kept.mass), restricted(kept.stiffness), restricted(kept.rates)};
    const SmallMotions all = statics.linearized ? of_all(of(*statics.linearized)) : kept;
    write_place();
    std::tie(result_.mass, result_.stiffness, result_.gyroscopic, result_.damping) = matrices_by_rows(all);
    const Linearization linearization{statics, constants_, place_, total(), on_surface, all, z_};
    result_.modes = modes_of(linearization);
    SteadyStability stability =
        stability_of(on_surface, first_components(directions_of_family(linearization)));
    result_.stability = stability.stability;
    if (std::ranges::all_of(result_.modes, [](const Mode& mode) { return mode.kind == ModeKind::rigid; }))
      stability.undecided = no_drive;
    result_.undecided = stability.undecided;
    return {std::move(result_), std::move(stability), std::move(place_)};
  }

  [[nodiscard]] SmallMotions of_all(const std::vector<Ball>& linearized) const {
    const std::size_t width = total() + m_;
    const auto part = [&](std::size_t k) {
      return square_matrix(linearized, total(), width, k * width * width);
    };
    return {part(0), part(1), part(2)};
  }

  /// Z^T a Z
  [[nodiscard]] SquareMatrix<Ball> restricted(const SquareMatrix<Ball>& a) const {
    SquareMatrix<Ball> result(n_ - m_);
    for (std::size_t f = 0; f < result.size(); ++f) {
      for (std::size_t g = 0; g < result.size(); ++g) {
        Ball sum(0);
        for (std::size_t i = 0; i < n_; ++i) {
          for (std::size_t j = 0; j < n_; ++j) sum = sum + z_[i][f] * a(i, j) * z_[j][g];
        }
        result(f, g) = sum;
      }
    }
    return result;
  }

  void write_place() {
    result_.y = y_;
    result_.y_error.assign(y_.size(), 0.0);
    const auto put = [&](std::size_t i, const Ball& value) {
      if (!value.is_finite()) undetermined_on_surface("a steady rate has no finite value there.");
      result_.y[i] = value.value();
      const bool proven = place_.isolated || value.error() == 0;
      result_.y_error[i] = proven ? std::optional(value.error()) : std::nullopt;
    };
    for (std::size_t i = 0; i < n_; ++i) {
      put(reduction().kept[i], place_.x[i]);
      result_.y[total() + reduction().kept[i]] = 0;
    }
    const std::vector<Ball> rates = of(whole_.statics->ignored_rates);
    for (std::size_t c = 0; c < rates.size(); ++c) put(total() + reduction().ignored[c], rates[c]);
    for (const std::size_t i : place_.held)
      if (i < n_) result_.held.push_back(reduction().kept[i]);
  }

  /// `drifting`: displacements that stand for those along which nothing drives back.
  [[nodiscard]] SteadyStability stability_of(const SmallMotions& motions,
                                             std::vector<std::size_t> drifting) const {
    const Model& model = whole_.dynamics->model();
    SteadyStability result = linear_stability(
        {motions.size(), intervals(motions.mass), intervals(motions.rates), intervals(motions.stiffness),
         is_gradient(model, *whole_.statics), has_potential(model, *whole_.statics), std::move(drifting)},
        [] { return no_stiffness; });
    return result;
  }

  const SurfaceStatics& whole_;
  std::size_t n_, m_;
  const std::vector<Ball>& constants_;
  const std::vector<double>& y_;
  Equilibrium place_;
  BallMatrix z_;
  Modes result_;
};

/// Where the search for a steady motion near the state y = (q, q') begins: x = (q, lambda).
std::vector<double> guess_on_surface(const SurfaceStatics& whole, const Dynamics& dynamics,
                                     const Reals& parameters, const std::vector<Ball>& constants,
                                     std::vector<double> y) {
  const Reduction& reduction = whole.statics->reduction;
  const std::size_t total = y.size() / 2;
  std::vector<Interval> q;
  for (std::size_t k = 0; k < whole.coordinates; ++k) q.emplace_back(y[reduction.kept[k]]);
  if (!SurfaceAnalysis(whole, constants, y).constraints_are_independent(q))
    refuse_dependent_constraints(dynamics.model().scene);
  for (std::size_t k = 0; k < whole.coordinates; ++k) y[total + reduction.kept[k]] = 0;
  const std::vector<double> all = with_multipliers(dynamics, parameters, y);
  std::vector<double> guess;
  for (const std::size_t k : reduction.kept) guess.push_back(all[k]);
  return guess;
}

/// Whether the model holds there.
bool is_valid(const Dynamics& dynamics, const Reals& parameters, const Modes& found) {
  const Scene& scene = dynamics.model().scene;
  for (std::size_t i = 0; i < scene.coordinates.size(); ++i)
    if (!scene.coordinates[i].domain.contains(found.y[i])) return false;
  if (scene.valid_while.empty()) return true;
  std::vector<Ball> state;
  for (std::size_t i = 0; i < found.y.size(); ++i)
    state.emplace_back(DoubleDouble(found.y[i]), found.y_error[i].value_or(0));
  return conditions_hold(model_conditions(dynamics, parameters.as<Ball>(), state));
}

/// About the equilibrium downhill of `start`, where one is there.
std::optional<Modes> modes_downhill(const SurfaceStatics& whole, const std::vector<Ball>& constants,
                                    const std::vector<double>& y, const std::vector<double>& start) {
  std::vector<double> numbers;
  for (const Ball& c : constants) numbers.push_back(c.value());
  const auto low = lowest_downhill(whole, numbers, start);
  if (!low) return std::nullopt;
  try {
    Modes found = SurfaceAnalysis(whole, constants, y).near(low->x).modes;
    for (std::size_t k = 0; k < whole.coordinates; ++k) {
      const double there = found.y[whole.statics->reduction.kept[k]];
      const double size = std::max(low->sizes[k], std::abs(low->x[k] - start[k]));
      if (!(std::abs(there - low->x[k]) < next_to_low * size)) return std::nullopt;
    }
    found.arrival = Arrival::downhill;
    return found;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::not_applicable) throw;
    return std::nullopt;
  }
}

}  // namespace

bool has_inertia_on_surface(const SurfaceStatics& whole, const std::vector<Ball>& constants,
                            std::span<const Interval> x, const std::vector<double>& y) {
  return SurfaceAnalysis(whole, constants, y).has_inertia(x);
}

SurfaceModes surface_modes_at(const SurfaceStatics& whole, const std::vector<Ball>& constants,
                              std::span<const Interval> x, const std::vector<double>& y) {
  return SurfaceAnalysis(whole, constants, y).at(x);
}

Modes constrained_modes(const Dynamics& dynamics, const Reals& parameters, const Reals& initial,
                        const std::optional<std::vector<double>>& guess) {
  if (has_constraint_in_velocities(dynamics.model()))
    return rolling_modes(dynamics, parameters, initial, guess);
  const SurfaceStatics whole = surface_statics(dynamics, parameters);
  std::vector<double> y(initial.begin(), initial.end());
  if (guess) std::ranges::copy(*guess, y.begin());
  const std::vector<Ball> constants = constants_on_surface(whole, dynamics, parameters, initial);
  const std::vector<double> start = guess_on_surface(whole, dynamics, parameters, constants, y);
  if (!guess) {
    auto found = modes_downhill(whole, constants, y, start);
    if (found && is_valid(dynamics, parameters, *found)) return *std::move(found);
  }
  Modes found = SurfaceAnalysis(whole, constants, y).near(start).modes;
  if (!guess) found.arrival = Arrival::newton;
  return found;
}

}  // namespace qdot
