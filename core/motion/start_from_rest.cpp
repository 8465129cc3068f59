#include "core/motion/start_from_rest.hpp"

#include <algorithm>
#include <cmath>

#include "core/compile/tape_evaluator.hpp"
#include "core/expr/simplify.hpp"
#include "core/integrate/methods.hpp"
#include "core/numerics/dense_matrix.hpp"
#include "core/numerics/interval.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr double share_of_span = 1e-8;    ///< a first step
constexpr double round_offs_of_t = 4096;  ///< at least
constexpr double safety = 2;              ///< of the box: so much more than what moves in it
constexpr double least_eigenvalue = -1e-12;

struct SpeedSquares {
  std::vector<Expression> squares;
  bool divides{false};  ///< one of them stands in a denominator
};

/// S of every sqrt(S) in the equations where S is quadratic in the velocities, and no square itself.
SpeedSquares squares_in(const Model& model) {
  const Graph& graph = *model.parsed.graph;
  const std::vector<Expression>& rates = model.parsed.symbols.coordinates.rate;
  std::vector<NodeId> roots;
  for (const Expression& e : model.equations.forcing) roots.push_back(e.id());
  SpeedSquares found;
  for (const NodeId id : reachable(graph, roots)) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    if (power == nullptr || power->exponent.is_integer()) continue;
    const Expression square(*model.parsed.graph, power->base);
    if (!depends_on(square, rates)) continue;
    found.divides = found.divides || power->exponent.is_negative();
    if (std::ranges::find(found.squares, square) == found.squares.end()) found.squares.push_back(square);
  }
  return found;
}

/// 2 H; nothing where S is not q'.H q'.
std::vector<Expression> doubled_form(const Expression& square, const std::vector<Expression>& rates) {
  Graph& graph = square.graph();
  std::vector<Expression> form, terms;
  for (const Expression& v : rates) {
    const Expression slope = differentiate(square, v);
    for (const Expression& w : rates) {
      form.push_back(simplify(differentiate(slope, w)));
      if (depends_on(form.back(), rates)) return {};
      terms.push_back(Number::ratio(1, 2) * form.back() * v * w);
    }
  }
  return simplify(square - graph.sum(terms)).is_zero() ? form : std::vector<Expression>{};
}

bool is_semidefinite(std::span<const double> form, std::size_t n) {
  const auto size = static_cast<Eigen::Index>(n);
  const Eigen::Map<const Eigen::MatrixXd> matrix(form.data(), size, size);
  if (!matrix.allFinite()) return false;
  const Eigen::VectorXd of = symmetric_eigenvalues(matrix);
  return of.minCoeff() >= least_eigenvalue * std::max(0.0, of.maxCoeff());
}

double quadratic(std::span<const double> doubled, std::span<const double> v) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    for (std::size_t j = 0; j < v.size(); ++j) sum += 0.5 * doubled[i * v.size() + j] * v[i] * v[j];
  }
  return sum;
}

/// q'' of all M in a matrix of intervals, row by row, and all f behind it; none where one is singular.
std::optional<std::vector<Interval>> eliminated(std::vector<Interval> a, std::size_t n) {
  const std::size_t f = n * n;
  for (std::size_t k = 0; k < n; ++k) {
    if (a[k * n + k].contains(0)) return std::nullopt;
    for (std::size_t i = k + 1; i < n; ++i) {
      if (is_zero(a[i * n + k])) continue;
      const Interval factor = a[i * n + k] / a[k * n + k];
      for (std::size_t j = k + 1; j < n; ++j) a[i * n + j] = a[i * n + j] - factor * a[k * n + j];
      a[f + i] = a[f + i] - factor * a[f + k];
    }
  }
  std::vector<Interval> x(n);
  for (std::size_t k = n; k-- > 0;) {
    Interval sum = a[f + k];
    for (std::size_t j = k + 1; j < n; ++j) {
      if (!is_zero(a[k * n + j])) sum = sum - a[k * n + j] * x[j];
    }
    x[k] = sum / a[k * n + k];
  }
  return x;
}

bool may_hold_speeds(const Graph& graph, const std::vector<Expression>& forcing) {
  std::vector<NodeId> roots;
  for (const Expression& e : forcing) roots.push_back(e.id());
  return std::ranges::any_of(reachable(graph, roots), [&](NodeId id) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    return power != nullptr && !power->exponent.is_integer();
  });
}

}  // namespace

StartFromRest::StartFromRest(const Dynamics& dynamics, const SimulationRequest& request)
    : dynamics_(dynamics), request_(request) {
  const Model& model = dynamics.model();
  const MethodRecord::Needs needs = record_of(request.method).needs;
  const bool needs_series = needs == MethodRecord::Needs::expansion || needs == MethodRecord::Needs::jacobian;
  if (!needs_series || !may_hold_speeds(*model.parsed.graph, model.equations.forcing)) return;
  const SpeedSquares found = squares_in(model);
  if (found.divides) return;
  Graph graph = *model.parsed.graph;
  std::vector<Expression> rates, all;
  for (const Expression& v : model.parsed.symbols.coordinates.rate) rates.push_back(graph.adopt(v));
  for (const Expression& square : found.squares) {
    const Expression s = graph.adopt(square);
    const std::vector<Expression> form = doubled_form(s, rates);
    if (form.empty()) continue;
    ++speeds_;
    all.push_back(s);
    all.insert(all.end(), form.begin(), form.end());
  }
  if (speeds_ == 0) return;
  squares_ = std::make_unique<const CompiledFunction>(dynamics.compiled(graph, all));
  if (model.has_constraints() || dynamics.kinks() != nullptr) return;
  all.clear();
  for (const auto& row : model.equations.mass_matrix) {
    for (const Expression& entry : row) all.push_back(graph.adopt(entry));
  }
  for (const Expression& force : model.equations.forcing) all.push_back(graph.adopt(force));
  equations_ = std::make_unique<const CompiledFunction>(dynamics.compiled(graph, all));
}

StartFromRest::~StartFromRest() = default;

/// A speed counts as zero that grows from zero in a shorter time than the step takes.
std::optional<double> StartFromRest::length(double t, std::span<const double> y,
                                            const RightHandSide& system) const {
  if (!squares_) return std::nullopt;
  const std::size_t n = y.size() / 2;
  std::vector<double> rates(y.size()), values(squares_->outputs());
  if (system.derivative(t, y, rates) != Evaluation::ok) return std::nullopt;
  Workspace workspace = squares_->bind(request_.parameters);
  if (squares_->evaluate(t, y, workspace, values) != Evaluation::ok) return std::nullopt;
  const double h = std::max(share_of_span * (request_.t_end - request_.t_start),
                            round_offs_of_t * time_round_off(std::max(std::abs(t), request_.t_end)));
  for (std::size_t k = 0; k < speeds_; ++k) {
    const std::span<const double> of_speed = std::span(values).subspan(k * (1 + n * n), 1 + n * n);
    const double growth = quadratic(of_speed.subspan(1), std::span(rates).last(n));
    if (of_speed[0] <= growth * h * h && is_semidefinite(of_speed.subspan(1), n)) return h;
  }
  return std::nullopt;
}

std::optional<std::vector<double>> StartFromRest::bound(double t, std::span<const double> y,
                                                        double length) const {
  if (!equations_) return std::nullopt;
  const std::size_t n = y.size() / 2;
  std::vector<Interval> parameters, box, values(equations_->outputs());
  for (const double p : request_.parameters) parameters.emplace_back(p);
  TapeEvaluator<Interval> equations(*equations_, parameters);
  equations.set_time(Interval(t, t + length));
  std::vector<double> now(n);
  Workspace workspace = dynamics_.accelerations().bind(request_.parameters);
  if (dynamics_.accelerations().evaluate(t, y, workspace, now) != Evaluation::ok) return std::nullopt;
  // q' goes from where it is towards q'', up to twice as fast: its signs tell those of its products.
  std::vector<Interval> rises;
  for (const double a : now) rises.push_back(hull(Interval(0), Interval(safety * a)));
  for (std::size_t i = 0; i < n; ++i) {
    const double reach = safety * length * (std::abs(y[n + i]) + length * rises[i].magnitude());
    box.emplace_back(y[i] - reach, y[i] + reach);
  }
  for (std::size_t i = 0; i < n; ++i) box.push_back(Interval(y[n + i]) + Interval(0, length) * rises[i]);
  equations(box, values);
  const auto found = eliminated(values, n);
  if (!found) return std::nullopt;
  std::vector<double> off(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!rises[i].contains((*found)[i])) return std::nullopt;
    off[n + i] = length * (*found)[i].width();
    off[i] = length * off[n + i];
  }
  return off;
}

}  // namespace qdot
