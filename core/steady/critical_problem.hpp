#pragma once
// A scene at rest while one of its parameters moves, on the surface of its constraints where it has some.
// There the forces have charts (core/steady/surface_forces.hpp), each with systems of its own for critical
// values.

#include <optional>
#include <span>
#include <vector>

#include "core/steady/constrained_equilibria.hpp"
#include "core/steady/critical_zeros.hpp"

namespace qdot {

/// Equations, as many as unknowns, that say the same as all where one of their determinants does not vanish.
struct CriticalChart {
  SteadyProblem problem;  ///< its forces' `equations` are those of the chart
  std::shared_ptr<const BifurcationSystems> systems;
  std::vector<std::size_t> determinants;  ///< which of the forces'; empty: the equations are all there are
};

class CriticalProblem {
 public:
  /// The parameter number `index` moves in `range`. Throws what steady_problem and surface_problem throw, and
  /// Error(not_applicable) for too many systems.
  CriticalProblem(const Dynamics& dynamics, const Reals& parameters, const Reals& y, std::size_t index,
                  const Interval& range);

  /// One at least.
  [[nodiscard]] const std::vector<CriticalChart>& charts() const { return charts_; }
  /// The scene's coordinates that are not ignored.
  [[nodiscard]] const std::vector<std::size_t>& kept() const { return kept_; }
  /// All equilibria with the parameter at p.
  [[nodiscard]] Equilibria at(double p);

  /// All x of a zero of the chart's systems.
  [[nodiscard]] Box place_of(const CriticalChart& chart, const CriticalZero& zero) const;
  enum class Place { here, in_another_chart, singular };
  /// Whether a zero of the chart's systems is the chart's to tell of. Singular: the constraints depend on
  /// each other there, as far as rounding lets one see.
  [[nodiscard]] Place place_in(const CriticalChart& chart, const CriticalZero& zero) const;

 private:
  void follow(std::shared_ptr<const Statics> statics);
  void add_charts(std::shared_ptr<const SteadyForces> forces, const Dynamics& dynamics);

  const Dynamics& dynamics_;
  std::vector<double> y_;
  std::size_t index_;
  SteadyProblem problem_;
  std::optional<SurfaceProblem> surface_;
  std::vector<std::size_t> kept_;
  std::vector<CriticalChart> charts_;
};

}  // namespace qdot
