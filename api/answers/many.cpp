#include "api/answers/many.hpp"

#include <atomic>
#include <exception>
#include <mutex>

#include "api/json/limits.hpp"
#include "core/base/work.hpp"

namespace qdot::api {

void for_each(const Request& request, std::size_t count, const std::function<void(std::size_t)>& task) {
  std::mutex mutex;
  std::exception_ptr thrown;
  std::atomic<bool> ended{false};
  const auto one = [&](std::size_t i) {
    if (ended) return;
    try {
      const WorkScope scope(limits::algebra, request.interrupted);
      check_interruption();
      task(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
      ended = true;
    }
  };
  if (request.spread) {
    request.spread(count, one);
  } else {
    for (std::size_t i = 0; i < count && !ended; ++i) one(i);
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace qdot::api
