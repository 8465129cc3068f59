#pragma once
// Motions to more digits than a double has: a Taylor method of order 38 on 113 bits, checked by a second one
// of order 32 with other steps. What the two have in common is the equations (quad_systems.hpp) and the
// arithmetic; the first is compared with tests/reference, the second is GCC's. Where fewer digits do, the
// same in the processor's 64 bits, of orders 24 and 20, the second with every parameter moved by its last
// bit.

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tests/calibration/quad_systems.hpp"

namespace qdot::test {

/// What moves: the doubles that the program got.
struct QuadProblem {
  std::string system;
  std::vector<std::pair<std::string, double>> parameters;
  std::vector<double> y_start;  ///< q, then q'
  double t_start{};
  std::vector<double> grid;  ///< increasing, from t_start on
  Forcing force{};
  bool impacts{};  ///< the compass walker's heel strikes
};

template <typename Number>
struct PreciseMotion {
  std::size_t rows{};         ///< instants of the grid that were reached
  std::vector<Number> state;  ///< rows x 2n, row-major
  std::vector<double> impacts;
  std::uint64_t steps{};
};

struct PreciseMethod {
  unsigned order{38};
  double tolerance{1e-30};  ///< of a step, relative to each component
  std::uint64_t most_steps{std::numeric_limits<std::uint64_t>::max()};
  double moved{};  ///< of itself, each parameter, up and down in turn
};

template <typename Number>
[[nodiscard]] PreciseMotion<Number> precise_motion(const QuadProblem& problem,
                                                   const PreciseMethod& method = {});

/// The motion by the first method and, for each number, by how much the second one's differs.
template <typename Number>
struct Reference {
  PreciseMotion<Number> motion;
  std::vector<double> doubt;

  [[nodiscard]] Number value(std::size_t place) const { return motion.state[place]; }
};

[[nodiscard]] Reference<Quad> quad_reference(const QuadProblem& problem, std::uint64_t most_steps);
[[nodiscard]] Reference<Long> quick_reference(const QuadProblem& problem, std::uint64_t most_steps);

}  // namespace qdot::test
