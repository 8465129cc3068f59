#include "api/answers/many.hpp"

#include <atomic>
#include <exception>
#include <limits>
#include <mutex>

#include "api/json/limits.hpp"
#include "core/base/work.hpp"
#include "core/base/work_bounds.hpp"

namespace qdot::api {

void for_each(const Request& request, std::size_t count, const std::function<void(std::size_t)>& task) {
  std::mutex mutex;
  std::exception_ptr thrown;
  std::atomic<bool> ended{false};
  const auto one = [&](std::size_t i) {
    if (ended) return false;
    try {
      const bool is_bounded = request.work == Work::bounded;
      const WorkBoundsScope bounds(is_bounded ? WorkBounds::of_a_service : WorkBounds::none);
      const WorkScope scope(is_bounded ? limits::algebra : std::numeric_limits<std::uint64_t>::max(),
                            request.interrupted);
      check_interruption();
      task(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
      ended = true;
    }
    return !ended;
  };
  if (request.spread) {
    request.spread(count, one);
  } else {
    std::size_t i = 0;
    while (i < count && one(i)) ++i;
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace qdot::api
