#pragma once
// A number with its error, |value - the true one| <= error, or the reason why there is none.

#include <optional>
#include <string>

namespace qdot {

struct Finding {
  std::optional<double> value;
  double error{};      ///< in the unit of the value
  std::string reason;  ///< why there is no value, or what else has to be said of it
};

}  // namespace qdot
