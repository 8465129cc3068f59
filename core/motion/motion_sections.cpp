#include "core/motion/motion_sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/error.hpp"
#include "core/integrate/events.hpp"
#include "core/integrate/methods.hpp"
#include "core/motion/kink_ends.hpp"
#include "core/motion/motion_system.hpp"
#include "core/motion/typed_start.hpp"
#include "core/numerics/root.hpp"

namespace qdot {
namespace {

constexpr double farthest_apart = 16;  ///< times what an instant and rounding move a motion
/// As in kink_ends.cpp: so far a motion goes over a kink before it is met once more.
constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();
constexpr double round_offs = 16;  ///< of t: what is nearer happens at one instant

WatchRequest watch_request(const SimulationRequest& request) {
  return {.parameters = request.parameters,
          .events = request.events,
          .on_invalid = request.on_invalid,
          .impacts = request.impacts,
          .staying = nullptr};
}

}  // namespace

MotionSections::MotionSections(const Dynamics& dynamics, const SimulationRequest& request)
    : dynamics_(dynamics),
      request_(request),
      resolution_(round_offs * time_round_off(std::max({std::abs(request.t_start), std::abs(request.t_end),
                                                        request.t_end - request.t_start}))) {
  if (!record_of(request.method).has_fixed_step() && dynamics.kinks() != nullptr) {
    names_ = dynamics.kinks()->names;
    modes_ = std::make_unique<KinkModes>(dynamics, request.parameters, resolution_);
    since_.resize(names_.size());
    return;
  }
  now_ = &sections_[{}];
  now_->system = motion_system(dynamics, request);
  if (request.originals) {
    const auto& [asked, rounded] = *request.originals;
    now_->originals =
        motions_stood_for(dynamics, nullptr, asked.parameters, rounded.parameters, request.method);
  }
  now_->watches = qdot::watches(dynamics, watch_request(request));
  now_->parameters = request.parameters;
  history_.push_back(now_);
}

bool MotionSections::begin(double t, std::vector<double>& y) {
  if (!modes_) return true;
  met_.assign(names_.size(), false);
  tried_.clear();
  if (now_ == nullptr) modes_->begin_at(typed_start(request_));
  if (!go_on(t, y)) return false;
  doubt_of_begin_ = modes_->doubt_of_begin(way_);
  modes_->settle(way_, t, y);
  note_size(y);
  return true;
}

void MotionSections::note_size(std::span<const double> y) {
  largest_.resize(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) largest_[i] = std::max(largest_[i], std::abs(y[i]));
}

bool MotionSections::pass(double t, std::vector<double>& y, const std::vector<bool>& met) {
  if (t - t_ > resolution_) {
    tried_.clear();
    met_.assign(names_.size(), false);
  }
  bool is_first = true;  // time in this instant
  for (std::size_t k = 0; k < met.size(); ++k) {
    is_first = is_first && !(met_[k] && met[k]);
    met_[k] = met_[k] || met[k];
  }
  note_size(y);
  const Sides before = way_.sides;
  const double begun = t_;
  doubt_of_instant_ = moved_instant_ = 0;
  is_unclear_ = is_instant_hidden_ = false;
  if (go_on(t, y)) {
    if (is_first) take_back(before, begun, t, y);
  } else if (!(come_together(t, y) && go_on(t, y))) {
    return false;
  }
  modes_->settle(way_, t, y);
  return true;
}

/// The kinks were met a little before t or after it: by the round-off of t and of their arguments, and where
/// the motion came back to a kink at which the section began, by the margin of that (kink_ends.cpp).
void MotionSections::take_back(const Sides& before, double begun, double t, std::vector<double>& y) {
  const KinkPassage passage = modes_->passage(before, way_, t, y, t - begun);
  doubt_of_instant_ = passage.doubt;
  moved_instant_ = passage.early;
  is_instant_hidden_ = passage.is_hidden;
  is_unclear_ = passage.is_unclear;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += passage.move[i];
}

/// Kinks that follow each other again and again within one instant are met together: infinitely many turns
/// end there. False where it is farther to them than rounding, and an instant, may have moved the motion.
bool MotionSections::come_together(double t, std::vector<double>& y) {
  KinkModes::Way together{.sides = way_.sides};
  for (std::size_t k = 0; k < met_.size(); ++k) {
    if (met_[k]) together.begins.push_back(k);
  }
  std::vector<double> there = y, rate(y.size());
  if (together.begins.size() < 2 || now_->system.derivative(t, y, rate) != Evaluation::ok) return false;
  modes_->settle(together, t, there);
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double near = resolution_ * std::abs(rate[i]) + rounding * largest_[i];
    if (std::abs(there[i] - y[i]) > farthest_apart * near) return false;
  }
  y = there;
  tried_.clear();
  return true;
}

/// No way is tried twice at one instant.
bool MotionSections::go_on(double t, std::span<const double> y) {
  const std::optional<KinkModes::Way> way = modes_->way_on(t, y, met_);
  const bool is_known = way && tried_.insert(way->sides).second;
  if (is_known) {
    enter(*way, t);
  } else if (now_ == nullptr) {
    enter({modes_->sides_at(t, y), std::vector<unsigned>(names_.size()), {}, {}}, t);
  }
  return is_known;
}

void MotionSections::enter(const KinkModes::Way& way, double t) {
  way_ = way;
  t_ = t;
  const auto [place, is_new] = sections_.try_emplace(way.sides);
  now_ = &place->second;
  if (is_new) {
    now_->staying = staying_on(way.sides);
    now_->parameters = modes_->parameters(way.sides);
    now_->system = motion_system(dynamics_, way.sides, now_->parameters, request_.method);
    if (request_.originals) {
      const auto with_sides = [&](std::vector<double> parameters) {
        parameters.insert(parameters.end(), way.sides.begin(), way.sides.end());
        return parameters;
      };
      now_->originals =
          motions_stood_for(dynamics_, &way.sides, with_sides(request_.originals->asked.parameters),
                            with_sides(request_.originals->rounded.parameters), request_.method);
    }
    WatchRequest watched = watch_request(request_);
    watched.parameters = now_->parameters;
    watched.staying = &now_->staying;
    now_->watches = qdot::watches(dynamics_, watched);
  }
  history_.push_back(now_);
  for (std::size_t k = 0; k < names_.size(); ++k) {
    if (way.sides[k] == 0) {
      if (!since_[k]) since_[k] = t;
    } else if (since_[k]) {
      if (t > *since_[k]) stays_.push_back({names_[k], *since_[k], t});
      since_[k].reset();
    }
  }
  if (stays_.size() > most_occurrences)
    throw Error(ErrorCode::too_large, "the motion meets more events than one answer may hold");
}

void MotionSections::finish(double t) {
  for (std::size_t k = 0; k < since_.size(); ++k) {
    if (since_[k] && t > *since_[k]) stays_.push_back({names_[k], *since_[k], t});
  }
}

std::vector<double> MotionSections::slopes(double t, std::span<const double> y) const {
  std::vector<double> result(y.size());
  if (system().derivative(t, y, result) != Evaluation::ok) std::ranges::fill(result, 0);
  return result;
}

std::vector<double> MotionSections::rows(double t, std::span<const double> y) const {
  constexpr std::size_t width = Approach::order + 1;
  const std::size_t n = y.size() / 2;
  const std::vector<double> rates = slopes(t, y);
  std::vector<double> result(width * y.size());
  for (std::size_t k = 0; k < y.size(); ++k) {
    result[width * k] = y[k];
    result[width * k + 1] = rates[k];
    if (k < n) result[width * k + 2] = rates[n + k] / 2;
  }
  return result;
}

std::vector<EventFunction> MotionSections::ends() const {
  return modes_ ? kink_ends(*modes_, way_, t_, request_.method, request_.tolerances)
                : std::vector<EventFunction>{};
}

ApproachRecord MotionSections::approach(Approach place, double begun) const {
  ApproachRecord record{.place = std::move(place), .name = {}, .begun = begun, .enclosure = {}};
  if (record.place.event < watches().size()) {
    const Watch& watch = watches()[record.place.event];
    record.name = watch.name;
    record.ends_motion = watch.kind != Watch::Kind::impact;
    record.enclosure = record.place.is_condition ? watch.when_enclosure : watch.enclosure;
    if (record.place.is_condition) record.of_event = watch.enclosure;
    if (is_jump(record.place.event))
      record.of_event = std::ranges::find(watches(), watch.name, &Watch::name)->enclosure;
    return record;
  }
  const std::size_t kink = record.place.event - watches().size();
  const std::shared_ptr<const KinkedMotion> functions = modes_->motion(way_.sides);
  record.name = names_[kink];
  record.is_kink = true;
  record.stays = way_.sides[kink] == 0;
  const auto u = enclosure_of(record.stays ? functions->holds[kink] : functions->arguments[kink],
                              modes_->parameters(way_.sides));
  const Interval factor = way_.sides[kink] < 0 ? -1 : 1;  // as in kink_ends.cpp
  record.enclosure = [=](const Interval& t, std::span<const Interval> y) { return factor * u(t, y); };
  return record;
}

MotionSections::Columns& MotionSections::columns_in(std::size_t section) {
  Section& in = *history_[section];
  if (!in.columns.function) {
    in.columns.function = dynamics_.columns(request_.columns, modes_ ? &in.staying : nullptr);
    in.columns.workspace = in.columns.function->bind(in.parameters);
  }
  return in.columns;
}

}  // namespace qdot
