#include "core/steady/constrained_equilibria.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/steady/constrained_modes.hpp"
#include "core/steady/mode_search.hpp"
#include "core/steady/region_sentences.hpp"

namespace qdot {
namespace {

constexpr const char* no_place_holds =
    "In the region that was searched there is no place where the constraints hold and the forces along them "
    "vanish.";

class ConstrainedSearch {
 public:
  explicit ConstrainedSearch(const SurfaceProblem& problem)
      : problem_(problem), total_(problem.y.size() / 2 - problem.whole.constraints) {}

  ConstrainedEquilibria run() {
    ConstrainedEquilibria result{steady_places(*problem_.whole.dynamics, problem_.steady, problem_.y), {}};
    if (result.found.states.empty() && result.found.complete) result.found.reason = no_place_holds;
    std::erase_if(result.found.free, [&](std::size_t i) { return i >= total_; });
    std::erase_if(result.found.states,
                  [&](const SteadyState& state) { return leave_out(state, result.found); });
    for (SteadyState& state : result.found.states) {
      leave_coordinates(state.y);
      leave_coordinates(state.errors);
      state.residual = std::nan("");
      result.multipliers.push_back(multipliers_of(state));
    }
    return result;
  }

 private:
  /// As equilibria() does: what rests where the mass matrix has no inverse is not known.
  bool leave_out(const SteadyState& state, Equilibria& found) const try {
    const auto q = std::span(state.enclosure).first(problem_.whole.coordinates);
    if (has_inertia_on_surface(problem_.whole, problem_.constants, q, state.y)) return false;
    const Scene& scene = problem_.whole.dynamics->model().scene;
    found.complete = false;
    found.reason +=
        (found.reason.empty() ? "" : " ") + without_inertia(scene, problem_.steady, state.enclosure);
    return true;
  } catch (const Error&) {  // the constraints depend on each other there, which its stability tells
    return false;
  }

  /// Of (q, lambda) and its rates those of q.
  void leave_coordinates(std::vector<double>& y) const {
    const auto from = [&](std::size_t i) { return y.begin() + static_cast<std::ptrdiff_t>(i); };
    y.erase(from(2 * total_ + problem_.whole.constraints), y.end());
    y.erase(from(total_), from(total_ + problem_.whole.constraints));
  }

  /// Writes the stability, too.
  std::optional<std::vector<Ball>> multipliers_of(SteadyState& state) const {
    if (!state.simple) {
      state.stability.undecided = "The forces on the surface have a multiple zero there, or several.";
      return std::nullopt;
    }
    const std::size_t n = problem_.whole.coordinates;
    try {
      const SurfaceModes found =
          surface_modes_at(problem_.whole, problem_.constants, std::span(state.enclosure).first(n), state.y);
      state.stability = found.stability;
      state.residual = residual(found.place);
      return std::vector(found.place.x.begin() + static_cast<std::ptrdiff_t>(n), found.place.x.end());
    } catch (const Error& error) {
      state.stability.undecided = error.what();
      return std::nullopt;
    }
  }

  /// Largest |g_i - sum of lambda_j A_ji| in the middle of the enclosure.
  [[nodiscard]] double residual(const Equilibrium& place) const {
    std::vector<Ball> middle;
    for (const Ball& x : place.x) middle.emplace_back(x.value());
    const SurfaceStatics& whole = problem_.whole;
    const std::vector<Ball> forces = evaluated(whole.statics->forces, problem_.constants, middle);
    double largest = 0;
    for (std::size_t i = 0; i < whole.coordinates; ++i)
      largest = std::max(largest, std::abs(forces[i].value()));
    return largest;
  }

  const SurfaceProblem& problem_;
  std::size_t total_;  ///< coordinates of the scene
};

}  // namespace

ConstrainedEquilibria constrained_equilibria(const Dynamics& dynamics, const Reals& parameters,
                                             const Reals& y) {
  return constrained_equilibria(surface_problem(dynamics, parameters, y));
}

ConstrainedEquilibria constrained_equilibria(const SurfaceProblem& problem) {
  return ConstrainedSearch(problem).run();
}

}  // namespace qdot
