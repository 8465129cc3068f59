#include "core/gait/gait.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/gait/gait_search.hpp"
#include "core/numerics/dense_matrix.hpp"

namespace qdot {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double rough = 1e-10, fine = 1e-14, coarser = 1e-13;  // relative tolerances of the steps
constexpr double settled = 2e-14;  // a correction after which Newton's method has converged
constexpr int most_corrections = 4;
constexpr double same_place = 1e-6;
constexpr double nearby = 1e-4;  // of u: how the multipliers change with it is seen from there
constexpr double safety = 2;
/// Of each number on its way through a stride: by the impact, the parameters and the steps.
constexpr double roundings = 4 * epsilon;

/// The correction of (u, T), and the bound of what rounding makes of it.
VectorXd correction(const Shooting& shooting) { return solve(shooting.derivative, -shooting.residual); }

/// What the numbers of a stride bring to its end; that of its time are those of its steps, too.
VectorXd carried(const Flow& flow, const Recurrence& at) {
  return flow.derivative.cwiseAbs() * at.u.cwiseAbs() + flow.state.cwiseAbs() +
         at.duration * flow.rate.cwiseAbs();
}

VectorXd rounding(const SectionMap& map, const Shooting& shooting, const Recurrence& at) {
  const Index k = at.u.size();
  VectorXd residual(k + 1);
  const VectorXd at_end = carried(shooting.flow, at);
  residual.head(k) = at.u.cwiseAbs() + map.section(at_end);
  residual[k] = shooting.flow.surface_slope.normalized().cwiseAbs().dot(at_end);
  return roundings * (inverse(shooting.derivative).cwiseAbs() * residual);
}

/// The error of the state before the impact, from those of (u, T) and from the difference of two
/// computations.
VectorXd state_error(const PolishedGait& gait) {
  const Flow& flow = gait.flow;
  const double speed = flow.surface_slope.dot(flow.rate);
  const auto along_surface = [&](const MatrixXd& m) -> MatrixXd {
    return m - flow.rate * (flow.surface_slope.transpose() * m) / speed;
  };
  const VectorXd between = along_surface(flow.state - gait.coarser.state);
  const double late = std::abs(flow.surface / speed) + epsilon * gait.at.duration;
  return along_surface(flow.derivative).cwiseAbs() * gait.error.head(gait.at.u.size()) +
         safety * between.cwiseAbs() + late * flow.rate.cwiseAbs() + roundings * carried(flow, gait.at);
}

/// |d(dP/du)/du| along the error of u; none known counts as infinite.
double curvature(SectionMap& map, const PolishedGait& gait) {
  const VectorXd direction = gait.error.head(map.size()).normalized();
  const double distance = nearby * gait.at.u.norm();
  const auto flow = map.flow(gait.at.u + distance * direction, gait.at.duration, rough);
  if (!flow) return std::numeric_limits<double>::infinity();
  return (map.derivative(*flow) - gait.section).norm() / distance;
}

std::vector<Uncertain> in_si(const SectionMap& map, const VectorXd& state, const VectorXd& error) {
  const std::vector<double> values = map.in_si(state), errors = map.in_si(error);
  std::vector<Uncertain> result;
  for (std::size_t i = 0; i < values.size(); ++i) result.push_back({values[i], errors[i]});
  return result;
}

/// The state before the impact. Its components u are known better by themselves than by the motion that leads
/// there.
std::vector<Uncertain> pre_impact(const SectionMap& map, const PolishedGait& gait) {
  VectorXd state = gait.flow.state, error = state_error(gait);
  map.set_section(state, gait.at.u);
  map.set_section(error, gait.error.head(map.size()));
  return in_si(map, state, error);
}

std::vector<double> values_of(const std::vector<Uncertain>& numbers) {
  std::vector<double> values;
  for (const Uncertain& number : numbers) values.push_back(number.value);
  return values;
}

/// The scene's points in one state, a column each.
MatrixXd points(const Dynamics& dynamics, std::span<const double> parameters, std::span<const double> y) {
  const Index count = static_cast<Index>(dynamics.model().scene.points.size());
  const std::vector<double> values =
      values_at(dynamics, position_columns(dynamics.model()), parameters, 0, y);
  return Eigen::Map<const MatrixXd>(values.data(), static_cast<Index>(values.size()) / count, count);
}

/// The shift that takes the points after the impact to those before it, in whatever order.
std::optional<VectorXd> shift(const MatrixXd& before, const MatrixXd& after) {
  const double near = 1e-9 * before.cwiseAbs().maxCoeff();
  const auto is_shifted = [&](const VectorXd& by) {
    return std::ranges::all_of(after.colwise(), [&](const auto& point) {
      return ((before.colwise() - (point + by)).colwise().norm().array() <= near).any();
    });
  };
  for (Index j = 0; j < before.cols(); ++j) {
    const VectorXd by = before.col(j) - after.col(0);
    if (is_shifted(by)) return by;
  }
  return std::nullopt;
}

std::optional<Uncertain> step_length(const Dynamics& dynamics, std::span<const double> parameters,
                                     const Gait& gait) {
  if (dynamics.model().scene.points.empty()) return std::nullopt;
  const std::vector<double> y = values_of(gait.pre_impact);
  const MatrixXd before = points(dynamics, parameters, y);
  const auto by = shift(before, points(dynamics, parameters, values_of(gait.state)));
  if (!by || by->norm() < 1e-9 * before.cwiseAbs().maxCoeff()) return std::nullopt;
  double error = 4 * epsilon * by->norm();
  for (std::size_t i = 0; i < y.size(); ++i) {  // how far the points move with component i
    std::vector<double> moved = y;
    const double change = 1e-6 * std::max(1.0, std::abs(y[i]));
    moved[i] += change;
    const double slope = (points(dynamics, parameters, moved) - before).colwise().norm().maxCoeff() / change;
    error += slope * gait.pre_impact[i].error;
  }
  return Uncertain{by->norm(), error};
}

/// The gait at `near`, if there is one whose first impact is its own and that ignores no more crossings.
std::optional<Gait> gait_near(SectionMap& map, const Dynamics& dynamics, std::span<const double> parameters,
                              const Recurrence& near, int most_ignored) {
  const auto found = polished(map, near);
  if (!found) return std::nullopt;
  const auto stride = map.stride(found->at.u, fine);
  if (!stride || stride->ignored_crossings > most_ignored ||
      std::abs(stride->duration - found->at.duration) > same_place * found->at.duration) {
    return std::nullopt;
  }
  Gait gait;
  gait.ignored_crossings = stride->ignored_crossings;
  const Index k = map.size();
  const auto jump = map.jump(found->at.u);
  const VectorXd error =
      jump->derivative.cwiseAbs() * found->error.head(k) + epsilon * jump->after.cwiseAbs();
  gait.state = in_si(map, jump->after, error);
  gait.pre_impact = pre_impact(map, *found);
  gait.step_time = {found->at.duration * map.time_unit(), found->error[k] * map.time_unit()};
  gait.step_length = step_length(dynamics, parameters, gait);
  Multipliers all = multipliers(map, *found);
  gait.stability = stability(all);
  gait.multipliers = std::move(all.values);
  gait.multiplier_errors = std::move(all.errors);
  if (const auto next = map.jump(map.section(stride->before))) {
    for (const double difference : map.in_si(next->after - jump->after)) {
      gait.residual = std::max(gait.residual, std::abs(difference));
    }
  }
  return gait;
}

/// Whether two gaits are one, by their whole states: a component that is 0 has no size of its own.
bool are_same(const Gait& known, const Gait& gait) {
  const std::vector<double> a = values_of(known.pre_impact), b = values_of(gait.pre_impact);
  const Eigen::Map<const VectorXd> there(a.data(), static_cast<Index>(a.size())),
      here(b.data(), static_cast<Index>(b.size()));
  return std::abs(known.step_time.value - gait.step_time.value) < same_place * known.step_time.value &&
         (there - here).norm() < same_place * there.norm();
}

int fewest_ignored(const std::vector<Gait>& gaits) {
  int fewest = std::numeric_limits<int>::max();
  for (const Gait& gait : gaits) fewest = std::min(fewest, gait.ignored_crossings);
  return fewest;
}

void name_kinds(std::vector<Gait>& gaits) {
  std::ranges::sort(gaits, {}, [](const Gait& gait) { return gait.step_time.value; });
  if (gaits.size() < 2) return;
  gaits[0].kind = Gait::Kind::short_step;
  gaits[1].kind = Gait::Kind::long_step;
}

std::string reason(GaitSearch::Outcome outcome, const ParsedImpact& impact) {
  switch (outcome) {
    case GaitSearch::Outcome::found:
      return "Motions that repeat were found, but in none of them the next " + impact.event +
             " is the one that closes the stride.";
    case GaitSearch::Outcome::nothing_recurs:
      return "No motion that repeats, and has no others like it beside it, was found from the starts that are "
             "tried. Where all motions repeat, as of a ball that loses nothing, none is listed.";
    case GaitSearch::Outcome::dies_away:
      return "From all starts that are tried the search ends at rest. Where all motions repeat, as of a ball that "
             "loses nothing, none is listed.";
    case GaitSearch::Outcome::no_impact:
      return "Motions that repeat after a given time were found, but none of them meets " + impact.event +
             " then.";
  }
  return {};
}

}  // namespace

std::optional<PolishedGait> polished(SectionMap& map, const Recurrence& near) {
  auto at = solve_recurrence(map, near, rough, 1e-5);
  if (!at) return std::nullopt;
  const Index k = map.size();
  for (int i = 0; i < most_corrections; ++i) {
    auto shooting = shoot(map, *at, fine);
    if (!shooting || !map.is_impact(shooting->flow)) return std::nullopt;
    const VectorXd step = correction(*shooting);
    at->u += step.head(k);
    at->duration += step[k];
    if (!step.allFinite() || !(at->duration > 0)) return std::nullopt;
    if (step.head(k).norm() > settled * at->u.norm() && i + 1 < most_corrections) continue;
    auto second = shoot(map, *at, coarser);
    if (!second) return std::nullopt;
    VectorXd error = safety * correction(*second).cwiseAbs() + rounding(map, *shooting, *at);
    error.head(k) += step.head(k).cwiseAbs();
    error[k] += std::abs(step[k]) + 4 * epsilon * at->duration;
    MatrixXd section = map.derivative(shooting->flow);
    return PolishedGait{*at, std::move(error), std::move(shooting->flow), std::move(second->flow),
                        std::move(section)};
  }
  return std::nullopt;
}

/// An eigenvalue moves by |difference of the matrices| times its condition number 1/|y* x|, with left and
/// right eigenvectors of length 1 (G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., section
/// 7.2.2), but by no more than its square root when two meet.
Multipliers multipliers(SectionMap& map, const PolishedGait& gait) {
  const auto [values, right, left] = eigen_decomposition(gait.section);
  const double size = gait.section.norm();
  const double moved = safety * (gait.section - map.derivative(gait.coarser)).norm() + epsilon * size +
                       safety * curvature(map, gait) * gait.error.head(map.size()).norm();
  std::vector<Index> order;
  for (Index i = 0; i < map.size(); ++i) order.push_back(i);
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&values = values](Index i) { return std::abs(values[i]); });
  order.resize(static_cast<std::size_t>(std::min(map.dimension(gait.flow), map.size())));
  Multipliers result;
  for (const Index i : order) {
    const double condition = left.row(i).norm() * right.col(i).norm();
    result.values.push_back(values[i]);
    result.errors.push_back(std::min(condition * moved, std::sqrt(moved * size) + moved));
  }
  return result;
}

GaitStability stability(const Multipliers& multipliers) {
  GaitStability result = GaitStability::stable;
  for (std::size_t i = 0; i < multipliers.values.size(); ++i) {
    const double magnitude = std::abs(multipliers.values[i]), error = multipliers.errors[i];
    if (magnitude - error > 1) return GaitStability::unstable;
    if (magnitude + error >= 1) result = GaitStability::undecided;
  }
  return result;
}

Gaits periodic_gaits(const Dynamics& dynamics, std::span<const double> parameters) {
  SectionMap map(dynamics);
  map.set_parameters(parameters);
  Gaits result;
  const GaitSearch search = search_gaits(map, [&](const Recurrence& candidate) -> std::optional<int> {
    auto gait = gait_near(map, dynamics, parameters, candidate, fewest_ignored(result.gaits));
    const auto is_same = [&](const Gait& known) { return are_same(known, *gait); };
    if (!gait) return std::nullopt;
    const int ignored = gait->ignored_crossings;
    if (std::ranges::none_of(result.gaits, is_same)) result.gaits.push_back(std::move(*gait));
    return ignored;
  });
  std::erase_if(result.gaits, [fewest = fewest_ignored(result.gaits)](const Gait& gait) {
    return gait.ignored_crossings > fewest;
  });
  name_kinds(result.gaits);
  if (result.gaits.empty()) result.reason = reason(search.outcome, dynamics.model().parsed.impacts.front());
  return result;
}

}  // namespace qdot
