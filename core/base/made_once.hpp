#pragma once
// A cache whose values are made on first demand, each exactly once, whatever threads ask. No lock is held
// while a value is made: threads that want different keys never wait for each other, and threads that want
// the same key share the work of the first.

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "core/base/work.hpp"

namespace qdot {

template <class Key, class Value>
class MadeOnce {
 public:
  /// The value of `key`, by `make()` where it is not there yet. The reference is good as long as this lives.
  ///
  /// What `make` throws goes to the thread that called it, whose work it is (core/base/work.hpp); nothing is
  /// kept then, and the next thread that wants the key makes it with its own budget. A thread that waits for
  /// another's value throws Interrupted as soon as nobody waits for its own answer any more. `make` may ask
  /// for other keys, but not for this one.
  template <class Make>
  [[nodiscard]] const Value& get(const Key& key, const Make& make) {
    std::unique_lock lock(mutex_);
    Entry& entry = entries_[key];  // a map's entries stay where they are
    while (entry.is_being_made) {
      finished_.wait_for(lock, patience);
      lock.unlock();
      check_interruption();
      lock.lock();
    }
    if (entry.value) return *entry.value;
    entry.is_being_made = true;
    lock.unlock();
    const Turn turn(*this, entry);
    Value value = make();
    lock.lock();
    entry.value.emplace(std::move(value));
    lock.unlock();
    return *entry.value;
  }

 private:
  /// How often a waiting thread checks whether anyone still waits for its own answer.
  static constexpr std::chrono::milliseconds patience{20};

  struct Entry {
    bool is_being_made{};
    std::optional<Value> value;
  };

  /// The time in which one thread makes the value of an entry, whether it succeeds or throws.
  class Turn {
   public:
    Turn(MadeOnce& cache, Entry& entry) : cache_(cache), entry_(entry) {}
    ~Turn() {
      const std::lock_guard lock(cache_.mutex_);
      entry_.is_being_made = false;
      cache_.finished_.notify_all();
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    MadeOnce& cache_;
    Entry& entry_;
  };

  std::mutex mutex_;
  std::condition_variable finished_;  ///< some value was made, or could not be
  std::map<Key, Entry> entries_;
};

}  // namespace qdot
