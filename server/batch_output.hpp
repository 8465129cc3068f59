#pragma once
// Where the answers of a batch go: stdout, or a file that a batch which was killed can be resumed with. The
// file holds whole lines in the order of the input, and at most a torn one behind them.

#include <sys/types.h>

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "server/descriptor.hpp"

namespace qdot::server {

class BatchOutput {
 public:
  enum class Start { anew, where_it_ended };

  /// stdout where `path` is empty. Nothing of a file that is there is changed before begin(). Throws
  /// UsageError for a file that cannot be written, that another batch writes, or that `input` is read from.
  BatchOutput(const std::string& path, Start start, int input);

  /// Cuts what is there behind the answers that are kept; lines are written from there on.
  void begin();

  [[nodiscard]] bool is_terminal() const;

  /// How many lines of the input are answered already.
  [[nodiscard]] std::uint64_t lines() const { return lines_; }
  /// The id of the last of them, as it is written.
  [[nodiscard]] const std::string& last_id() const { return last_id_; }

  /// Writes whole lines. Throws std::system_error.
  void write(std::string_view text);

  /// Waits a moment for the line that is being written; nothing is written after it.
  void close();

 private:
  off_t end_of_the_answers();

  Descriptor file_;
  int descriptor_;
  std::optional<off_t> end_;  // of the answers that are kept; only a file has one
  std::uint64_t lines_{0};
  std::string last_id_;
  std::timed_mutex writing_;
};

}  // namespace qdot::server
