#include "server/spread.hpp"

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

#include "server/lane.hpp"

namespace qdot::server {
namespace {

/// Where no thread can be had, those that are there do the work.
void add_helpers(std::vector<std::jthread>& helpers, std::size_t count, const auto& take_tasks) {
  try {
    for (std::size_t i = 0; i < count; ++i) helpers.emplace_back(take_tasks);
  } catch (const std::system_error&) {
    return;
  }
}

}  // namespace

api::Spread spread_over(int threads, Help help) {
  return [threads, help](std::size_t count, const api::SpreadTask& task) {
    std::atomic<std::size_t> next{0};
    const auto take_tasks = [&] {
      std::size_t i = next++;
      while (i < count && task(i)) i = next++;
    };
    const auto help_out = [&] {
      if (help == Help::beside_light_work) lower_priority();
      take_tasks();
    };
    std::vector<std::jthread> helpers;
    const std::size_t wanted = std::min(count, static_cast<std::size_t>(std::max(threads, 1)));
    add_helpers(helpers, wanted > 0 ? wanted - 1 : 0, help_out);
    take_tasks();
  };
}

}  // namespace qdot::server
