#pragma once
// Where the answers of a batch go: stdout, or a file that a batch which was killed can be resumed with. The
// file holds whole lines in the order of the input, and at most a torn one behind them.

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

#include "server/descriptor.hpp"

namespace qdot::server {

class BatchOutput {
 public:
  enum class Start { anew, where_it_ended };

  /// stdout where `path` is empty. Throws UsageError for a file that cannot be written, or that another batch
  /// writes.
  BatchOutput(const std::string& path, Start start);

  /// How many lines of the input are answered already.
  [[nodiscard]] std::uint64_t lines() const { return lines_; }
  /// The id of the last of them, as it is written.
  [[nodiscard]] const std::string& last_id() const { return last_id_; }

  /// Writes whole lines. Throws std::system_error.
  void write(std::string_view text);

  /// Waits a moment for the line that is being written; nothing is written after it.
  void close();

 private:
  void find_the_end();

  Descriptor file_;
  int descriptor_;
  std::uint64_t lines_{0};
  std::string last_id_;
  std::timed_mutex writing_;
};

}  // namespace qdot::server
