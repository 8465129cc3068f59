#include "core/mechanics/shapes.hpp"

#include <algorithm>

namespace qdot {
namespace {

using Sizes = std::span<const Expression>;
using Moments = std::array<Expression, 3>;

Expression square(const Expression& e) { return pow(e, Number(2)); }

Moments about_axis(const Expression& across, const Expression& along) { return {across, across, along}; }

Moments of_disk(Sizes s) {
  return about_axis(Number::ratio(1, 4) * square(s[0]), Number::ratio(1, 2) * square(s[0]));
}

Moments of_ring(Sizes s) { return about_axis(Number::ratio(1, 2) * square(s[0]), square(s[0])); }

Moments of_sphere(Sizes s) {
  const Expression all = Number::ratio(2, 5) * square(s[0]);
  return about_axis(all, all);
}

Moments of_shell(Sizes s) {
  const Expression all = Number::ratio(2, 3) * square(s[0]);
  return about_axis(all, all);
}

Moments of_cylinder(Sizes s) {
  return about_axis(Number::ratio(1, 4) * square(s[0]) + Number::ratio(1, 12) * square(s[1]),
                    Number::ratio(1, 2) * square(s[0]));
}

Moments of_box(Sizes s) {
  const auto across = [&](std::size_t i, std::size_t j) {
    return Number::ratio(1, 12) * (square(s[i]) + square(s[j]));
  };
  return {across(1, 2), across(2, 0), across(0, 1)};
}

}  // namespace

const std::vector<Shape>& shapes() {
  static const ShapeSize radius{"radius", "its radius"};
  static const std::vector<Shape> all{
      {"disk", "A uniform thin disk; its axis is its axis 3.", {radius}, of_disk, true},
      {"ring", "A uniform thin ring, or hoop; its axis is its axis 3.", {radius}, of_ring, true},
      {"sphere", "A uniform solid sphere.", {radius}, of_sphere, true},
      {"shell", "A uniform thin spherical shell.", {radius}, of_shell, true},
      {"cylinder",
       "A uniform solid cylinder; its axis is its axis 3.",
       {radius, {"length", "how long it is along its axis", true}},
       of_cylinder,
       true},
      {"box",
       "A uniform rectangular box, or plate.",
       {{"width", "its edge along its axis 1"},
        {"height", "its edge along its axis 2"},
        {"depth", "its edge along its axis 3; 0 for a thin plate", true}},
       of_box},
  };
  return all;
}

const Shape* find_shape(const std::string& name) {
  const auto found = std::ranges::find(shapes(), name, &Shape::name);
  return found == shapes().end() ? nullptr : &*found;
}

}  // namespace qdot
