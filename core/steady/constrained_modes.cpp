#include "core/steady/constrained_modes.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/steady/mode_search.hpp"
#include "core/steady/rolling_modes.hpp"
#include "core/steady/steady_rolling.hpp"

namespace qdot {
namespace {

class SurfaceAnalysis {
 public:
  SurfaceAnalysis(const SurfaceStatics& whole, const Reals& parameters)
      : whole_(whole), n_(whole.coordinates), m_(whole.constraints), constants_(parameters.as<Ball>()) {
    if (!whole.statics->potential) undetermined_on_surface("not all forces have a potential.");
  }

  SurfaceModes near(const std::vector<double>& guess) {
    place_ =
        find_equilibrium(*whole_.dynamics, *whole_.statics, constants_, guess, EquilibriumSearch::nearest);
    return about_place(solved_slopes(slopes(), n_));
  }

  SurfaceModes at(std::span<const Interval> q) {
    place_.isolated = true;
    for (const Interval& x : q) place_.x.push_back(Ball::of(x));
    place_.x.resize(n_ + m_, Ball(0));
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
  [[nodiscard]] std::vector<Ball> of(const CompiledFunction& function) const {
    return evaluated(function, constants_, place_.x);
  }

  [[nodiscard]] BallMatrix slopes() const {
    const std::vector<Ball> k = of(whole_.statics->stiffness);
    BallMatrix result(m_);
    for (std::size_t j = 0; j < m_; ++j) {
      for (std::size_t i = 0; i < n_; ++i) result[j].push_back(k[(n_ + j) * (n_ + m_) + i]);
    }
    return result;
  }

  SurfaceModes about_place(SolvedSlopes a) {
    const std::vector<Ball> rates = of(whole_.statics->damping);
    if (!std::ranges::all_of(rates, [](const Ball& d) { return d.is_zero(); }))
      undetermined_on_surface("forces depend on velocities.");
    mass_ = corner(of(whole_.statics->inertia));
    stiffness_ = corner(of(whole_.statics->stiffness));
    z_ = std::move(a.allowed);
    write_place();
    if (n_ > m_) write_modes();
    write_stability();
    return {std::move(result_), std::move(place_)};
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
    if (found.values.size() != n_ - m_)
      undetermined_on_surface("no bound of their frequencies could be proven.");
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
    if (!std::isfinite(radius)) undetermined_on_surface("no bound of their frequencies could be proven.");
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

  const SurfaceStatics& whole_;
  std::size_t n_, m_;
  std::vector<Ball> constants_;
  Equilibrium place_;
  BallMatrix mass_, stiffness_, z_;
  Modes result_;
};

}  // namespace

SurfaceModes surface_modes(const SurfaceStatics& whole, const Reals& parameters,
                           const std::vector<double>& guess) {
  return SurfaceAnalysis(whole, parameters).near(guess);
}

SurfaceModes surface_modes_at(const SurfaceStatics& whole, const Reals& parameters,
                              std::span<const Interval> q) {
  return SurfaceAnalysis(whole, parameters).at(q);
}

Modes constrained_modes(const Dynamics& dynamics, const Reals& parameters, const Reals& initial,
                        const std::optional<std::vector<double>>& guess) {
  if (has_constraint_in_velocities(dynamics.model()))
    return rolling_modes(dynamics, parameters, initial, guess);
  const SurfaceStatics whole = surface_statics(dynamics, parameters);
  const std::vector<double> start(initial.begin(),
                                  initial.begin() + static_cast<std::ptrdiff_t>(whole.coordinates));
  return surface_modes(whole, parameters, with_multipliers(dynamics, parameters, guess.value_or(start)))
      .modes;
}

}  // namespace qdot
