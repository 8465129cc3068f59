#include "server/batch_progress.hpp"

#include <unistd.h>

#include <cmath>
#include <iostream>

namespace qdot::server {
namespace {

constexpr double soonest_estimate = 2;  ///< seconds of work that an estimate needs

/// "40 s", "3 min", "2.5 h"
std::string about(double seconds) {
  const auto whole = [](double value) { return std::to_string(static_cast<long long>(std::ceil(value))); };
  if (seconds < 90) return whole(seconds) + " s";
  if (seconds < 5400) return whole(seconds / 60) + " min";
  const auto tenths = static_cast<long long>(std::ceil(seconds / 360));
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " h";
}

}  // namespace

std::string progress_text(const BatchState& state) {
  std::string text = std::to_string(state.lines) + (state.lines == 1 ? " line" : " lines");
  if (!state.bytes_in_all || *state.bytes_in_all == 0) return text;
  const auto done = static_cast<double>(state.bytes);
  const auto all = static_cast<double>(*state.bytes_in_all);
  text += ", " + std::to_string(static_cast<int>(100 * done / all)) + " %";
  const double of_this_run = done - static_cast<double>(state.bytes_before);
  if (state.seconds < soonest_estimate || !(of_this_run > 0) || done >= all) return text;
  return text + ", about " + about(state.seconds * (all - done) / of_this_run) + " left";
}

BatchProgress::BatchProgress(std::optional<std::uint64_t> bytes_in_all, bool answers_are_shown) {
  state_.bytes_in_all = bytes_in_all;
  if (::isatty(STDERR_FILENO) != 0 && !answers_are_shown) thread_ = std::jthread([this] { show(); });
}

BatchProgress::~BatchProgress() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  ended_changed_.notify_all();
}

void BatchProgress::skip(std::uint64_t lines, std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  state_.lines += lines;
  state_.bytes += bytes;
  state_.bytes_before += bytes;
}

void BatchProgress::add(std::uint64_t lines, std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  state_.lines += lines;
  state_.bytes += bytes;
}

BatchState BatchProgress::state() const {
  const std::lock_guard lock(mutex_);
  BatchState now = state_;
  now.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  return now;
}

void BatchProgress::show() {
  bool is_shown = false;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      if (ended_changed_.wait_for(lock, std::chrono::seconds(1), [this] { return ended_; })) break;
    }
    std::cerr << "\r\x1b[K" << progress_text(state()) << std::flush;
    is_shown = true;
  }
  if (is_shown) std::cerr << "\r\x1b[K" << std::flush;
}

}  // namespace qdot::server
