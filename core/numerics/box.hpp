#pragma once
// Boxes: products of intervals, one for each unknown.

#include <span>
#include <utility>
#include <vector>

#include "core/numerics/interval.hpp"

namespace qdot {

using Box = std::vector<Interval>;

[[nodiscard]] Box middle(const Box& box);
/// a lies within b and touches none of its faces.
[[nodiscard]] bool is_inside(const Box& a, const Box& b);
[[nodiscard]] bool contains(const Box& outer, const Box& box);
[[nodiscard]] bool overlap(const Box& a, const Box& b);
[[nodiscard]] bool is_bounded(const Box& box);

/// What a search compares and halves boxes by, in units in which every size counts alike: asinh(x / scale),
/// with a scale for each unknown, the size that matters near zero.
class BoxUnits {
 public:
  explicit BoxUnits(std::vector<double> scales) : scales_(std::move(scales)) {}

  /// Of the widest side.
  [[nodiscard]] double width(const Box& box) const;
  /// From 0.
  [[nodiscard]] double distance(const Box& box) const;
  /// Around the middle; `reach` is relative, of the scale at least.
  [[nodiscard]] Box around(const Box& point, double reach) const;
  /// Both parts of the widest side.
  [[nodiscard]] std::pair<Box, Box> halves(const Box& box) const;

 private:
  [[nodiscard]] double width(const Box& box, std::size_t i) const;
  [[nodiscard]] double cut(const Interval& x, double scale) const;

  std::vector<double> scales_;
};

/// Boxes that touch, as one, again and again.
[[nodiscard]] std::vector<Box> joined_where_they_touch(std::span<const Box> boxes);

}  // namespace qdot
