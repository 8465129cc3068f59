#include "core/numerics/root_isolation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/work.hpp"
#include "core/numerics/dense_matrix.hpp"
#include "core/numerics/same_bits.hpp"

namespace qdot {
namespace {

constexpr double golden_cut = 0.4876;  ///< not a half: zeros like to lie at the middle of a region
constexpr double small_box = 1e-2;     ///< below it a box is looked at with Newton's method
constexpr double least_box = 1e-14;
constexpr double wide_enclosure = 1e-4;  ///< of a zero: Newton's iteration is quicker than contraction
constexpr std::size_t most_starts = 500;
constexpr std::size_t boxes_per_start = 40;  ///< where fewer boxes are looked at, so are fewer starts
constexpr double widest_cluster = 0.05;      ///< wider ones are no place but a region

/// Of the work that a question may cost (core/base/work.hpp), so much is left to what comes after a search.
constexpr std::uint64_t part_for_others = 4;

class Isolator {
 public:
  Isolator(const SquareSystem& system, std::span<const double> scales)
      : system_(system), scales_(scales.begin(), scales.end()) {
    scales_.resize(system.dimension, 1.0);
  }

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
    result.zeros = std::move(zeros_);
    for (Box& cluster : clusters(unresolved_)) {
      if (width(cluster) > widest_cluster) {
        result.undecided.push_back(std::move(cluster));
      } else {
        result.zeros.push_back({std::move(cluster), false});
      }
    }
    result.poles = clusters(poles_);
    std::sort(result.zeros.begin(), result.zeros.end(), [](const IsolatedZero& a, const IsolatedZero& b) {
      return std::lexicographical_compare(
          a.enclosure.begin(), a.enclosure.end(), b.enclosure.begin(), b.enclosure.end(),
          [](const Interval& x, const Interval& y) { return x.upper < y.lower; });
    });
    return result;
  }

 private:
  /// Throws the box away, settles it, or pushes what is left of it.
  void examine(Box box) {
    if (is_settled(box)) return;
    const Box here = values(box);
    if (!may_vanish(here) || (system_.excluded && system_.excluded(box, here))) return;
    Box contracted = krawczyk(box);
    if (inside(contracted, box)) return settle(box, std::move(contracted));
    const double before = width(box);
    for (std::size_t i = 0; i < box.size(); ++i) {
      contracted[i] = intersection(contracted[i], box[i]);
      if (is_empty(contracted[i])) return;
    }
    if (width(contracted) < 0.6 * before) return push(std::move(contracted));
    if (before < small_box && (settled_near(contracted) || is_below_resolution(contracted))) return;
    bisect(contracted);
  }

  /// The widest box comes next, so that a place where none can be thrown away does not keep the others
  /// waiting; and what is nearer to 0 before what is far away: of infinitely many zeros, these are found.
  void push(Box box) {
    const double size = width(box) / (1 + distance(box));
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
  /// some middles.
  void look_for_zeros_in_what_is_left(const Box& region, std::size_t starts, std::uint64_t kept_for_others) {
    for (std::size_t i = 0; i < starts && !waiting_.empty() && work_left() >= kept_for_others; ++i) {
      const std::optional<Box> start = newton(middle(pop()));
      if (!start || !overlap(*start, region)) continue;
      const Box around = around_point(*start, 1e-6);
      Box contracted = krawczyk(around);
      if (!is_settled(contracted) && inside(contracted, around)) settle(around, std::move(contracted));
    }
  }

  [[nodiscard]] Box values(const Box& x) const {
    Box result(x.size());
    system_.values(x, result);
    return result;
  }

  static bool may_vanish(const Box& values) {
    return std::all_of(values.begin(), values.end(), [](const Interval& v) { return v.contains(0.0); });
  }

  static bool is_bounded(const Box& values) {
    return std::all_of(values.begin(), values.end(), [](const Interval& v) { return v.is_finite(); });
  }

  static bool inside(const Box& a, const Box& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!(a[i].lower > b[i].lower && a[i].upper < b[i].upper)) return false;
    }
    return true;
  }

  static bool holds(const Box& outer, const Box& box) {
    for (std::size_t i = 0; i < box.size(); ++i) {
      if (!outer[i].contains(box[i])) return false;
    }
    return true;
  }

  static bool overlap(const Box& a, const Box& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (is_empty(intersection(a[i], b[i]))) return false;
    }
    return true;
  }

  [[nodiscard]] bool is_settled(const Box& box) const {
    return std::any_of(regions_.begin(), regions_.end(),
                       [&](const Box& region) { return holds(region, box); });
  }

  static Box middle(const Box& box) {
    Box c;
    for (const Interval& x : box) c.emplace_back(x.middle());
    return c;
  }

  /// J(c)^-1 rounded; no value where it is singular or not finite.
  [[nodiscard]] std::optional<Eigen::MatrixXd> inverse_at(const Box& c) const {
    const auto n = static_cast<Eigen::Index>(c.size());
    Box jacobian(c.size() * c.size());
    system_.jacobian(c, jacobian);
    Eigen::MatrixXd j(n, n);
    for (std::size_t k = 0; k < jacobian.size(); ++k) {
      j(static_cast<Eigen::Index>(k) / n, static_cast<Eigen::Index>(k) % n) = jacobian[k].middle();
    }
    if (!j.allFinite()) return std::nullopt;
    Eigen::MatrixXd result = inverse(j);
    if (!result.allFinite()) return std::nullopt;
    return result;
  }

  /// K(X); the box itself where the middle's Jacobian has no inverse.
  [[nodiscard]] Box krawczyk(const Box& box) const {
    const std::size_t n = box.size();
    const Box c = middle(box);
    const auto y = inverse_at(c);
    if (!y) return box;
    const Box f = values(c);
    Box jacobian(n * n), result(n);
    system_.jacobian(box, jacobian);
    const auto entry = [&](std::size_t i, std::size_t j) {
      return Interval((*y)(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    };
    for (std::size_t i = 0; i < n; ++i) {
      result[i] = c[i];
      for (std::size_t j = 0; j < n; ++j) result[i] = result[i] - entry(i, j) * f[j];
      for (std::size_t j = 0; j < n; ++j) {
        Interval slope(i == j ? 1.0 : 0.0);
        for (std::size_t k = 0; k < n; ++k) slope = slope - entry(i, k) * jacobian[k * n + j];
        result[i] = result[i] + slope * (box[j] - c[j]);
      }
    }
    return result;
  }

  /// `region` holds one zero, and `enclosure` holds it: contracted as far as it goes.
  void settle(const Box& region, Box enclosure) {
    for (;;) {
      const bool wide = width(enclosure) > wide_enclosure;
      if (auto narrow = wide ? narrowed(enclosure) : std::nullopt) enclosure = std::move(*narrow);
      Box next = krawczyk(enclosure);
      for (std::size_t i = 0; i < next.size(); ++i) next[i] = intersection(next[i], enclosure[i]);
      const bool improves = width(next) < (wide ? 0.999 : 0.9) * width(enclosure);
      enclosure = std::move(next);
      if (!improves) break;
    }
    regions_.push_back(region);
    for (IsolatedZero& zero : zeros_) {
      if (!zero.simple || !overlap(zero.enclosure, enclosure)) continue;
      if (holds(zero.alone, enclosure) || holds(region, zero.enclosure)) return;  // the same zero
      for (std::size_t i = 0; i < enclosure.size(); ++i)
        zero.enclosure[i] = hull(zero.enclosure[i], enclosure[i]);
      zero.simple = false;  // one or two: neither proof reaches the other
      zero.alone.clear();
      return;
    }
    zeros_.push_back({std::move(enclosure), true, region});
  }

  /// Newton's iteration from c.
  [[nodiscard]] std::optional<Box> newton(Box c) const {
    for (int i = 0; i < 6; ++i) {
      const auto y = inverse_at(c);
      if (!y) return std::nullopt;
      const Box f = values(c);
      for (std::size_t r = 0; r < c.size(); ++r) {
        double step = 0;
        for (std::size_t k = 0; k < c.size(); ++k) {
          step += (*y)(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k)) * f[k].middle();
        }
        if (!std::isfinite(step)) return std::nullopt;
        c[r] = Interval(c[r].middle() - step);
      }
    }
    return c;
  }

  /// A smaller box of the zero that `enclosure` holds, where it is so wide that K(X) hardly contracts: around
  /// where Newton's iteration ends.
  [[nodiscard]] std::optional<Box> narrowed(const Box& enclosure) const {
    const std::optional<Box> end = newton(middle(enclosure));
    if (!end) return std::nullopt;
    const Box box = around_point(*end, 1e-9);
    if (!holds(enclosure, box)) return std::nullopt;
    Box contracted = krawczyk(box);
    if (!inside(contracted, box)) return std::nullopt;
    return contracted;
  }

  /// `reach`: relative, of a size that matters at least.
  [[nodiscard]] Box around_point(const Box& point, double reach) const {
    Box box;
    for (std::size_t i = 0; i < point.size(); ++i) {
      const double x = point[i].middle();
      const double width = reach * (scales_[i] + std::abs(x));
      box.emplace_back(x - width, x + width);
    }
    return box;
  }

  /// A zero near a small box's edge: proves that it is alone in a larger box around it. True when that holds
  /// all of this one.
  bool settled_near(const Box& box) {
    const std::optional<Box> start = newton(middle(box));
    if (!start) return false;
    const Box& c = *start;
    Box wide;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const double reach = 1.5 * box[i].width();
      if (!(std::abs(c[i].middle() - box[i].middle()) <= reach)) return false;
      wide.emplace_back(c[i].middle() - reach, c[i].middle() + reach);
    }
    Box contracted = krawczyk(wide);
    if (!inside(contracted, wide)) return false;
    settle(wide, std::move(contracted));
    return is_settled(box);
  }

  /// Whether round-off hides all signs in the box: at its middle and its ends every equation may vanish.
  bool is_below_resolution(const Box& box) {
    Box first, last;
    for (const Interval& x : box) {
      first.emplace_back(x.lower);
      last.emplace_back(x.upper);
    }
    const bool hidden = is_bounded(values(box)) && may_vanish(values(middle(box))) &&
                        may_vanish(values(first)) && may_vanish(values(last));
    if (width(box) <= least_box && !is_bounded(values(box))) {
      poles_.push_back(box);
      return true;
    }
    if (!hidden && width(box) > least_box) return false;
    unresolved_.push_back(box);
    return true;
  }

  /// Width in units where every size counts alike: asinh(x / scale).
  [[nodiscard]] double width(const Box& box) const {
    double widest = 0;
    for (std::size_t i = 0; i < box.size(); ++i) widest = std::max(widest, width(box, i));
    return widest;
  }
  [[nodiscard]] double width(const Box& box, std::size_t i) const {
    const double direct = box[i].width() / (scales_[i] + box[i].least_magnitude());
    if (direct < 1) return direct;
    return inverse_sinh(box[i].upper / scales_[i]) - inverse_sinh(box[i].lower / scales_[i]);
  }

  /// From 0, in those units.
  [[nodiscard]] double distance(const Box& box) const {
    double largest = 0;
    for (std::size_t i = 0; i < box.size(); ++i)
      largest = std::max(largest, inverse_sinh(box[i].least_magnitude() / scales_[i]));
    return largest;
  }

  void bisect(const Box& box) {
    std::size_t widest = 0;
    for (std::size_t i = 1; i < box.size(); ++i) {
      if (width(box, i) > width(box, widest)) widest = i;
    }
    const Interval& x = box[widest];
    const double s = scales_[widest];
    double cut = x.lower + golden_cut * x.width();
    if (!(x.width() < 4 * (s + x.least_magnitude()))) {
      const double a = inverse_sinh(x.lower / s);
      const double b = inverse_sinh(x.upper / s);
      cut = s * evaluate(Function::sinh, a + golden_cut * (b - a));
    }
    Box left = box;
    Box right = box;
    left[widest].upper = right[widest].lower = cut;
    push(std::move(left));
    push(std::move(right));
  }

  /// Boxes that touch, as one; without those in which a zero was proven to be alone since.
  [[nodiscard]] std::vector<Box> clusters(const std::vector<Box>& boxes) const {
    std::vector<Box> found;
    for (Box box : boxes) {
      if (is_settled(box)) continue;
      for (bool merged = true; merged;) {
        const auto touching = std::find_if(found.begin(), found.end(), [&](const Box& other) {
          for (std::size_t i = 0; i < box.size(); ++i) {
            const double gap = box[i].width() + other[i].width();
            if (box[i].lower > other[i].upper + gap || other[i].lower > box[i].upper + gap) return false;
          }
          return true;
        });
        merged = touching != found.end();
        if (!merged) break;
        for (std::size_t i = 0; i < box.size(); ++i) box[i] = hull(box[i], (*touching)[i]);
        found.erase(touching);
      }
      found.push_back(std::move(box));
    }
    return found;
  }

  struct Waiting {
    double size;
    Box box;
    bool operator<(const Waiting& other) const { return size < other.size; }
  };

  const SquareSystem& system_;
  std::vector<double> scales_;
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
