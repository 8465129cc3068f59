#include "core/numerics/root_isolation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/work.hpp"

namespace qdot {
namespace {

constexpr double small_box = 1e-2;  ///< below it a box is looked at with Newton's method
constexpr double least_box = 1e-14;
constexpr double wide_enclosure = 1e-4;  ///< of a zero: Newton's iteration is quicker than contraction
constexpr std::size_t most_starts = 500;
constexpr std::size_t boxes_per_start = 40;  ///< where fewer boxes are looked at, so are fewer starts
constexpr double widest_cluster = 0.05;      ///< wider ones are no place but a region

/// Of the work that a question may cost (core/base/work.hpp), so much is left to what comes after a search.
constexpr std::uint64_t part_for_others = 4;

bool may_vanish(const Box& values) {
  return std::ranges::all_of(values, [](const Interval& v) { return v.contains(0.0); });
}

std::vector<double> completed(std::span<const double> scales, std::size_t dimension) {
  std::vector<double> all(scales.begin(), scales.end());
  all.resize(dimension, 1.0);
  return all;
}

Box nearest_to_zero(const Box& region) {
  Box place;
  for (const Interval& side : region) place.emplace_back(std::clamp(0.0, side.lower, side.upper));
  return place;
}

bool comes_before(const IsolatedZero& a, const IsolatedZero& b) {
  return std::ranges::lexicographical_compare(
      a.enclosure, b.enclosure, [](const Interval& x, const Interval& y) { return x.upper < y.lower; });
}

class Isolator {
 public:
  Isolator(const SquareSystem& system, std::span<const double> scales)
      : system_(system), units_(completed(scales, system.dimension)) {}

  Isolation run(const Box& region, std::size_t most_boxes) {
    push(region);
    Isolation result;
    const std::uint64_t kept_for_others = work_left() / part_for_others;
    for (std::size_t boxes = 0; !waiting_.empty(); ++boxes) {
      if (boxes == most_boxes || work_left() < kept_for_others) {
        result.complete = false;
        look_for_zeros_in_what_is_left(region, std::min(most_starts, most_boxes / boxes_per_start),
                                       kept_for_others / 2);
        break;
      }
      examine(pop());
    }
    for (const Box& cluster : clusters(unresolved_)) prove_around(cluster);
    result.zeros = std::move(zeros_);
    for (Box& cluster : clusters(unresolved_)) {
      if (units_.width(cluster) > widest_cluster) {
        result.undecided.push_back(std::move(cluster));
      } else {
        result.zeros.push_back({std::move(cluster), false});
      }
    }
    result.poles = clusters(poles_);
    std::ranges::sort(result.zeros, comes_before);
    return result;
  }

 private:
  /// Throws the box away, settles it, or pushes what is left of it.
  void examine(Box box) {
    if (is_settled(box)) return;
    const Box here = values_over(system_, box);
    if (!may_vanish(here) || (system_.excluded && system_.excluded(box, here))) return;
    Box contracted = krawczyk(system_, box);
    if (is_inside(contracted, box)) return settle(box, std::move(contracted));
    const double before = units_.width(box);
    for (std::size_t i = 0; i < box.size(); ++i) {
      contracted[i] = intersection(contracted[i], box[i]);
      if (is_empty(contracted[i])) return;
    }
    if (units_.width(contracted) < 0.6 * before) return push(std::move(contracted));
    if (before < small_box && (settled_near(contracted) || is_below_resolution(contracted))) return;
    bisect(contracted);
  }

  /// The widest box comes next, so that a place where none can be thrown away does not keep the others
  /// waiting; and what is nearer to 0 before what is far away: of infinitely many zeros, these are found.
  void push(Box box) {
    const double size = units_.width(box) / (1 + units_.distance(box));
    waiting_.push_back({size, std::move(box)});
    std::push_heap(waiting_.begin(), waiting_.end());
  }
  Box pop() {
    std::pop_heap(waiting_.begin(), waiting_.end());
    Box box = std::move(waiting_.back().box);
    waiting_.pop_back();
    return box;
  }

  /// What was not finished may still show zeros: those of the region to which Newton's iteration leads from
  /// the place nearest to 0, whatever is left, and from some middles.
  void look_for_zeros_in_what_is_left(const Box& region, std::size_t starts, std::uint64_t kept_for_others) {
    look_for_zero(nearest_to_zero(region), region);
    for (std::size_t i = 0; i < starts && !waiting_.empty() && work_left() >= kept_for_others; ++i)
      look_for_zero(middle(pop()), region);
  }

  void look_for_zero(const Box& from, const Box& region) {
    const std::optional<Box> start = newton(system_, from);
    if (!start || !overlap(*start, region)) return;
    const Box around = units_.around(*start, 1e-6);
    Box contracted = krawczyk(system_, around);
    if (!is_settled(contracted) && is_inside(contracted, around)) settle(around, std::move(contracted));
  }

  [[nodiscard]] bool is_settled(const Box& box) const {
    return std::any_of(regions_.begin(), regions_.end(),
                       [&](const Box& region) { return contains(region, box); });
  }

  /// `region` holds one zero, and `enclosure` holds it: contracted as far as it goes.
  void settle(const Box& region, Box enclosure) {
    for (;;) {
      const bool wide = units_.width(enclosure) > wide_enclosure;
      if (auto narrow = wide ? narrowed(enclosure) : std::nullopt) enclosure = std::move(*narrow);
      Box next = krawczyk(system_, enclosure);
      for (std::size_t i = 0; i < next.size(); ++i) next[i] = intersection(next[i], enclosure[i]);
      const bool improves = units_.width(next) < (wide ? 0.999 : 0.9) * units_.width(enclosure);
      enclosure = std::move(next);
      if (!improves) break;
    }
    regions_.push_back(region);
    for (IsolatedZero& zero : zeros_) {
      if (!zero.simple || !overlap(zero.enclosure, enclosure)) continue;
      if (contains(zero.alone, enclosure) || contains(region, zero.enclosure)) return;  // the same zero
      for (std::size_t i = 0; i < enclosure.size(); ++i)
        zero.enclosure[i] = hull(zero.enclosure[i], enclosure[i]);
      zero.simple = false;  // one or two: neither proof reaches the other
      zero.alone.clear();
      return;
    }
    zeros_.push_back({std::move(enclosure), true, region});
  }

  /// A smaller box of the zero that `enclosure` holds, where it is so wide that K(X) hardly contracts: around
  /// where Newton's iteration ends.
  [[nodiscard]] std::optional<Box> narrowed(const Box& enclosure) const {
    const std::optional<Box> end = newton(system_, middle(enclosure));
    if (!end) return std::nullopt;
    const Box box = units_.around(*end, 1e-9);
    if (!contains(enclosure, box)) return std::nullopt;
    Box contracted = krawczyk(system_, box);
    if (!is_inside(contracted, box)) return std::nullopt;
    return contracted;
  }

  /// A zero near a small box's edge: proves that it is alone in a larger box around it. True when that holds
  /// all of this one.
  bool settled_near(const Box& box) {
    const std::optional<Box> start = newton(system_, middle(box));
    if (!start) return false;
    const Box& c = *start;
    Box wide;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const double reach = 1.5 * box[i].width();
      if (!(std::abs(c[i].middle() - box[i].middle()) <= reach)) return false;
      wide.emplace_back(c[i].middle() - reach, c[i].middle() + reach);
    }
    Box contracted = krawczyk(system_, wide);
    if (!is_inside(contracted, wide)) return false;
    settle(wide, std::move(contracted));
    return is_settled(box);
  }

  /// One on the edge of the region, up to which boxes were contracted, may be simple: in a box around it that
  /// reaches beyond.
  void prove_around(const Box& cluster) {
    constexpr double reach = 1e-6;
    const std::optional<Box> start = newton(system_, middle(cluster));
    if (!start) return;
    const Box around = units_.around(*start, reach);
    Box contracted = krawczyk(system_, around);
    if (contains(around, cluster) && is_inside(contracted, around)) settle(around, std::move(contracted));
  }

  /// Whether round-off hides all signs in the box: at its middle and its ends every equation may vanish.
  bool is_below_resolution(const Box& box) {
    Box first, last;
    for (const Interval& x : box) {
      first.emplace_back(x.lower);
      last.emplace_back(x.upper);
    }
    const bool hidden = is_bounded(values_over(system_, box)) &&
                        may_vanish(values_over(system_, middle(box))) &&
                        may_vanish(values_over(system_, first)) && may_vanish(values_over(system_, last));
    if (units_.width(box) <= least_box && !is_bounded(values_over(system_, box))) {
      poles_.push_back(box);
      return true;
    }
    if (!hidden && units_.width(box) > least_box) return false;
    if (may_hold_zero(system_, box)) unresolved_.push_back(box);
    return true;
  }

  void bisect(const Box& box) {
    auto [left, right] = units_.halves(box);
    push(std::move(left));
    push(std::move(right));
  }

  /// As places; without those in which a zero was proven to be alone since.
  [[nodiscard]] std::vector<Box> clusters(std::vector<Box> boxes) const {
    std::erase_if(boxes, [&](const Box& box) { return is_settled(box); });
    return joined_where_they_touch(boxes);
  }

  struct Waiting {
    double size;
    Box box;
    bool operator<(const Waiting& other) const { return size < other.size; }
  };

  const SquareSystem& system_;
  BoxUnits units_;
  std::vector<Waiting> waiting_;  ///< a heap
  std::vector<IsolatedZero> zeros_;
  std::vector<Box> regions_;  ///< each holds exactly one zero
  std::vector<Box> unresolved_, poles_;
};

}  // namespace

Isolation isolate_zeros(const SquareSystem& system, const Box& region, std::span<const double> scales,
                        std::size_t most_boxes) {
  return Isolator(system, scales).run(region, most_boxes);
}

}  // namespace qdot
