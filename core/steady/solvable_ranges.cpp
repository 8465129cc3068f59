#include "core/steady/solvable_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/compile/tape_evaluator.hpp"
#include "core/numerics/constants.hpp"
#include "core/numerics/same_bits.hpp"
#include "core/steady/equilibria.hpp"

namespace qdot {
namespace {

constexpr double widest_break = 1e-4;
constexpr std::size_t most_boxes_of_breaks = 5'000;

/// A function of the position and its slope.
struct Curve {
  Interval value, slope;
};
Curve operator+(const Curve& a, const Curve& b) { return {a.value + b.value, a.slope + b.slope}; }
Curve operator-(const Curve& a, const Curve& b) { return {a.value - b.value, a.slope - b.slope}; }
Curve operator*(const Curve& a, const Curve& b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope};
}
Curve constant(double value) { return {Interval(value), Interval(0)}; }

struct Break {
  Interval position;
  bool included{};  ///< a value exists there if it does beside it
};

class Ranges {
 public:
  Ranges(const SteadyPolynomial& polynomial, std::span<const Interval> constants, const Domain& of_unknown,
         const Domain& of_position)
      : force_(polynomial.forces[0]),
        turns_(polynomial.turns[0]),
        domain_(of_unknown),
        region_(turns_ ? Interval(-pi, pi + 1e-9)
                       : Interval(std::max(of_position.lower, -largest_length),
                                  std::min(of_position.upper, largest_length))),
        coefficients_(polynomial.coefficients, constants),
        slopes_(polynomial.slopes, constants) {}

  std::optional<std::vector<SolvableRange>> run() {
    find_breaks();
    if (!complete_) return std::nullopt;
    std::sort(breaks_.begin(), breaks_.end(),
              [](const Break& a, const Break& b) { return a.position.middle() < b.position.middle(); });
    if (turns_) {
      around();
    } else {
      along();
    }
    merge();
    return std::move(ranges_);
  }

 private:
  /// c0, c1 and c2 at x.
  std::vector<Curve> at(const Interval& x) {
    std::vector<Interval> c(3), slope(3);
    coefficients_({&x, 1}, c);
    slopes_({&x, 1}, slope);
    return {{c[0], slope[0]}, {c[1], slope[1]}, {c[2], slope[2]}};
  }

  void find_breaks() {
    if (force_.degree == 2) {
      add_zeros([](const auto& c) { return c[2]; }, false);
      if (!force_.linear_vanishes) {
        add_zeros([](const auto& c) { return c[1] * c[1] - constant(4) * c[0] * c[2]; }, true);
      } else {
        add_zeros([](const auto& c) { return c[0]; }, domain_.contains(0));
      }
    } else {
      add_zeros([](const auto& c) { return c[1]; }, false);
    }
    for (const auto& [end, open] :
         {std::pair(domain_.lower, domain_.lower_open), std::pair(domain_.upper, domain_.upper_open)}) {
      if (!std::isfinite(end) || (end == 0 && force_.degree == 2 && force_.linear_vanishes)) continue;
      add_zeros([b = end](const auto& c) { return c[0] + constant(b) * c[1] + constant(b * b) * c[2]; },
                !open);
    }
  }

  void add_zeros(const std::function<Curve(const std::vector<Curve>&)>& curve, bool included) {
    const SquareSystem system{1, [&](auto x, auto out) { out[0] = curve(at(x[0])).value; },
                              [&](auto x, auto out) { out[0] = curve(at(x[0])).slope; }};
    const Isolation isolation = isolate_zeros(system, {region_}, {}, most_boxes_of_breaks);
    complete_ = complete_ && isolation.complete && isolation.undecided.empty();
    for (const IsolatedZero& zero : isolation.zeros) {
      if (zero.enclosure[0].width() > widest_break) complete_ = false;  // it vanishes along a whole stretch
      const Interval x = turns_ ? reduced_angle(zero.enclosure[0]) : zero.enclosure[0];
      const auto known = std::find_if(breaks_.begin(), breaks_.end(), [&](const Break& other) {
        return !is_empty(intersection(other.position, x));
      });
      if (known == breaks_.end()) {
        breaks_.push_back({x, included});
      } else {  // 0/0 there: nothing is claimed
        known->position = hull(known->position, x);
        known->included = known->included && included;
      }
    }
  }

  /// Whether some u in its domain solves c0 + c1 u + c2 u^2 = 0 at x.
  bool exists_at(double x) {
    const std::vector<Curve> c = at(Interval(x));
    const double a = c[2].value.middle();
    const double b = c[1].value.middle();
    const double constant_term = c[0].value.middle();
    if (a == 0) return b != 0 && domain_.contains(-constant_term / b);
    const double discriminant = b * b - 4 * a * constant_term;
    if (!(discriminant >= 0)) return false;
    const double root = std::sqrt(discriminant);
    return domain_.contains((-b - root) / (2 * a)) || domain_.contains((-b + root) / (2 * a));
  }

  void add(const Interval& from, bool from_included, const Interval& to, bool to_included) {
    if (!exists_at(between(from.middle(), to.middle()))) return;
    const double first = from.middle();
    const double last = to.middle();
    ranges_.push_back(
        {first, last, distance_bound(first, from), distance_bound(last, to), from_included, to_included});
  }

  /// Lengths are searched far out: their middle is a geometric one.
  [[nodiscard]] double between(double a, double b) const {
    return turns_ ? (a + b) / 2 : evaluate(Function::sinh, (inverse_sinh(a) + inverse_sinh(b)) / 2);
  }

  void around() {
    const Interval turn{std::nextafter(2 * pi, 0), std::nextafter(2 * pi, 7)};
    if (breaks_.empty()) {
      add(Interval(-pi), false, Interval(pi), true);
      return;
    }
    for (std::size_t i = 0; i + 1 < breaks_.size(); ++i) {
      add(breaks_[i].position, breaks_[i].included, breaks_[i + 1].position, breaks_[i + 1].included);
    }
    add(breaks_.back().position, breaks_.back().included, breaks_.front().position + turn,
        breaks_.front().included);
  }

  void along() {
    std::vector<Break> ends{{Interval(region_.lower), false}};
    ends.insert(ends.end(), breaks_.begin(), breaks_.end());
    ends.push_back({Interval(region_.upper), false});
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (ends[i].position.upper >= ends[i + 1].position.lower) continue;
      add(ends[i].position, ends[i].included, ends[i + 1].position, ends[i + 1].included);
    }
  }

  /// Neighbours that share an end where a value exists are one range.
  void merge() {
    for (std::size_t i = 0; i + 1 < ranges_.size();) {
      if (ranges_[i].to == ranges_[i + 1].from && ranges_[i].to_included && ranges_[i + 1].from_included) {
        ranges_[i].to = ranges_[i + 1].to;
        ranges_[i].to_error = ranges_[i + 1].to_error;
        ranges_[i].to_included = ranges_[i + 1].to_included;
        ranges_.erase(ranges_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      } else {
        ++i;
      }
    }
  }

  SteadyPolynomial::Force force_;
  bool turns_;
  Domain domain_;
  Interval region_;
  TapeEvaluator<Interval> coefficients_, slopes_;
  std::vector<Break> breaks_;
  std::vector<SolvableRange> ranges_;
  bool complete_{true};
};

}  // namespace

std::optional<std::vector<SolvableRange>> solvable_ranges(const SteadyPolynomial& polynomial,
                                                          std::span<const Interval> constants,
                                                          const Domain& of_unknown,
                                                          const Domain& of_position) {
  if (polynomial.turns.size() != 1 || polynomial.forces.size() != 1) return std::nullopt;
  const SteadyPolynomial::Force& force = polynomial.forces[0];
  if (!force.degree || *force.degree == 0) return std::nullopt;
  return Ranges(polynomial, constants, of_unknown, of_position).run();
}

}  // namespace qdot
