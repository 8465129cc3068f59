#include "core/steady/constrained_equilibria.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/numerics/constants.hpp"
#include "core/steady/constrained_modes.hpp"
#include "core/steady/mode_search.hpp"
#include "core/steady/surface_forces.hpp"

namespace qdot {
namespace {

class ConstrainedSearch {
 public:
  ConstrainedSearch(const Dynamics& dynamics, const Reals& parameters)
      : parameters_(parameters), whole_(surface_statics(dynamics, parameters)), n_(whole_.coordinates) {}

  ConstrainedEquilibria from(const Reals& y) {
    refuse_dry_friction(*whole_.dynamics, parameters_, {});
    const SteadyProblem problem{whole_.statics,
                                std::make_shared<const SteadyForces>(derive_surface_forces(whole_)),
                                {parameters_.begin(), parameters_.end()},
                                parameters_.as<Interval>()};
    std::vector<double> start(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n_));
    start.resize(2 * (n_ + whole_.constraints));
    ConstrainedEquilibria result{steady_places(*whole_.dynamics, problem, start), {}};
    std::erase_if(result.found.free, [&](std::size_t i) { return i >= n_; });
    for (SteadyState& state : result.found.states) {
      leave_coordinates(state.y);
      leave_coordinates(state.errors);
      state.residual = std::nan("");
      result.multipliers.push_back(multipliers_of(state));
    }
    return result;
  }

 private:
  /// Of (q, lambda) and its rates those of q.
  void leave_coordinates(std::vector<double>& y) const {
    const auto from = [&](std::size_t i) { return y.begin() + static_cast<std::ptrdiff_t>(i); };
    y.erase(from(2 * n_ + whole_.constraints), y.end());
    y.erase(from(n_), from(n_ + whole_.constraints));
  }

  /// Writes the stability, too.
  std::optional<std::vector<Ball>> multipliers_of(SteadyState& state) const {
    if (!state.simple) {
      state.stability.undecided = "The forces on the surface have a multiple zero there, or several.";
      return std::nullopt;
    }
    try {
      const SurfaceModes found = surface_modes_at(whole_, parameters_, std::span(state.enclosure).first(n_));
      write_stability(found.modes, state.stability);
      state.residual = residual(found.place);
      return std::vector(found.place.x.begin() + static_cast<std::ptrdiff_t>(n_), found.place.x.end());
    } catch (const Error& error) {
      state.stability.undecided = error.what();
      return std::nullopt;
    }
  }

  /// Largest |g_i - sum of lambda_j A_ji| in the middle of the enclosure.
  [[nodiscard]] double residual(const Equilibrium& place) const {
    std::vector<Ball> middle;
    for (const Ball& x : place.x) middle.emplace_back(x.value());
    const std::vector<Ball> forces = evaluated(whole_.statics->forces, parameters_.as<Ball>(), middle);
    double largest = 0;
    for (std::size_t i = 0; i < n_; ++i) largest = std::max(largest, std::abs(forces[i].value()));
    return largest;
  }

  static void write_stability(const Modes& modes, SteadyStability& stability) {
    stability.stability = modes.stability;
    stability.undecided = modes.undecided;
    for (const Mode& mode : modes.modes) {
      const double error = mode.rate_error ? *mode.rate_error : mode.omega_error.value_or(infinity);
      for (const double sign : {-1.0, 1.0}) {
        const bool is_growth = mode.kind == ModeKind::growth;
        stability.eigenvalues.push_back(
            {is_growth ? std::complex(sign * mode.rate, 0.0) : std::complex(0.0, sign * mode.omega), error});
      }
    }
    std::ranges::stable_sort(stability.eigenvalues, [](const auto& a, const auto& b) {
      return a.s.real() != b.s.real() ? a.s.real() < b.s.real() : a.s.imag() < b.s.imag();
    });
  }

  const Reals& parameters_;
  SurfaceStatics whole_;
  std::size_t n_;
};

}  // namespace

ConstrainedEquilibria constrained_equilibria(const Dynamics& dynamics, const Reals& parameters,
                                             const Reals& y) {
  return ConstrainedSearch(dynamics, parameters).from(y);
}

}  // namespace qdot
