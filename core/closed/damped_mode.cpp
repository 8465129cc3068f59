#include "core/closed/damped_mode.hpp"

#include "core/closed/trial.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

/// -rate +- i omega solve M s^2 + D s + K = 0 where both sums vanish.
bool solves_everywhere(const LinearMotions& motions, const ExactPlace& place, const ExactValues& values,
                       const Expression& rate, const Expression& square) {
  const Relations none;
  Trial trial(values, none);
  trial.set(motions.x, place.x());
  for (const Expression& force : motions.forces) trial.vanishes({force});
  const Expression &m = motions.mass[0][0], &d = motions.damping[0][0], &k = motions.stiffness[0][0];
  trial.vanishes({m * rate * rate, -(m * square), -(d * rate), k});
  trial.vanishes({Number(2) * m * rate, -d});
  return trial.passes();
}

}  // namespace

std::optional<DampedForms> damped_forms(const LinearMotions& motions, const ExactPlace& place,
                                        const ExactValues& values) {
  if (motions.mass.size() != 1 || !motions.momenta.empty() || !place.undecided().empty()) return std::nullopt;
  const auto at_place = [&](const Matrix& matrix) { return simplify(place.at(matrix[0][0])); };
  const Expression m = at_place(motions.mass), d = at_place(motions.damping);
  if (d.is_zero()) return std::nullopt;
  const Expression rate = simplify(Number::ratio(1, 2) * d / m);
  const Expression square = simplify(at_place(motions.stiffness) / m) - pow(rate, Number(2));
  if (values.sign(square) <= 0 || !solves_everywhere(motions, place, values, rate, square))
    return std::nullopt;
  const int sign = values.sign(rate);
  const Expression omega = sqrt(square), size = sign < 0 ? -rate : rate;
  const auto of_square = closed_form(values, square, {}), of_omega = closed_form(values, omega, {}),
             of_rate = closed_form(values, size, {});
  if (sign == 0 || !of_square || !of_omega || !of_rate) return std::nullopt;
  DampedForms forms{omega, size, {*of_square, {}, of_omega, {}, {}, {}, {}, of_rate}};
  return forms;
}

bool agrees(const DampedForms& forms, const Mode& mode, const ExactValues& values) {
  return mode.omega_error && mode.rate_error &&
         agrees(values.value(forms.omega), mode.omega, *mode.omega_error) &&
         agrees(values.value(forms.rate), mode.rate, *mode.rate_error);
}

}  // namespace qdot
