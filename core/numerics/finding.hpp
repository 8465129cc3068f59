#pragma once

#include <optional>
#include <string>

namespace qdot {

/// A number with its error, or the reason why there is none.
struct Finding {
  std::optional<double> value;
  double error{};      ///< |value - the true one| is at most this
  std::string reason;  ///< why there is no value, or what else has to be said of it
};

}  // namespace qdot
