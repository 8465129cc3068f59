#include "core/motion/kept_together.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace qdot {
namespace {

constexpr double clearly_apart = 64;  ///< roundings of the distance

/// From one impact to the next one of its number.
class KeptTogether {
 public:
  KeptTogether(Bounce& bounce, std::size_t width) : bounce_(bounce), off_(width) {}

  /// What the next row may be off by; all 0 while nothing has pressed.
  const std::vector<double>& at(double t, const std::vector<double>& y) {
    const Watch& watch = bounce_.watch();
    const double side = watch.direction == Crossing::falling ? 1 : -1, g = side * watch.value(t, y);
    const bool is_there = !watch.condition || watch.condition(t, y) > 0;
    have_parted_ = have_parted_ || !is_there || g > clearly_apart * watch.own_rounding(t, y);
    const std::size_t n = off_.size() / 2;
    for (std::size_t i = 0; i < n; ++i) off_[i] += (t - t_) * (have_parted_ ? off_[n + i] : 0);
    if (!have_parted_ && g < 0) widen(t, y, -g);
    t_ = t;
    return off_;
  }

  [[nodiscard]] bool is_over() const {
    return have_parted_ && std::ranges::all_of(off_, [](double x) { return x == 0; });
  }

 private:
  void widen(double t, const std::vector<double>& y, double depth) {
    const std::vector<double> way = bounce_.way(t, y), kick = bounce_.kick(t, y);
    for (std::size_t i = 0; i < way.size(); ++i) {
      off_[i] = std::max(off_[i], depth * std::abs(way[i]));
      off_[way.size() + i] = std::max(off_[way.size() + i], std::abs(kick[i]));
    }
  }

  Bounce& bounce_;
  std::vector<double> off_;
  double t_{};  ///< of the last row
  bool have_parted_{false};
};

}  // namespace

void doubt_kept_together(const ComputedMotion& motion, std::size_t number, Bounce& bounce,
                         Simulation& check) {
  if (bounce.watch().direction == Crossing::either) return;
  const std::vector<SectionRecord>& sections = motion.simulation.sections;
  const std::size_t width = motion.width();
  const std::span<const double> instants = std::span(motion.event_rows.instants()).first(check.rows);
  const auto is_of_it = [&](const SectionRecord& section) {
    return std::ranges::find(section.impacts, number) != section.impacts.end();
  };
  for (auto impact = std::ranges::find_if(sections, is_of_it); impact != sections.end();) {
    const auto next = std::find_if(impact + 1, sections.end(), is_of_it);
    const auto first = std::ranges::upper_bound(instants, impact->t),
               last = next == sections.end() ? instants.end() : std::ranges::upper_bound(instants, next->t);
    const bool is_plastic = bounce.leaves_nothing(impact->t, impact->after, *impact);
    KeptTogether kept(bounce, width);
    for (auto t = first; is_plastic && t < last && !kept.is_over(); ++t) {
      const std::size_t at = static_cast<std::size_t>(t - instants.begin()) * width;
      const auto begin = check.states.begin() + static_cast<std::ptrdiff_t>(at);
      const std::vector<double>& off = kept.at(*t, {begin, begin + static_cast<std::ptrdiff_t>(width)});
      check.unseen.resize(check.rows * width);
      for (std::size_t k = 0; k < width; ++k) check.unseen[at + k] += off[k];
    }
    impact = next;
  }
}

}  // namespace qdot
