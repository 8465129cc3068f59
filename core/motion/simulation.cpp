#include "core/motion/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/work.hpp"
#include "core/dynamics/constraint_surface.hpp"
#include "core/dynamics/watch.hpp"
#include "core/integrate/events.hpp"
#include "core/integrate/integrate.hpp"
#include "core/motion/impact_map.hpp"
#include "core/motion/motion_sections.hpp"
#include "core/motion/start_from_rest.hpp"
#include "core/numerics/constants.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_impacts = 10'000;
constexpr std::size_t similar_sections = 6;  ///< their durations show a geometric series
constexpr double similar = 1e-2;
constexpr const char* accumulation =
    "The impacts follow each other faster and faster, and accumulate at this time.";
constexpr double negligible = 1e-9;  ///< of the span: what is left of the series

class Simulator {
 public:
  Simulator(const Dynamics& dynamics, const SimulationRequest& request)
      : dynamics_(dynamics), request_(request), sections_(dynamics, request), from_rest_(dynamics, request) {
    result_.t = request.t_start;
    result_.y = request.y_start;
    result_.method = request.method;
    is_determined_ = sections_.begin(result_.t, result_.y);
    result_.symplectic = sections_.system().canonical.has_value();
  }

  Simulation run() {
    check_configuration();
    if (!stopped_at_start()) {
      std::size_t impacts = 0;
      while (segment()) {
        if (++impacts == most_impacts) result_.ending = Ending::step_limit;
        if (impacts == most_impacts || !apply_impact()) break;
      }
    }
    sections_.finish(result_.t);
    result_.stays = std::move(sections_.stays());
    fill_columns();
    fill_conserved();
    fill_constraints();
    return std::move(result_);
  }

 private:
  /// The motion is over before it begins where a condition fails in the initial state.
  bool stopped_at_start() {
    for (const Watch& watch : sections_.watches()) {
      if (watch.kind != Watch::Kind::validity || holds_at_start(watch)) continue;
      result_.stop = Stop{watch.reason, result_.t, watch.message};
      result_.ending = Ending::event;
      result_.states = result_.y;
      result_.rows = !request_.grid.empty() && request_.grid.front() == result_.t ? 1 : 0;
      result_.states.resize(result_.rows * result_.y.size());
      row_sections_.resize(result_.rows, sections_.section());
      return true;
    }
    return false;
  }

  /// A condition that holds with equality fails at once when its value falls from there.
  bool holds_at_start(const Watch& watch) const {
    const double value = watch.value(result_.t, result_.y);
    if (value != 0) return !(value < 0);
    const double h = 1e-9 * std::min(1.0, request_.t_end - request_.t_start);
    std::vector<double> y = result_.y, slope(y.size());
    if (sections_.system().derivative(result_.t, y, slope) != Evaluation::ok) return true;
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += h * slope[i];
    return !(watch.value(result_.t + h, y) < 0);
  }

  void check_configuration() const {
    for (const Watch& watch : sections_.watches()) {
      if (watch.kind != Watch::Kind::singularity) continue;
      const double value = watch.value(result_.t, result_.y);
      if (watch.direction == Crossing::falling ? value > 0 : value != 0) continue;
      throw Error(ErrorCode::invalid_state, watch.message);
    }
  }

  /// Integrates to the next impact. True when there was one.
  bool segment() {
    segments_.push_back({result_.rows, result_.t, result_.y});
    while (is_determined_) {
      const Run done = section();
      if (record_events(done)) return true;
      if (result_.stop) return false;
      if (leaves_rest(done)) continue;
      if (done.ending != Ending::event) return false;
      if (done.t >= request_.t_end) {
        result_.ending = Ending::reached_end;
        return false;
      }
      is_determined_ = sections_.pass(result_.t, result_.y, kinks_met(done));
    }
    result_.ending = Ending::undetermined;
    return false;
  }

  /// Whether the motion goes on by a step away from a place where a speed is zero, or after one.
  [[nodiscard]] bool leaves_rest(const Run& done) const {
    if (done.ending == Ending::event) return false;
    if (done.ending == Ending::reached_end) return done.t < request_.t_end;
    return done.steps > 0 && from_rest_.length(done.t, done.y, sections_.system()).has_value();
  }

  /// Integrates to the next kink or impact, or by one short step away from rest.
  Run section() {
    RunRequest run;
    run.t_start = result_.t;
    run.y_start = result_.y;
    run.t_end = request_.t_end;
    run.grid = std::span(request_.grid).subspan(result_.rows);
    run.method = request_.method;
    const std::optional<double> step = from_rest_.length(run.t_start, run.y_start, sections_.system());
    if (step) {
      run.method = Method::erk;
      run.t_end = std::min(run.t_end, run.t_start + *step);
      run.grid = run.grid.first(
          static_cast<std::size_t>(std::ranges::upper_bound(run.grid, run.t_end) - run.grid.begin()));
    }
    run.taylor_order = request_.taylor_order;
    run.is_reference = request_.is_reference;
    run.tolerances = request_.tolerances;
    run.h = request_.h;
    run.limits = request_.limits;
    run.limits.max_steps -= std::min(run.limits.max_steps, result_.steps);
    run.limits.max_evaluations -= std::min(run.limits.max_evaluations, result_.evaluations);
    for (const Watch& watch : sections_.watches()) run.events.push_back(watch.event());
    for (EventFunction& end : sections_.ends()) run.events.push_back(std::move(end));
    Run done = integrate(sections_.system(), run);
    if (step) enclose(run, done);
    add_unseen(done);
    result_.rows += done.rows;
    if (result_.states.empty()) {
      result_.states = std::move(done.states);
    } else {
      result_.states.insert(result_.states.end(), done.states.begin(), done.states.end());
    }
    row_sections_.resize(result_.rows, sections_.section());
    result_.steps += done.steps;
    result_.evaluations += done.evaluations;
    result_.ending = done.ending;
    result_.t = done.t;
    result_.y = done.y;
    return done;
  }

  [[nodiscard]] std::vector<bool> kinks_met(const Run& done) const {
    std::vector<bool> met(sections_.kinks());
    const std::size_t first = sections_.watches().size();
    for (const EventOccurrence& occurrence : done.events) {
      if (occurrence.event >= first && occurrence.t == done.t) met[occurrence.event - first] = true;
    }
    return met;
  }

  /// A step away from rest is not Taylor's; what it may be off by is known otherwise.
  void enclose(const RunRequest& run, Run& done) const {
    const auto off = from_rest_.bound(run.t_start, run.y_start, done.t - run.t_start);
    done.bounded = off.has_value();
    if (!off) return;
    done.unseen_at_end = *off;
    done.unseen.resize(done.states.size());
    for (std::size_t i = 0; i < done.unseen.size(); ++i) done.unseen[i] = (*off)[i % off->size()];
  }

  /// What a section may hide stays in doubt after it.
  void add_unseen(const Run& done) {
    const std::size_t width = result_.y.size(), before = result_.rows * width;
    result_.bounded = result_.bounded && done.bounded;
    if (unseen_.empty() && done.unseen_at_end.empty()) return;
    unseen_.resize(width);
    result_.unseen.resize(before + done.rows * width);
    for (std::size_t i = 0; i < done.rows * width; ++i) {
      result_.unseen[before + i] = unseen_[i % width] + (i < done.unseen.size() ? done.unseen[i] : 0);
    }
    for (std::size_t k = 0; k < done.unseen_at_end.size(); ++k) unseen_[k] += done.unseen_at_end[k];
  }

  bool record_events(const Run& done) {
    bool impact = false;
    for (const EventOccurrence& occurrence : done.events) {
      if (occurrence.event >= sections_.watches().size()) continue;  // a kink
      const Watch& watch = sections_.watches()[occurrence.event];
      const bool last = done.ending == Ending::event && occurrence.t == done.t;
      if (watch.kind == Watch::Kind::event || watch.kind == Watch::Kind::impact) {
        result_.events.push_back({watch.name, occurrence.t, occurrence.y});
        if (result_.events.size() > most_occurrences)
          throw Error(ErrorCode::too_large, "the motion meets more events than one answer may hold");
        impact = impact || watch.kind == Watch::Kind::impact;
      } else if (last && !result_.stop) {
        result_.stop = Stop{watch.reason, occurrence.t, watch.message};
      }
    }
    return impact && !result_.stop;
  }

  /// Goes on from the state after the impact; false when the motion is over there anyway.
  bool apply_impact() {
    const ImpactMap map = impact_map(dynamics_.model());
    std::vector<double> after = result_.y;
    map.assign(values_at(dynamics_, map.components, request_.parameters, result_.t, result_.y), after);
    const double begin = result_.sections.empty() ? request_.t_start : result_.sections.back().t;
    result_.sections.push_back({result_.t, result_.t - begin, result_.y, after});
    if (result_.t >= request_.t_end || result_.sections.size() == request_.end_after_impacts) {
      result_.ending = Ending::reached_end;
      return false;
    }
    if (const auto rest = rest_of_impacts()) {
      result_.t += *rest;
      result_.stop = Stop{"impacts_accumulate", result_.t, accumulation};
      return false;
    }
    result_.y = std::move(after);
    is_determined_ = sections_.begin(result_.t, result_.y);
    return true;
  }

  /// How long all further impacts take together, where they follow each other faster and faster: sections
  /// that are each q times as long as the one before leave d q/(1 - q).
  [[nodiscard]] std::optional<double> rest_of_impacts() const {
    const std::vector<SectionRecord>& sections = result_.sections;
    const double last = sections.back().duration;
    if (last <= 16 * time_round_off(result_.t)) return 0;
    if (sections.size() < similar_sections) return std::nullopt;
    double least = infinity, most = 0;
    for (std::size_t i = sections.size() - similar_sections + 1; i < sections.size(); ++i) {
      const double ratio = sections[i].duration / sections[i - 1].duration;
      least = std::min(least, ratio);
      most = std::max(most, ratio);
    }
    if (!(most < 1) || most - least > similar * (1 - most)) return std::nullopt;
    const double rest = last * most / (1 - most);
    if (rest > negligible * (request_.t_end - request_.t_start)) return std::nullopt;
    return rest;
  }

  [[nodiscard]] std::span<const double> row(std::size_t i) const {
    return std::span(result_.states).subspan(i * request_.y_start.size(), request_.y_start.size());
  }

  void fill_columns() {
    if (request_.columns.empty()) return;
    const std::size_t width = request_.columns.size();
    result_.columns.resize(result_.rows * width);
    for (std::size_t i = 0; i < result_.rows; ++i) {
      if (i % 256 == 0) check_interruption();
      const std::span<double> out = std::span(result_.columns).subspan(i * width, width);
      auto& [function, workspace] = sections_.columns_in(row_sections_[i]);
      if (function->evaluate(request_.grid[i], row(i), workspace, out) == Evaluation::ok) continue;
      throw Error(ErrorCode::invalid_state, "One of the columns has no finite value along this motion.");
    }
  }

  /// Drift is counted from the beginning of each segment: what an impact takes is no drift.
  void fill_conserved() {
    const auto conserved = dynamics_.conserved(request_.parameters);
    const std::size_t count = conserved->quantities.size();
    if (count == 0 || result_.rows == 0) return;
    Workspace workspace = conserved->values->bind(request_.parameters);
    std::vector<double> reference(count), value(count), drift(count);
    const auto evaluate = [&](double t, std::span<const double> y, std::vector<double>& out) {
      return conserved->values->evaluate(t, y, workspace, out) == Evaluation::ok;
    };
    std::vector<double> initial(count);
    if (!evaluate(request_.t_start, request_.y_start, initial)) return;
    for (std::size_t i = 0, next = 0; i < result_.rows; ++i) {
      if (i % 256 == 0) check_interruption();
      for (; next < segments_.size() && segments_[next].first_row <= i; ++next) {
        if (!evaluate(segments_[next].t, segments_[next].y, reference)) return;
      }
      if (!evaluate(request_.grid[i], row(i), value)) return;
      for (std::size_t k = 0; k < count && next > 0; ++k) {
        drift[k] = std::max(drift[k], std::abs(value[k] - reference[k]));
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      const ConservedQuantity& quantity = conserved->quantities[k];
      ConservedRecord record{quantity.name, quantity.unit, initial[k], drift[k], {}};
      const double relative = drift[k] / std::abs(initial[k]);
      if (std::isfinite(relative)) record.max_rel_drift = relative;
      result_.conserved.push_back(std::move(record));
    }
  }

  void fill_constraints() {
    const ConstraintSurface* surface = dynamics_.constraint_surface();
    if (surface == nullptr) return;
    ConstrainedStates states(*surface, request_.parameters);
    for (const Constraint& constraint : dynamics_.model().scene.constraints)
      result_.constraints.push_back({constraint.name, {}, 0});
    for (const std::size_t j : surface->position_of()) result_.constraints[j].max_abs_value = 0;
    for (std::size_t i = 0; i < result_.rows; ++i) {
      if (!states.evaluate(request_.grid[i], row(i))) continue;
      const std::span<const double> residuals = states.residuals();
      std::size_t k = 0;
      for (const std::size_t j : surface->position_of()) {
        double& value = *result_.constraints[j].max_abs_value;
        value = std::max(value, std::abs(residuals[k++]));
      }
      for (ConstraintRecord& record : result_.constraints)
        record.max_abs_rate = std::max(record.max_abs_rate, std::abs(residuals[k++]));
    }
  }

  /// What lies between two impacts.
  struct Segment {
    std::size_t first_row;
    double t;
    std::vector<double> y;
  };

  const Dynamics& dynamics_;
  const SimulationRequest& request_;
  MotionSections sections_;
  StartFromRest from_rest_;
  bool is_determined_{true};
  std::vector<std::size_t> row_sections_;  ///< for each row
  std::vector<Segment> segments_;
  std::vector<double> unseen_;  ///< of the sections before
  Simulation result_;
};

}  // namespace

Simulation simulate(const Dynamics& dynamics, const SimulationRequest& request) {
  return Simulator(dynamics, request).run();
}

}  // namespace qdot
