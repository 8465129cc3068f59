#pragma once
// Tells on a terminal how far a batch is, once a second.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace qdot::server {

/// What is known of a batch at some moment.
struct BatchState {
  std::uint64_t lines{0};         ///< answered, those of earlier runs included
  std::uint64_t bytes{0};         ///< of the input that they answer
  std::uint64_t bytes_before{0};  ///< those among them that earlier runs have answered
  std::optional<std::uint64_t> bytes_in_all{};
  double seconds{0};  ///< of this run
};

/// "1200 lines, 40 a second, 30 %, about 2 min left": what is left is estimated from the bytes of
/// the input that this run has answered so far.
[[nodiscard]] std::string progress_text(const BatchState& state);

class BatchProgress {
 public:
  /// Shows nothing unless stderr is a terminal and the answers do not go to one.
  BatchProgress(std::optional<std::uint64_t> bytes_in_all, bool answers_are_shown);
  ~BatchProgress();
  BatchProgress(const BatchProgress&) = delete;
  BatchProgress& operator=(const BatchProgress&) = delete;

  /// Lines that an earlier run has answered.
  void skip(std::uint64_t lines, std::uint64_t bytes);
  void add(std::uint64_t lines, std::uint64_t bytes);
  [[nodiscard]] BatchState state() const;

 private:
  void show();

  const std::chrono::steady_clock::time_point begun_{std::chrono::steady_clock::now()};
  mutable std::mutex mutex_;
  std::condition_variable ended_changed_;
  BatchState state_;
  bool ended_{false};
  std::jthread thread_;
};

}  // namespace qdot::server
