#include "server/ordered_work.hpp"

#include <utility>

namespace qdot::server {
namespace {

constexpr std::size_t most_lines = 4096;
constexpr std::size_t most_bytes = std::size_t{16} << 20;
constexpr std::size_t piece_bytes = std::size_t{1} << 20;

}  // namespace

OrderedWork::OrderedWork(int threads, Answer answer, Write write)
    : answer_(std::move(answer)), write_(std::move(write)) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
  threads_.emplace_back([this] { write_in_order(); });
}

OrderedWork::~OrderedWork() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  for (auto* changed : {&room_, &waiting_, &done_}) changed->notify_all();
}

bool OrderedWork::has_room() const {
  return slots_.empty() || (slots_.size() < most_lines && bytes_ < most_bytes);
}

// The first one may always begin: the others wait to be written behind it.
bool OrderedWork::may_begin() const {
  const bool is_there = next_ - first_ < slots_.size();
  return is_there && (next_ == first_ || bytes_ < most_bytes);
}

void OrderedWork::add(InputLine line) {
  std::unique_lock lock(mutex_);
  room_.wait(lock, [&] { return failed_ || has_room(); });
  if (failed_) std::rethrow_exception(failed_);
  bytes_ += line.text.size();
  slots_.push_back({.line = std::move(line), .answer = {}});
  waiting_.notify_one();
}

void OrderedWork::finish() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    waiting_.notify_all();
    done_.notify_all();
  }
  threads_.clear();  // joins them
  if (failed_) std::rethrow_exception(failed_);
}

void OrderedWork::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    waiting_.wait(lock,
                  [&] { return failed_ || may_begin() || (ended_ && next_ - first_ >= slots_.size()); });
    if (failed_ || !may_begin()) return;
    const std::uint64_t number = next_++;
    slot(number).stage = Stage::running;
    const InputLine line = std::move(slot(number).line);  // its bytes stay with the slot
    lock.unlock();
    std::string answer = answer_(line);
    lock.lock();
    bytes_ += answer.size();
    bytes_ -= line.text.size();
    slot(number).answer = std::move(answer);
    slot(number).stage = Stage::done;
    if (number == first_) done_.notify_one();
  }
}

OrderedWork::Piece OrderedWork::take_done() {
  Piece piece;
  while (!slots_.empty() && slots_.front().stage == Stage::done && piece.text.size() < piece_bytes) {
    Slot& first = slots_.front();
    piece.input_bytes += first.line.bytes;
    if (piece.text.empty()) {
      piece.text = std::move(first.answer);
    } else {
      piece.text += first.answer;
    }
    slots_.pop_front();
    ++first_;
    ++piece.lines;
  }
  return piece;
}

void OrderedWork::write_in_order() {
  std::unique_lock lock(mutex_);
  for (;;) {
    done_.wait(lock, [&] {
      return (!slots_.empty() && slots_.front().stage == Stage::done) || (ended_ && slots_.empty());
    });
    if (slots_.empty()) return;
    const Piece piece = take_done();
    lock.unlock();
    std::exception_ptr failed;
    try {
      write_(piece);
    } catch (...) {
      failed = std::current_exception();
    }
    lock.lock();
    bytes_ -= piece.text.size();
    failed_ = failed;
    room_.notify_all();
    waiting_.notify_all();
    if (failed_) return;
  }
}

}  // namespace qdot::server
