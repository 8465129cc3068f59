#include "core/base/work.hpp"

#include <limits>
#include <utility>

#include "core/base/error.hpp"

namespace qdot {
namespace {

constexpr std::uint64_t poll_interval = 4096;

thread_local WorkScope* innermost = nullptr;

}  // namespace

WorkScope::WorkScope(std::uint64_t units, std::function<bool()> interrupted)
    : left_(units), interrupted_(std::move(interrupted)), outer_(innermost) {
  innermost = this;
}

WorkScope::~WorkScope() { innermost = outer_; }

void spend_work(std::uint64_t units) {
  WorkScope* const scope = innermost;
  if (scope == nullptr) return;
  if (units > scope->left_)
    throw Error(ErrorCode::too_large, "This question takes more work than one answer may.");
  scope->left_ -= units;
  scope->unpolled_ += units;
  if (scope->unpolled_ < poll_interval) return;
  scope->unpolled_ = 0;
  check_interruption();
}

std::uint64_t work_left() {
  return innermost == nullptr ? std::numeric_limits<std::uint64_t>::max() : innermost->left_;
}

void check_interruption() {
  for (const WorkScope* scope = innermost; scope != nullptr; scope = scope->outer_) {
    if (scope->interrupted_ && scope->interrupted_()) throw Interrupted{};
  }
}

void check_interruption(std::uint64_t step) {
  if (step % poll_interval == 0) check_interruption();
}

}  // namespace qdot
