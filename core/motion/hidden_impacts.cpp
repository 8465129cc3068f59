#include "core/motion/hidden_impacts.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/watch.hpp"
#include "core/motion/accumulation.hpp"
#include "core/motion/bounce.hpp"
#include "core/motion/kept_together.hpp"

namespace qdot {
namespace {

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

  void doubt_kept() {
    for (std::size_t i = 0; i < bounces_.size(); ++i) doubt_kept_together(motion_, i, bounces_[i], check_);
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
  hidden.doubt_kept();
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
