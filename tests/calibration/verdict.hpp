#pragma once
// What is demanded of stated errors, and how often it is met.

#include <map>
#include <vector>

#include "tests/calibration/outcome.hpp"

namespace qdot::test {

inline constexpr double overstated = 100;         ///< stated > 100 true: in one of ten at most
inline constexpr double round_off_level = 1e-14;  ///< of a column's size: below it nothing is overstated

class Tally {
 public:
  /// Remarks on what is wrong with the outcome, a line each; empty where nothing is.
  std::string add(const Asked& asked, const Outcome& outcome);
  [[nodiscard]] std::string summary() const;
  /// False also where nothing was seen.
  [[nodiscard]] bool passes() const;
  /// Some columns were seen, and none of them is farther off than it says.
  [[nodiscard]] bool understates_nothing() const { return columns_ > 0 && understated_ == 0; }

 private:
  std::string judge(const ColumnOutcome& column);
  /// What so large a share of the columns above round-off is not beyond.
  [[nodiscard]] double times_too_large(double share) const;

  std::uint64_t requests_{}, columns_{}, understated_{}, overstated_{}, broken_promises_{}, unmeasured_{},
      unknown_{}, horizons_{}, wrong_horizons_{};
  std::map<std::string, std::uint64_t> endings_;
  std::vector<double> times_too_large_;  ///< stated / true, above round-off
  double cpu_{}, reference_cpu_{};
};

/// Status, errors stated and true, work: one line.
[[nodiscard]] std::string description(const Outcome& outcome);

}  // namespace qdot::test
