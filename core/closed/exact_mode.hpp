#pragma once
// The formulas of one mode, those of them that it has.

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/closed/closed_form.hpp"

namespace qdot {

struct ExactMode {
  ClosedForm square;  ///< omega^2, or rate^2 where lambda < 0; of the rate itself where the mode creeps
  std::optional<std::vector<std::string>>
      lambda_assumes{};  ///< what `square` assumes as a formula of lambda of either sign, where that is less
  std::optional<ClosedForm> general{};  ///< the same before relations between parameters were put in
  std::optional<ClosedForm> rate{};     ///< omega, or the rate
  std::optional<ClosedForm> period{};   ///< of an oscillation
  std::optional<ClosedForm>
      lambda{};  ///< lambda times the square of the scene's unit of time, where a number
  std::vector<ClosedForm> shape{}, scaled_shape{};  ///< of all coordinates, or empty
  std::optional<ClosedForm> damping{};              ///< the rate at which an oscillation decays or grows
  bool creeps{};                                    ///< friction leaves no oscillation
};

/// Of each form, in its place.
template <class Take>
void for_each_form(ExactMode& mode, const Take& take) {
  take(mode.square);
  for (auto* other : {&mode.rate, &mode.period, &mode.lambda, &mode.damping}) {
    if (*other) take(**other);
  }
  for (auto* shape : {&mode.shape, &mode.scaled_shape}) std::ranges::for_each(*shape, take);
}

/// All of its forms assume these as well.
inline void add_conditions(const std::vector<std::string>& conditions, ExactMode& mode) {
  for_each_form(mode, [&](ClosedForm& form) {
    form.assumes.insert(form.assumes.end(), conditions.begin(), conditions.end());
  });
}

}  // namespace qdot
