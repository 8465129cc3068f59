#include "server/progress.hpp"

#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <iostream>
#include <string>
#include <utility>

#include "server/signals.hpp"

namespace qdot::server {
namespace {

std::atomic<int> signal_that_came{0};
static_assert(std::atomic<int>::is_always_lock_free, "A signal handler sets it.");

constexpr std::array stopping{SIGINT, SIGTERM, SIGHUP};

void note_signal(int signal) { signal_that_came = signal; }

}  // namespace

Progress::Progress() : shows_(::isatty(STDERR_FILENO) != 0) {
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  for (const int signal : stopping)
    if (!is_ignored(signal)) ::sigaction(signal, &action, nullptr);
}

Progress::~Progress() {
  for (const int signal : stopping)
    if (!is_ignored(signal)) std::signal(signal, SIG_DFL);
  if (shows_ && told_ > 0) std::cerr << "\r\x1b[K" << std::flush;
}

int Progress::signal() { return signal_that_came; }

std::chrono::duration<double> Progress::passed() const { return std::chrono::steady_clock::now() - begun_; }

bool Progress::is_stopped() {
  const auto passed =
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - begun_);
  auto told = told_.load();
  if (shows_ && passed.count() > told && told_.compare_exchange_strong(told, passed.count()))
    tell(passed.count());
  return signal() != 0;
}

void Progress::tell(std::chrono::seconds::rep seconds) {
  std::string text = "\r\x1b[Kcomputing, " + std::to_string(seconds) + " s";
  const std::size_t done = done_, of = of_;
  if (of > 0) text += ", " + std::to_string(done) + " of " + std::to_string(of) + " rows";
  if (done > 0 && done < of) {
    const double left =
        static_cast<double>(seconds) * static_cast<double>(of - done) / static_cast<double>(done);
    text += ", about " + std::to_string(std::llround(std::ceil(left))) + " s left";
  }
  std::cerr << text << std::flush;
}

api::Spread Progress::counting(api::Spread spread) {
  return [this, spread = std::move(spread)](std::size_t count, const api::SpreadTask& task) {
    of_ += count;
    spread(count, [&](std::size_t i) {
      const bool goes_on = task(i);
      ++done_;
      return goes_on;
    });
  };
}

}  // namespace qdot::server
