#pragma once
// `qdot batch`: lines of requests in, lines of answers out, however many there are
// (api/answers/batch/line.hpp).

#include <string>

#include "server/commands.hpp"

namespace qdot::server {

struct BatchOptions {
  std::string file{};    ///< lines to answer; stdin where it is empty or "-"
  std::string output{};  ///< where the answers go; stdout where it is empty or "-"
  bool resume{false};    ///< goes on behind the answers that `output` has already
  int jobs{0};           ///< lines that are answered at a time; 0 means the number of cores
  std::string scenes{};  ///< a directory of more scenes; may be empty
  bool bounded{false};   ///< no more work for a line than a service would do
};

/// Every line is answered, a wrong one by its problem. SIGINT and SIGTERM end the process at once, behind a
/// whole line. Call it before any other thread exists. Throws UsageError, and std::system_error where reading
/// or writing fails.
[[nodiscard]] ExitCode run_batch(const BatchOptions& options);

/// What a line may say, for --help.
[[nodiscard]] std::string help_on_lines();

}  // namespace qdot::server
