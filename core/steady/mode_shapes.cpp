#include "core/steady/mode_shapes.hpp"

#include <cmath>
#include <utility>

namespace qdot {
namespace {

/// None where the shape is not enclosed.
std::vector<double> errors_of(const Shape& shape) {
  std::vector<double> errors;
  for (const ComplexBall& entry : shape) {
    errors.push_back(entry.re.error() + entry.im.error());
    if (!std::isfinite(errors.back())) return {};
  }
  return errors;
}

/// The ignored coordinates that move along.
std::vector<std::pair<std::size_t, ComplexBall>> companions(const Linearization& at, const Shape& shape,
                                                            const ComplexBall& s) {
  const std::vector<std::size_t>& ignored = at.statics.reduction.ignored;
  std::vector<std::vector<ComplexBall>> rows;  // the augmented matrix (M_cc | right-hand side)
  for (const std::size_t c : ignored) {
    rows.emplace_back();
    for (const std::size_t other : ignored) rows.back().emplace_back(at.whole.mass(c, other));
    ComplexBall sum;
    for (std::size_t i = 0; i < shape.size(); ++i) {
      const std::size_t k = at.statics.reduction.kept[i];
      sum = sum - at.whole.mass(c, k) * shape[i];
      const bool turning = magnitude(s) > 0 && !at.whole.rates(c, k).is_zero();
      if (turning) sum = sum - at.whole.rates(c, k) * shape[i] / s;
    }
    rows.back().push_back(sum);
  }
  rows = echelon_form(std::move(rows));
  std::vector<std::pair<std::size_t, ComplexBall>> result;
  for (std::size_t k = 0; k < ignored.size(); ++k) result.emplace_back(ignored[k], rows[k].back());
  return result;
}

}  // namespace

void set_shapes(const Linearization& at, std::vector<Mode>& modes, const std::vector<Shape>& shapes,
                const ComplexBall& s) {
  std::vector<Shape> all;
  for (const Shape& of_reduced : shapes) {
    const Shape shape = displaced(at, of_reduced);
    Shape whole(at.coordinates);
    for (std::size_t i = 0; i < shape.size(); ++i) whole[at.statics.reduction.kept[i]] = shape[i];
    for (auto& [c, value] : companions(at, shape, s)) whole[c] = value;
    all.push_back(std::move(whole));
  }
  all = echelon_form(std::move(all));
  for (std::size_t k = 0; k < modes.size(); ++k) {
    modes[k].shape.clear();
    for (const ComplexBall& entry : all[k]) modes[k].shape.emplace_back(entry.re.value(), entry.im.value());
    if (modes[k].multiplicity == 1) modes[k].shape_error = errors_of(all[k]);
  }
}

std::vector<std::size_t> first_components(const std::vector<Shape>& shapes) {
  std::vector<std::size_t> places;
  for (const Shape& shape : echelon_form(shapes)) {
    const auto is_there = [](const ComplexBall& entry) { return !entry.re.contains_zero(); };
    places.push_back(static_cast<std::size_t>(std::ranges::find_if(shape, is_there) - shape.begin()));
  }
  return places;
}

std::vector<Shape> without(const std::vector<Shape>& basis, std::vector<Shape> shapes) {
  const std::vector<std::size_t> first = first_components(basis);
  for (std::size_t k = 0; k < basis.size(); ++k) {
    for (Shape& shape : shapes) {
      const ComplexBall factor = shape[first[k]];
      for (std::size_t i = 0; i < shape.size(); ++i) shape[i] = shape[i] - factor * basis[k][i];
      shape[first[k]] = Ball(0);
    }
  }
  return shapes;
}

}  // namespace qdot
