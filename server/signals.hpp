#pragma once
// Signals that a program was started to ignore, as nohup and a shell's background do, stay ignored.

#include <csignal>

namespace qdot::server {

[[nodiscard]] inline bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace qdot::server
