#pragma once
// Random requests for motions, over decades of parameters, states, spans, methods and goals.

#include <string>
#include <vector>

#include "core/motion/ladder.hpp"
#include "tests/calibration/quad_reference.hpp"
#include "tests/support/random.hpp"

namespace qdot::test {

/// A motion that both the program and the reference can be asked for.
struct Asked {
  std::string system;
  SimulationRequest request;
  AccuracyGoal goal;
  Forcing force{};

  [[nodiscard]] std::vector<std::string> inputs() const;  ///< for Dynamics
  [[nodiscard]] QuadProblem problem() const;
  [[nodiscard]] std::string words() const;  ///< all of it in one line
};

/// `given`: parameters and initial values by name, the others have their defaults; times from 0 in
/// `samples` rows.
[[nodiscard]] Asked asked_for(const std::string& system, const Values& given, double t_end, int samples);

/// The same for the same seed and number.
[[nodiscard]] Asked random_request(std::uint64_t seed, std::uint64_t number);

}  // namespace qdot::test
