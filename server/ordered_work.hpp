#pragma once
// Lines that several threads answer and one writes, in the order in which they came. What waits to be written
// is bounded, so that a line that takes long holds the reader back and not the memory.

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "server/line_reader.hpp"

namespace qdot::server {

class OrderedWork {
 public:
  /// Whole lines of answers, and how many lines and bytes of the input they answer.
  struct Piece {
    std::string text;
    std::uint64_t lines{0};
    std::uint64_t input_bytes{0};
  };
  using Answer = std::function<std::string(const InputLine&)>;  ///< called by several threads
  using Write = std::function<void(const Piece&)>;              ///< called by one thread; may throw

  OrderedWork(int threads, Answer answer, Write write);
  ~OrderedWork();
  OrderedWork(const OrderedWork&) = delete;
  OrderedWork& operator=(const OrderedWork&) = delete;

  /// Waits while too much is on its way. Throws what a write has thrown.
  void add(InputLine line);

  /// Returns once everything is written. Throws what a write has thrown.
  void finish();

 private:
  enum class Stage { waiting, running, done };
  struct Slot {
    InputLine line;
    std::string answer;
    Stage stage{Stage::waiting};
  };

  void work();
  void write_in_order();
  [[nodiscard]] bool has_room() const;
  [[nodiscard]] bool may_begin() const;
  Slot& slot(std::uint64_t number) { return slots_[static_cast<std::size_t>(number - first_)]; }
  Piece take_done();

  Answer answer_;
  Write write_;
  std::mutex mutex_;
  std::condition_variable room_, waiting_, done_;
  std::deque<Slot> slots_;
  std::uint64_t first_{0};  // number of the line in the first slot
  std::uint64_t next_{0};   // of the next line to be answered
  std::size_t bytes_{0};    // of lines and answers that are not written yet
  bool ended_{false};       // no line follows
  std::exception_ptr failed_;
  std::vector<std::jthread> threads_;  // last, because they use the rest
};

}  // namespace qdot::server
