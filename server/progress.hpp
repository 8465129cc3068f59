#pragma once
// What a command tells on a terminal while it computes, and how it ends before its time.

#include <atomic>
#include <chrono>
#include <cstddef>

#include "api/http/messages.hpp"

namespace qdot::server {

/// While it lives, Ctrl-C, SIGTERM and SIGHUP ask the computation to end, a second one ends the process. Says
/// each second that the work goes on, if stderr is a terminal.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Whether the computation is to end. It is asked often, by several threads.
  [[nodiscard]] bool is_stopped();

  /// The signal that asks for it; 0 without.
  [[nodiscard]] static int signal();

  [[nodiscard]] std::chrono::duration<double> passed() const;

  /// The same threads, their tasks counted: the progress is reported in them. Must not outlive this.
  [[nodiscard]] api::Spread counting(api::Spread spread);

 private:
  void tell(std::chrono::seconds::rep seconds);

  bool shows_;
  std::chrono::steady_clock::time_point begun_{std::chrono::steady_clock::now()};
  std::atomic<std::chrono::seconds::rep> told_{0};
  std::atomic<std::size_t> done_{0}, of_{0};
};

}  // namespace qdot::server
