#include "core/steady/equilibrium.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "core/compile/tape_evaluator.hpp"
#include "core/numerics/constants.hpp"
#include "core/numerics/dense_matrix.hpp"
#include "core/steady/comparable_units.hpp"
#include "core/steady/equilibrium_family.hpp"
#include "core/steady/gradient_flow.hpp"
#include "core/steady/model_conditions.hpp"
#include "core/steady/next_balance.hpp"

namespace qdot {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Near a multiple zero Newton's iteration only shortens the way by some fixed factor a step.
constexpr int most_steps = 200;
constexpr double least_damping = 1e-4;
/// Of a coordinate's size. No step in doubles is shorter.
constexpr double settled = 1e-15;
/// Where the last step is that short, an iteration that no longer improves has arrived.
constexpr double arrived = 1e-6;
/// Newton's iteration from where a way down has ended goes no farther.
constexpr double near_by = 1e-3;
/// Of the forces' derivative: what is below it is rounding.
constexpr double symmetric = 1e-12;
/// Of K's largest stiffness: what is below it counts as none, and steps do not lead along it. The first
/// counts what rounding leaves. Beside a family of equilibria, as of a molecule that is free to turn, K along
/// the family is as small as the way to it, and Newton's steps along it are anything.
constexpr std::array none_below = {0.0, 1e-9, 1e-6, 1e-3};

std::string written(const Scene& scene, const Statics& statics, std::span<const double> x) {
  std::string text;
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "%.6g", x[i]);
    text += (i == 0 ? "" : ", ") + scene.coordinates[statics.reduction.kept[i]].name + " = " + number.data();
  }
  return text;
}

std::vector<double> values_of(std::span<const Ball> balls) {
  std::vector<double> values;
  for (const Ball& ball : balls) values.push_back(ball.value());
  return values;
}

class NewtonSearch {
 public:
  NewtonSearch(const Dynamics& dynamics, const Statics& statics, std::span<const Ball> constants,
               std::span<const double> guess)
      : dynamics_(dynamics),
        statics_(statics),
        enclosed_constants_(constants.begin(), constants.end()),
        constants_(values_of(constants)),
        guess_(Eigen::Map<const VectorXd>(guess.data(), static_cast<Eigen::Index>(guess.size()))),
        forces_(statics.forces.bind(constants_)),
        stiffness_(statics.stiffness.bind(constants_)),
        inertia_(statics.inertia.bind(constants_)) {
    for (std::size_t i = 0; i < guess.size(); ++i) {
      const Coordinate& q = dynamics.model().scene.coordinates[statics.reduction.kept[i]];
      angle_.push_back(q.unit == "rad");
      free_.push_back(!depends_on_any(statics.reduction.x[i]));
      sizes_.push_back(angle_.back() || guess[i] == 0 ? 1 : std::abs(guess[i]));
    }
    measure();
  }

  Equilibrium nearest() {
    if (const auto found = from(guess_, [&](const VectorXd& x) { return within(x, pi / 2) && in_domain(x); }))
      return *found;
    throw none();
  }

  /// Down from the guess, if one is there where the model holds.
  std::optional<FoundEquilibrium> downhill(const SmoothForces& smooth) {
    const auto only = only_unknown();
    if (only) {
      if (auto next = next_along(*only, smooth)) return FoundEquilibrium{*std::move(next), Arrival::downhill};
    }
    const std::optional<VectorXd> low = is_at_rest(guess_) ? guess_ : descended();
    if (!low) return std::nullopt;
    const bool is_seen_only = only && *low != guess_;
    auto found = valid_one(
        from(*low, [&](const VectorXd& x) { return length(x - *low, *low) < near_by && in_domain(x); }));
    if (!found) return std::nullopt;
    return FoundEquilibrium{*std::move(found), is_seen_only ? Arrival::seen_downhill : Arrival::downhill};
  }

 private:
  template <class Accepted>
  std::optional<Equilibrium> from(const VectorXd& start, const Accepted& is_accepted) {
    for (const double below : none_below) {
      none_below_ = below;
      const std::optional<VectorXd> found = newton(start);
      if (!found || !is_accepted(*found)) continue;
      if (auto enclosed = enclosure(*found)) return enclosed;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Equilibrium> valid_one(std::optional<Equilibrium> found) const {
    if (found && !valid(*found)) return std::nullopt;
    return found;
  }

  [[nodiscard]] bool depends_on_any(const Expression& x) const {
    return std::any_of(statics_.rest.begin(), statics_.rest.end(),
                       [&](const Expression& g) { return depends_on(g, x); });
  }

  [[nodiscard]] std::optional<MatrixXd> values(const CompiledFunction& function, Workspace& workspace,
                                               const VectorXd& x) const {
    const Eigen::Index n = x.size();
    MatrixXd out(n, static_cast<Eigen::Index>(function.outputs()) / n);
    const std::span<const double> at(x.data(), static_cast<std::size_t>(n));
    if (function.evaluate(0, at, workspace, {out.data(), function.outputs()}) != Evaluation::ok) return {};
    return out.transpose();  // tapes write by rows
  }
  std::optional<VectorXd> forces(const VectorXd& x) {
    const auto g = values(statics_.forces, forces_, x);
    return g ? std::optional<VectorXd>(g->transpose()) : std::nullopt;
  }
  std::optional<MatrixXd> stiffness(const VectorXd& x) { return values(statics_.stiffness, stiffness_, x); }

  /// The least x with K x = g, coordinates made comparable by comparable_units.
  std::optional<MatrixXd> inverse_stiffness(const VectorXd& x) {
    const auto k = stiffness(x);
    const auto m = values(statics_.inertia, inertia_, x);
    if (!k || !m) return std::nullopt;
    const VectorXd scale = comparable_units(*k, *m);
    const MatrixXd scaled = scale.asDiagonal() * *k * scale.asDiagonal();
    if (!scaled.allFinite()) return std::nullopt;
    return scale.asDiagonal() * pseudo_inverse(scaled, none_below_) * scale.asDiagonal();
  }

  /// Where no force is seen it would be rounding that measures.
  void measure() {
    if (is_at_rest(guess_)) return;
    const auto g = forces(guess_);
    const auto k = stiffness(guess_);
    const auto m = values(statics_.inertia, inertia_, guess_);
    if (!g || !k || !m) return;
    std::vector<std::string> units;
    for (const std::size_t i : statics_.reduction.kept)
      units.push_back(dynamics_.model().scene.coordinates[i].unit);
    const VectorXd sizes =
        sizes_at({guess_, *g, *k, *m, [&](const VectorXd& x) { return stiffness(x); }}, units);
    sizes_.assign(sizes.begin(), sizes.end());
  }

  /// In each coordinate the guess's size, or the way from there to x.
  [[nodiscard]] std::vector<double> sizes_on_way(const VectorXd& x) const {
    std::vector<double> sizes = sizes_;
    for (std::size_t i = 0; i < sizes.size(); ++i)
      sizes[i] = std::max(sizes[i], std::abs(x[index(i)] - guess_[index(i)]));
    return sizes;
  }

  /// A step's length in units of what each coordinate is at x.
  [[nodiscard]] double length(const VectorXd& step, const VectorXd& x) const {
    const std::vector<double> sizes = sizes_on_way(x);
    double sum = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const double part = step[index(i)] / sizes[i];
      sum += part * part;
    }
    return std::sqrt(sum);
  }

  /// Whether no force is seen there, nor at the doubles beside it: a step would be rounding, and where K is
  /// singular as long as that makes it.
  [[nodiscard]] bool is_at_rest(const VectorXd& x) const {
    std::vector<Ball> there(x.begin(), x.end()), g(sizes_.size());
    for (Ball& ball : there)
      ball.radius = std::nextafter(std::abs(ball.value()), infinity) - std::abs(ball.value());
    TapeEvaluator<Ball>(statics_.forces, enclosed_constants_)(there, g);
    return std::ranges::all_of(g,
                               [](const Ball& force) { return force.is_finite() && force.contains_zero(); });
  }

  std::optional<VectorXd> newton(VectorXd x) {
    if (is_at_rest(x)) return x;
    double last = 0;
    for (int i = 0; i < most_steps; ++i) {
      const auto g = forces(x);
      const auto inverse = inverse_stiffness(x);
      if (!g || !inverse) return std::nullopt;
      const VectorXd step = -(*inverse * *g);
      last = length(step, x);
      if (!(last > settled)) return x;
      const auto next = damped(x, step, *inverse);
      if (!next) break;
      x = *next;
    }
    return last < arrived ? std::optional(x) : std::nullopt;
  }

  /// x + t step with the largest t = 1, 1/2, ... after which the same K asks for a shorter step.
  std::optional<VectorXd> damped(const VectorXd& x, const VectorXd& step, const MatrixXd& inverse) {
    for (double t = 1; t > least_damping; t /= 2) {
      const VectorXd next = x + t * step;
      const auto g = forces(next);
      if (g && length(inverse * *g, x) <= (1 - t / 4) * length(step, x)) return next;
    }
    return std::nullopt;
  }

  /// The flow down the effective potential, by the inertia.
  std::optional<VectorXd> descended() {
    const Hillside hillside{
        [this](const VectorXd& x) { return slope(x); },
        [this](const VectorXd& x, const Slope& at, const VectorXd& s) { return moved(x, at, s); },
        Eigen::Map<const VectorXd>(sizes_.data(), index(sizes_.size()))};
    return end_of_flow(hillside, guess_);
  }

  /// Coordinates that no force depends on stay, whatever they share inertia with.
  std::optional<MatrixXd> inertia(const VectorXd& x) {
    auto m = values(statics_.inertia, inertia_, x);
    if (!m) return std::nullopt;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      for (std::size_t j = 0; j < free_.size(); ++j)
        if (i != j && (free_[i] || free_[j])) (*m)(index(i), index(j)) = 0;
    }
    return m;
  }

  std::optional<Slope> slope(const VectorXd& x) {
    const auto g = forces(x);
    const auto k = stiffness(x);
    const auto m = inertia(x);
    if (!g || !k || !m || !g->allFinite() || !k->allFinite()) return std::nullopt;
    const MatrixXd curvature = (*k + k->transpose()) / 2;
    const auto axes = principal_axes(curvature, *m);
    if (!axes) return std::nullopt;
    const bool is_gradient = (*k - k->transpose()).norm() <= symmetric * k->norm();
    return Slope{axes->values, axes->vectors.transpose() * *g, axes->vectors, is_gradient};
  }

  std::optional<Moved> moved(const VectorXd& x, const Slope& at, const VectorXd& s) {
    const VectorXd there = x + at.axes * s;
    if (!in_domain(there)) return std::nullopt;
    const auto g = forces(there);
    const auto m = inertia(there);
    if (!g || !m) return std::nullopt;
    return Moved{there, solve(at.axes.transpose() * *m * at.axes, at.axes.transpose() * *g)};
  }

  /// The only coordinate along which anything acts, or that a force depends on; no value where there are
  /// others.
  [[nodiscard]] std::optional<std::size_t> only_unknown() const {
    std::optional<std::size_t> only;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      if (free_[i] && statics_.rest[i].is_zero()) continue;
      if (only) return std::nullopt;
      only = i;
    }
    return only;
  }

  /// Proven to be the first along the only coordinate.
  std::optional<Equilibrium> next_along(std::size_t unknown, const SmoothForces& smooth) {
    std::vector<Interval> constants;
    for (const Ball& c : enclosed_constants_) constants.push_back(c.interval());
    ForceAlongLine line(statics_, smooth, constants, {guess_.begin(), guess_.end()}, unknown);
    const Eigen::Index i = index(unknown);
    const auto around = next_balance(line, guess_[i], sizes_[unknown]);
    if (!around) return std::nullopt;
    VectorXd start = guess_;
    start[i] = around->middle();
    const auto g = forces(start);
    const auto inverse = inverse_stiffness(start);
    if (g && inverse) start -= *inverse * *g;  // from where rounding hides it to the double next to it
    return valid_one(from(start, [&](const VectorXd& x) { return around->contains(x[i]) && in_domain(x); }));
  }

  [[nodiscard]] bool within(const VectorXd& x, double turn) const {
    for (std::size_t i = 0; i < angle_.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      if (angle_[i] && std::abs(x[k] - guess_[k]) > turn) return false;
    }
    return true;
  }

  [[nodiscard]] bool in_domain(const VectorXd& x) const {
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
      const Coordinate& q = dynamics_.model().scene.coordinates[statics_.reduction.kept[i]];
      if (!q.domain.contains(x[index(i)])) return false;
    }
    return true;
  }

  /// Whether the model holds there.
  [[nodiscard]] bool valid(const Equilibrium& place) const {
    const Scene& scene = dynamics_.model().scene;
    if (scene.valid_while.empty()) return true;
    std::vector<Ball> y(2 * scene.coordinates.size());
    for (std::size_t k = 0; k < place.x.size(); ++k) y[statics_.reduction.kept[k]] = place.x[k];
    const std::vector<std::size_t>& ignored = statics_.reduction.ignored;
    std::vector<Ball> rates(ignored.size());
    TapeEvaluator<Ball>(statics_.ignored_rates, enclosed_constants_)(place.x, rates);
    for (std::size_t c = 0; c < rates.size(); ++c) y[scene.coordinates.size() + ignored[c]] = rates[c];
    return conditions_hold(model_conditions(dynamics_, enclosed_constants_, y));
  }

  std::optional<Equilibrium> enclosure(const VectorXd& start) {
    const auto inverse = inverse_stiffness(start);
    if (!inverse) return std::nullopt;
    const NearlyEquilibrium near{start, *inverse, free_, sizes_on_way(start)};
    const auto found = enclosed_equilibrium(statics_, enclosed_constants_, near);
    if (!found || found->isolated) return found;
    return as_written(with_family(statics_, enclosed_constants_, near, guess_, *found));
  }

  /// Of several that cannot be told apart it is the one that doubles stand for, or any beside it.
  static Equilibrium as_written(Equilibrium place) {
    for (Ball& x : place.x) {
      const double value = std::abs(x.value());
      if (!place.isolated && value > 0) x.radius += (std::nextafter(value, infinity) - value) / 2;
    }
    return place;
  }

  static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

  /// A coordinate with a force that depends on no coordinate and is not zero; empty where there is none.
  [[nodiscard]] std::string never_held() const {
    const std::vector<Ball> x(guess_.begin(), guess_.end());
    std::vector<Ball> g(statics_.rest.size());
    TapeEvaluator<Ball>(statics_.forces, enclosed_constants_)(x, g);
    for (std::size_t i = 0; i < statics_.rest.size(); ++i) {
      if (!depends_on(statics_.rest[i], statics_.reduction.x) && !g[i].contains_zero())
        return dynamics_.model().scene.coordinates[statics_.reduction.kept[i]].name;
    }
    return {};
  }

  [[nodiscard]] Error none() {
    const std::span<const double> at(guess_.data(), sizes_.size());
    const auto g = forces(guess_);
    if (!g || !g->allFinite()) {
      return {
          ErrorCode::not_applicable,
          "At " + written(dynamics_.model().scene, statics_, at) +
              " the forces have no value, as where a coordinate fails, so that nothing is known of small motions "
              "there. Other coordinates may have no such place: angles about x, y and z where Euler's angles "
              "have one."};
    }
    if (const std::string held = never_held(); !held.empty()) {
      return {ErrorCode::not_applicable, "No place is an equilibrium: the force along '" + held +
                                             "' is the same everywhere, and not zero."};
    }
    return {ErrorCode::not_applicable, "There is no equilibrium near " +
                                           written(dynamics_.model().scene, statics_, at) +
                                           ": the forces do not vanish on the way that Newton's iteration "
                                           "takes from there. Give 'equilibrium' another guess."};
  }

  const Dynamics& dynamics_;
  const Statics& statics_;
  std::vector<Ball> enclosed_constants_;
  std::vector<double> constants_;
  VectorXd guess_;
  Workspace forces_, stiffness_, inertia_;
  double none_below_{};
  std::vector<bool> angle_, free_;
  std::vector<double> sizes_;
};

}  // namespace

Equilibrium equilibrium_near(const Dynamics& dynamics, const Statics& statics,
                             std::span<const Ball> constants, std::span<const double> guess) {
  return NewtonSearch(dynamics, statics, constants, guess).nearest();
}

FoundEquilibrium equilibrium_downhill(const Dynamics& dynamics, const Statics& statics,
                                      const SmoothForces& smooth, std::span<const Ball> constants,
                                      std::span<const double> guess) {
  NewtonSearch search(dynamics, statics, constants, guess);
  if (auto found = search.downhill(smooth)) return *std::move(found);
  return {search.nearest(), Arrival::newton};
}

}  // namespace qdot
