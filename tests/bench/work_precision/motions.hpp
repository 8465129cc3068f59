#pragma once
// The motions that the work-precision measurement is made on, and what a contestant in it is.

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "core/dynamics/dynamics.hpp"
#include "core/mechanics/model.hpp"
#include "core/motion/simulation.hpp"

namespace qdot::bench {

inline constexpr std::size_t samples = 1001;

struct Motion {
  std::string name;
  std::string system;
  Values given;                     ///< parameters and initial values; the others have their defaults
  std::vector<std::string> inputs;  ///< of the scene, expressions of t
  double t_end{};
};

/// All eleven systems, the first four and three more with motions of their own.
[[nodiscard]] const std::vector<Motion>& motions();

/// A motion with everything that is known before the first evaluation.
struct Problem {
  explicit Problem(const Motion& motion);

  [[nodiscard]] double parameter(const std::string& name) const;
  /// Of the whole motion, whatever the conditions of the scene say.
  [[nodiscard]] SimulationRequest request() const;

  const Motion& motion;
  Dynamics dynamics;
  std::vector<double> parameters, y_start, grid;
};

struct Outcome {
  std::vector<double> states;  ///< rows at the grid; fewer than `samples` where the method gave up
  std::uint64_t evaluations{};
  std::uint64_t steps{};  ///< 0 where the library does not tell
};

struct Contestant {
  std::string method;
  std::string equations;  ///< "tape", or "hand" for equations written in C++ for this motion
  std::function<Outcome(double tolerance)> solve;  ///< of method gauss: step
};

/// Methods of this project, through integrate() on the tape, as an answer to `simulate` uses them.
[[nodiscard]] std::vector<Contestant> own_methods(const Problem& problem);
/// Boost.odeint and GSL, on the tape and, where there are some, on equations written by hand.
[[nodiscard]] std::vector<Contestant> boost_methods(const Problem& problem);
[[nodiscard]] std::vector<Contestant> gsl_methods(const Problem& problem);
/// A scalar Taylor method written for one system, where there is one.
[[nodiscard]] std::vector<Contestant> hand_written_taylor(const Problem& problem);

/// Rows by method taylor, as tight as double precision allows.
[[nodiscard]] std::vector<double> tightest_motion(const Problem& problem);

/// Rows of the motion to twenty digits where there is a series written by hand (in arithmetic of 113 bits),
/// else tightest_motion().
[[nodiscard]] std::vector<double> reference(const Problem& problem);

/// CPU seconds of this thread.
[[nodiscard]] double seconds();
[[nodiscard]] double median(std::vector<double> values);
/// NaN where rows are missing.
[[nodiscard]] double largest_error(const std::vector<double>& states, const std::vector<double>& reference);

/// What the presets cost and give, one line each, and what the ladder's second run costs.
void write_presets(const Problem& problem, const std::vector<double>& reference, std::ostream& out);
void write_ladder(const Problem& problem, std::ostream& out);

}  // namespace qdot::bench
