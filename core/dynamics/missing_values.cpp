#include "core/dynamics/missing_values.hpp"

#include <algorithm>
#include <array>

#include "core/base/error.hpp"

namespace qdot {

std::string missing_values(const Model& model, const Reals& parameters, std::optional<double> t,
                           const Reals& y) {
  return without_value(model.partial, model.parsed.symbols, parameters, t, y);
}

void refuse_missing_values(const Model& model, const Reals& parameters, std::optional<double> t,
                           const Reals& y) {
  const std::string names = missing_values(model, parameters, t, y);
  if (!names.empty())
    throw Error(ErrorCode::invalid_state, "In this state there is no finite value of " + names +
                                              ", or a part of it is beyond the range of doubles (1.8e308).");
}

bool lacks_values(const Model& model, std::span<const double> parameters, std::span<const double> y,
                  std::span<const double> errors) {
  if (model.partial.empty()) return false;
  return std::ranges::all_of(std::array{0.0, -1.0, 1.0}, [&](double side) {
    std::vector<double> place(y.begin(), y.end());
    for (std::size_t i = 0; i < place.size(); ++i) place[i] += side * errors[i];
    return !missing_values(model, parameters, std::nullopt, place).empty();
  });
}

}  // namespace qdot
