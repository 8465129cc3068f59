#include "core/gait/section_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/integrate/integrate.hpp"
#include "core/numerics/dense_matrix.hpp"

namespace qdot {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_atol = 1e-100;
constexpr double of_rounding = 1e-11;  // of u, as far as it has been found

bool depends_on_time(const Model& model) {
  const Symbols& symbols = model.parsed.symbols;
  const auto varies = [&](const Expression& e) {
    return depends_on(e, symbols.t) || depends_on(e, symbols.inputs.value) ||
           depends_on(e, symbols.inputs.rate) || depends_on(e, symbols.inputs.second_rate);
  };
  bool any = varies(impact_event(model).value);
  for (const Expression& e : model.equations.forcing) any = any || varies(e);
  for (const auto& row : model.equations.mass_matrix) any = any || std::ranges::any_of(row, varies);
  for (const auto& [symbol, value] : model.parsed.impacts.front().map) any = any || varies(value);
  return any;
}

Index to_index(std::size_t i) { return static_cast<Index>(i); }

}  // namespace

SectionMap::SectionMap(const Dynamics& dynamics) : dynamics_(dynamics) {
  const Model& model = dynamics.model();
  if (model.parsed.impacts.size() != 1) {
    throw Error(ErrorCode::not_applicable,
                "A gait is a motion from one impact to the next of the same kind, and " + model.scene.name +
                    (model.parsed.impacts.empty() ? " has no impact." : " has several impacts."));
  }
  if (model.has_constraints()) {
    throw Error(ErrorCode::not_applicable,
                "A gait is searched among states that are free, and the constraints of " + model.scene.name +
                    " bind them: write it in coordinates that need none.");
  }
  if (depends_on_time(model)) {
    throw Error(ErrorCode::not_applicable,
                "The equations of " + model.scene.name +
                    " contain the time or an input, so that no state alone says what the next stride is.");
  }
  impact_ = std::make_shared<const ImpactFunctions>(impact_functions(dynamics));
}

void SectionMap::set_parameters(std::span<const double> parameters) {
  parameters_.assign(parameters.begin(), parameters.end());
  scales_ = StateScales(dynamics_.model(), parameters);
  accelerations_ = &dynamics_.accelerations();
  jacobian_ = &dynamics_.jacobian();
  accelerations_workspace_ = accelerations_->bind(parameters);
  jacobian_workspace_ = jacobian_->bind(parameters);
  jump_workspace_ = impact_->jump.bind(parameters);
  surface_workspace_ = impact_->surface.bind(parameters);
  watches_.clear();
  si_.resize(static_cast<std::size_t>(state_size()));
  block_.resize(si_.size() * si_.size());
}

const std::vector<Watch>& SectionMap::watched() {
  if (watches_.empty()) {
    watches_ = watches(dynamics_, {.parameters = parameters_});
  }
  return watches_;
}

VectorXd SectionMap::section(const VectorXd& state) const { return state(impact_->components); }

void SectionMap::set_section(VectorXd& state, const VectorXd& u) const { state(impact_->components) = u; }

VectorXd SectionMap::state(const VectorXd& u) const {
  VectorXd result = VectorXd::Zero(state_size());
  set_section(result, u);
  return result;
}

std::optional<SectionMap::Jump> SectionMap::jump(const VectorXd& u) {
  const Index width = state_size();
  std::vector<double> out(impact_->jump.outputs());
  if (impact_->jump.evaluate(0, in_si(state(u)), jump_workspace_, out) != Evaluation::ok) return std::nullopt;
  Jump jump{Eigen::Map<const VectorXd>(out.data(), width).cwiseQuotient(scales_.units()),
            Eigen::Map<const MatrixXd>(out.data() + width, width, size())};
  jump.derivative = scales_.units().cwiseInverse().asDiagonal() * jump.derivative;
  for (Index k = 0; k < size(); ++k)
    jump.derivative.col(k) *= scales_.units()[impact_->components[static_cast<std::size_t>(k)]];
  if (!jump.after.allFinite() || !jump.derivative.allFinite()) return std::nullopt;
  return jump;
}

bool SectionMap::add_surface(Flow& flow) {
  std::vector<double> out(impact_->surface.outputs());
  if (impact_->surface.evaluate(0, in_si(flow.state), surface_workspace_, out) != Evaluation::ok)
    return false;
  flow.surface = out[0];
  flow.surface_slope = Eigen::Map<const VectorXd>(out.data() + 1, state_size()).cwiseProduct(scales_.units());
  return true;
}

Evaluation SectionMap::rates(std::span<const double> y, std::span<double> out) {
  const std::size_t n = si_.size() / 2;
  for (std::size_t i = 0; i < 2 * n; ++i) si_[i] = y[i] * scales_.units()[to_index(i)];
  const Evaluation evaluation = accelerations_->evaluate(0, si_, accelerations_workspace_, out.subspan(n, n));
  for (std::size_t i = 0; i < n; ++i) {
    out[i] = y[n + i];
    out[n + i] *= scales_.time_unit() / scales_.units()[to_index(n + i)];
  }
  return evaluation;
}

Evaluation SectionMap::variational_rates(std::span<const double> y, std::span<double> out) {
  if (const Evaluation evaluation = rates(y, out); evaluation != Evaluation::ok) return evaluation;
  const Evaluation evaluation = jacobian_->evaluate(0, si_, jacobian_workspace_, block_);
  const Index width = state_size(), n = width / 2;
  Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobian(
      block_.data(), width, width);
  for (Index k = 0; k < size(); ++k) {
    const double* column = y.data() + width * (k + 1);
    double* rate = out.data() + width * (k + 1);
    for (Index i = 0; i < n; ++i) {
      double sum = 0;
      for (Index j = 0; j < width; ++j) sum += jacobian(n + i, j) * scales_.units()[j] * column[j];
      rate[i] = column[n + i];
      rate[n + i] = sum * scales_.time_unit() / scales_.units()[n + i];
    }
  }
  return evaluation;
}

bool SectionMap::starts_validly(const VectorXd& after) {
  const std::vector<double> y = in_si(after);
  return std::ranges::none_of(watched(), [&](const Watch& watch) {
    return watch.kind == Watch::Kind::validity && !(watch.value(0, y) >= 0);
  });
}

/// By the method that comes nearest to the true motion; atol at the size of the state.
RunRequest SectionMap::request(const VectorXd& start, double rtol) const {
  RunRequest run;
  run.y_start.assign(start.begin(), start.end());
  run.method = Method::erk;
  run.tolerances = {rtol, std::max(rtol * start.lpNorm<Eigen::Infinity>(), least_atol)};
  run.limits.max_steps = steps_left_;
  return run;
}

Run SectionMap::followed(const RightHandSide& system, const RunRequest& run) {
  Run done = integrate(system, run);
  if (done.ending == Ending::step_limit) steps_left_ = std::max(steps_left_ / 2, fewest_steps);
  return done;
}

std::optional<Stride> SectionMap::stride(const VectorXd& u, double rtol) {
  const auto start = jump(u);
  return start ? stride_from(on_surface(start->after), rtol) : std::nullopt;
}

/// Velocities in the scene's units of time.
std::optional<Stride> SectionMap::first_stride(double haste, double rtol) {
  const ParsedScene& parsed = dynamics_.model().parsed;
  std::vector<Assignment> values;
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    values.emplace_back(parsed.symbols.parameters[i], parameters_[i]);
  const Index n = state_size() / 2;
  VectorXd start(2 * n);
  for (Index i = 0; i < n; ++i) {
    start[i] = evaluate(parsed.initial[static_cast<std::size_t>(i)], values);
    start[n + i] = haste * evaluate(parsed.initial_rates[static_cast<std::size_t>(i)], values);
  }
  if (!start.allFinite()) return std::nullopt;
  return stride_from(in_units(start), rtol);
}

/// An impact that keeps the place leaves the motion on the surface up to the rounding of u. That far from it,
/// the motion would meet the surface again at once.
VectorXd SectionMap::on_surface(VectorXd after) {
  std::vector<double> out(impact_->surface.outputs());
  if (impact_->surface.evaluate(0, in_si(after), surface_workspace_, out) != Evaluation::ok) return after;
  const VectorXd slope =
      Eigen::Map<const VectorXd>(out.data() + 1, state_size()).cwiseProduct(scales_.units());
  const double steepness = slope.norm();
  if (std::abs(out[0]) < of_rounding * steepness * after.norm())
    after -= out[0] / (steepness * steepness) * slope;
  return after;
}

std::optional<Stride> SectionMap::stride_from(const VectorXd& after, double rtol) {
  if (!starts_validly(after)) return std::nullopt;
  const RightHandSide system{
      static_cast<std::size_t>(state_size()),
      [this](double, std::span<const double> y, std::span<double> out) { return rates(y, out); },
      {}};
  RunRequest run = request(after, rtol);
  run.t_end = longest_stride;
  for (const Watch& watch : watched()) run.events.push_back(scales_.event(watch));
  run.events.back().counts_at_start = false;   // an impact has just been
  EventFunction crossing = run.events.back();  // the impact's, wherever it happens
  crossing.terminal = false;
  crossing.condition = {};
  run.events.push_back(std::move(crossing));
  const Run done = followed(system, run);
  if (done.ending != Ending::event) return std::nullopt;
  const auto ended =
      std::ranges::find_if(done.events, [&](const EventOccurrence& e) { return e.event < watches_.size(); });
  if (watches_[ended->event].kind != Watch::Kind::impact) return std::nullopt;
  return Stride{after, Eigen::Map<const VectorXd>(done.y.data(), state_size()), done.t,
                static_cast<int>(ended - done.events.begin())};
}

bool SectionMap::counts(const VectorXd& state) {
  const Watch& impact = watched().back();
  return !impact.condition || impact.condition(0, in_si(state)) > 0;
}

bool SectionMap::is_impact(const Flow& flow) {
  const double speed = flow.surface_slope.dot(flow.rate);
  const Crossing direction = watched().back().direction;
  return counts(flow.state) && speed != 0 &&
         (direction == Crossing::either || (direction == Crossing::rising) == (speed > 0));
}

std::optional<Flow> SectionMap::flow(const VectorXd& u, double duration, double rtol) {
  const auto start = jump(u);
  if (!start) return std::nullopt;
  const Index width = state_size();
  const RightHandSide system{
      static_cast<std::size_t>(width * (1 + size())),
      [this](double, std::span<const double> y, std::span<double> out) { return variational_rates(y, out); },
      {}};
  RunRequest run = request(start->after, rtol);
  run.y_start.insert(run.y_start.end(), start->derivative.reshaped().begin(),
                     start->derivative.reshaped().end());
  run.t_end = duration;
  const Run done = followed(system, run);
  if (done.ending != Ending::reached_end) return std::nullopt;
  Flow flow;
  flow.after = start->after;
  flow.state = Eigen::Map<const VectorXd>(done.y.data(), width);
  flow.derivative = Eigen::Map<const MatrixXd>(done.y.data() + width, width, size());
  flow.rate.resize(width);
  const std::size_t n = si_.size();
  if (rates({flow.state.data(), n}, {flow.rate.data(), n}) != Evaluation::ok) return std::nullopt;
  if (!add_surface(flow) || !flow.derivative.allFinite()) return std::nullopt;
  return flow;
}

MatrixXd SectionMap::derivative(const Flow& flow) const {
  const VectorXd duration_slope =
      -(flow.derivative.transpose() * flow.surface_slope) / flow.surface_slope.dot(flow.rate);
  return (flow.derivative + flow.rate * duration_slope.transpose())(impact_->components, Eigen::all);
}

Index SectionMap::dimension(const Flow& flow) {
  const auto map = jump(section(flow.state));
  if (!map) return 0;
  MatrixXd tangent = MatrixXd::Zero(state_size(), state_size());
  tangent(Eigen::all, impact_->components) = map->derivative;
  const VectorXd normal = flow.surface_slope.normalized();
  tangent -= (tangent * normal) * normal.transpose();
  return rank(tangent, 1e-12);
}

}  // namespace qdot
