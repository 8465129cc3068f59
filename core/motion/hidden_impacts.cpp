#include "core/motion/hidden_impacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/watch.hpp"
#include "core/motion/accumulation.hpp"
#include "core/motion/impact_map.hpp"

namespace qdot {
namespace {

/// The velocities that `after` has and y has not.
std::vector<double> kick(const std::vector<double>& y, const std::vector<double>& after) {
  std::vector<double> change;
  for (std::size_t i = y.size() / 2; i < y.size(); ++i) change.push_back(after[i] - y[i]);
  return change;
}

constexpr double rounding_of_kick = 64 * std::numeric_limits<double>::epsilon();

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

std::vector<Watch> watches_of_impacts(const ComputedMotion& motion) {
  std::vector<Watch> found =
      watches(motion.dynamics, {.parameters = motion.request.parameters, .on_invalid = OnInvalid::go_on});
  std::erase_if(found, [](const Watch& watch) { return watch.kind != Watch::Kind::impact; });
  return found;
}

/// One of the scene's impacts.
class Bounce {
 public:
  Bounce(const ComputedMotion& motion, const ParsedImpact& impact, const Watch& watch)
      : watch_(watch),
        map_(impact_map(motion.dynamics.model(), impact)),
        components_(motion.dynamics.columns(map_.components)),
        workspace_(components_->bind(motion.request.parameters)) {}

  [[nodiscard]] const Watch& watch() const { return watch_; }

  /// Whether another one at (t, y) would change nothing of what it has changed before, but for rounding.
  [[nodiscard]] bool leaves_nothing(double t, const std::vector<double>& y, const SectionRecord& before) {
    const std::vector<double> now = kick(y, map(t, y)), first = kick(before.before, before.after);
    return std::sqrt(product(now, now)) <= rounding_of_kick * std::sqrt(product(first, first));
  }

  /// What it changes, if the motion goes on towards it: it turns what it takes back, and so it did before.
  [[nodiscard]] std::vector<double> change(double t, const std::vector<double>& y,
                                           const SectionRecord& before) {
    const std::vector<double> after = map(t, y), now = kick(y, after);
    const bool turns = product(now, kick(after, map(t, after))) < 0;
    const bool falls = product(now, kick(before.before, before.after)) > 0;
    return turns && falls ? now : std::vector<double>(now.size());
  }

 private:
  std::vector<double> map(double t, std::vector<double> y) {
    std::vector<double> values(map_.places.size());
    if (components_->evaluate(t, y, workspace_, values) == Evaluation::ok) map_.assign(values, y);
    return y;
  }

  const Watch& watch_;
  ImpactMap map_;
  std::shared_ptr<const CompiledFunction> components_;
  Workspace workspace_;
};

class HiddenImpacts {
 public:
  HiddenImpacts(const ComputedMotion& motion, Simulation& check)
      : motion_(motion), check_(check), watches_(watches_of_impacts(motion)) {
    for (const ParsedImpact& impact : motion.dynamics.model().parsed.impacts)
      bounces_.emplace_back(motion, impact, watches_[bounces_.size()]);
  }

  /// At the rows after an impact, up to the next.
  void look(const SectionRecord& impact, double next) {
    const std::span<const double> instants = std::span(motion_.event_rows.instants()).first(check_.rows);
    const auto first = std::ranges::upper_bound(instants, impact.t);
    for (auto t = first; t != instants.end() && *t <= next; ++t) {
      const auto row = static_cast<std::size_t>(t - instants.begin());
      if (!look_at(row, *t, impact)) return;
    }
  }

 private:
  /// False where the motion has left the place: what comes then is seen.
  bool look_at(std::size_t row, double t, const SectionRecord& impact) {
    const std::size_t width = motion_.width(), n = width / 2;
    const double* begin = check_.states.data() + row * width;
    const std::vector<double> y(begin, begin + width);
    const double since = t - impact.t;
    bool any = false;
    for (const std::size_t number : impact.impacts) {
      Bounce& bounce = bounces_[number];
      if (!is_hidden_since(bounce.watch(), impact, t, y)) continue;
      any = true;
      const std::vector<double> change = bounce.change(t, y, impact);
      check_.unseen.resize(check_.rows * width);
      for (std::size_t i = 0; i < n; ++i) {
        check_.unseen[row * width + n + i] += std::abs(change[i]);
        check_.unseen[row * width + i] += since * std::abs(change[i]);
      }
    }
    return any;
  }

  const ComputedMotion& motion_;
  Simulation& check_;
  std::vector<Watch> watches_;
  std::vector<Bounce> bounces_;
};

/// Of what is watched, where the motion ends within these errors.
std::vector<EventDoubt> near_zero_at_end(const ComputedMotion& motion, std::span<const double> errors,
                                         const std::vector<Watch>& watched) {
  const Simulation& simulation = motion.simulation;
  std::vector<Interval> box;
  for (std::size_t k = 0; k < errors.size(); ++k)
    box.emplace_back(simulation.y[k] - errors[k], simulation.y[k] + errors[k]);
  std::vector<EventDoubt> doubts;
  for (const Watch& watch : watched) {
    const Interval distance = watch.enclosure(simulation.t, box);
    if (!distance.contains(0.0)) continue;
    doubts.push_back({watch.name, "Where the motion ends it is as near to '" + watch.name +
                                      "' as its error: whether it happens there cannot be told."});
  }
  return doubts;
}

/// Whether that impact was met last, and bodies go on together: another one would change nothing.
bool stay_together(const ComputedMotion& motion, std::size_t number, const Watch& watch) {
  const Simulation& simulation = motion.simulation;
  if (simulation.sections.empty()) return false;
  const SectionRecord& last = simulation.sections.back();
  if (std::ranges::find(last.impacts, number) == last.impacts.end()) return false;
  Bounce bounce(motion, motion.dynamics.model().parsed.impacts[number], watch);
  return is_hidden_since(watch, last, simulation.t, simulation.y) &&
         bounce.leaves_nothing(simulation.t, simulation.y, last);
}

/// Impacts, where they do not.
std::vector<Watch> watches_that_may_follow(const ComputedMotion& motion) {
  const std::vector<Watch> all = watches_of_impacts(motion);
  std::vector<Watch> found;
  for (std::size_t number = 0; number < all.size(); ++number) {
    if (!stay_together(motion, number, all[number])) found.push_back(all[number]);
  }
  return found;
}

}  // namespace

void add_hidden_impacts(const ComputedMotion& motion, Simulation& check) {
  const std::vector<SectionRecord>& sections = motion.simulation.sections;
  if (sections.empty() || check.rows == 0) return;
  HiddenImpacts hidden(motion, check);
  for (std::size_t i = 0; i < sections.size(); ++i)
    hidden.look(sections[i], i + 1 < sections.size() ? sections[i + 1].t : motion.simulation.t);
}

std::vector<EventDoubt> impacts_hidden_at_end(const ComputedMotion& motion) {
  const Simulation& simulation = motion.simulation;
  const bool accumulate = simulation.stop && simulation.stop->reason == impacts_accumulate;
  if (simulation.sections.empty() || accumulate) return {};
  const SectionRecord& last = simulation.sections.back();
  if (last.t == simulation.t) return {};
  const std::vector<Watch> all = watches_of_impacts(motion);
  std::vector<EventDoubt> doubts;
  for (const std::size_t number : last.impacts) {
    if (!is_hidden_since(all[number], last, simulation.t, simulation.y)) continue;
    if (stay_together(motion, number, all[number])) continue;
    const std::string& name = motion.dynamics.model().parsed.impacts[number].event;
    doubts.push_back({name, "From the last '" + name +
                                "' to the end the distance is no larger than its rounding: "
                                "there may be more impacts than were met, and they may accumulate."});
  }
  return doubts;
}

std::vector<EventDoubt> impacts_at_end(const ComputedMotion& motion, std::span<const double> errors) {
  const Simulation& simulation = motion.simulation;
  const bool has_just_passed = !simulation.sections.empty() && simulation.sections.back().t == simulation.t;
  const bool is_wanted = motion.request.impacts == Impacts::apply && !errors.empty();
  if (!is_wanted || simulation.stop || has_just_passed) return {};
  return near_zero_at_end(motion, errors, watches_that_may_follow(motion));
}

std::vector<EventDoubt> events_at_end(const ComputedMotion& motion, std::span<const double> errors) {
  const Simulation& simulation = motion.simulation;
  const std::size_t n = simulation.y.size() / 2;
  const bool moves = std::ranges::any_of(std::span(simulation.y).last(n), [](double v) { return v != 0; });
  if (motion.request.events.empty() || errors.empty() || simulation.stop || !moves) return {};
  std::vector<Watch> reported = watches(motion.dynamics, {.parameters = motion.request.parameters,
                                                          .events = motion.request.events,
                                                          .on_invalid = OnInvalid::go_on,
                                                          .impacts = Impacts::ignore});
  const auto is_met_there = [&](const std::string& name) {
    return std::ranges::any_of(simulation.events, [&](const EventRecord& event) {
      return event.name == name && event.t == simulation.t;
    });
  };
  const std::vector<Watch> all = watches_of_impacts(motion), may_follow = watches_that_may_follow(motion);
  const auto is_one_of = [](const std::vector<Watch>& some, const std::string& name) {
    return std::ranges::find(some, name, &Watch::name) != some.end();
  };
  std::erase_if(reported, [&](const Watch& watch) {
    const bool stays = is_one_of(all, watch.name) && !is_one_of(may_follow, watch.name);
    return watch.kind != Watch::Kind::event || is_met_there(watch.name) || stays;
  });
  return near_zero_at_end(motion, errors, reported);
}

}  // namespace qdot
