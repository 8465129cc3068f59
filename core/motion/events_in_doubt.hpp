#pragma once
// Events of which there may be more or fewer than were met, each with the first reason that was found.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace qdot {

struct EventDoubt {
  std::string event, sentence;
};

class EventsInDoubt {
 public:
  /// Those that are not known to be in doubt yet.
  void add(std::vector<EventDoubt> found) {
    for (EventDoubt& doubt : found) {
      if (std::ranges::find(all_, doubt.event, &EventDoubt::event) == all_.end())
        all_.push_back(std::move(doubt));
    }
  }

  /// The reason of the first, and the names of the others; empty where there are none.
  [[nodiscard]] std::string in_words() const {
    if (all_.empty()) return {};
    std::string names;
    for (std::size_t i = 1; i < all_.size(); ++i) names += (i == 1 ? "" : ", ") + all_[i].event;
    return all_.front().sentence + (names.empty() ? "" : " The same is in doubt for: " + names + ".");
  }

 private:
  std::vector<EventDoubt> all_;
};

}  // namespace qdot
