#pragma once
// Where the answers of a batch go: stdout, or a file that a batch which was killed can be resumed with. The
// file holds whole lines in the order of the input, and at most a torn one behind them.

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "server/descriptor.hpp"
#include "server/line_reader.hpp"

namespace qdot::server {

class BatchOutput {
 public:
  enum class Start { anew, where_it_ended };

  /// stdout where `path` is empty. Nothing of a file that is there is changed before begin(). Waits until
  /// somebody reads a named pipe. Throws UsageError for a file that cannot be written, that another batch
  /// writes, or that `input` is read from.
  BatchOutput(const std::string& path, Start start, int input);

  /// The answers that are there already; nothing where the batch begins anew.
  [[nodiscard]] std::optional<LineReader> answers(std::size_t longest) const;

  /// Whether the first `kept` bytes end with this text.
  [[nodiscard]] bool ends_with(std::string_view text, std::uint64_t kept) const;

  /// Cuts what is there behind so many bytes, which are kept; lines are written from there on.
  void begin(std::uint64_t kept);

  [[nodiscard]] bool is_terminal() const;

  /// Whether it is a file that was named: of stdout, a pipe or a device nothing is found again.
  [[nodiscard]] bool can_be_resumed() const { return is_named_file_; }

  /// Writes whole lines. Throws std::system_error.
  void write(std::string_view text);

  /// All of it is on the disk: a quota or a disk that is full may be told only then. Throws CannotWrite.
  void finish();

  /// Waits a moment for the line that is being written; nothing is written after it.
  void close();

 private:
  Start start_;
  Descriptor file_;
  int descriptor_;
  bool is_named_file_{false};
  std::timed_mutex writing_;
};

}  // namespace qdot::server
