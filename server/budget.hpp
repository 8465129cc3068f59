#pragma once
// A bound on the bytes that many holders have together.

#include <atomic>
#include <cstddef>
#include <optional>
#include <utility>

namespace qdot::server {

class Budget {
 public:
  explicit Budget(std::size_t limit) : limit_(limit) {}

  /// Gives its bytes back when it goes.
  class Share {
   public:
    Share() = default;
    Share(Budget& budget, std::size_t bytes) : budget_(&budget), bytes_(bytes) {}
    ~Share() {
      if (budget_ != nullptr) budget_->used_ -= bytes_;
    }
    Share(Share&& other) noexcept : budget_(std::exchange(other.budget_, nullptr)), bytes_(other.bytes_) {}
    Share& operator=(Share&& other) noexcept {
      std::swap(budget_, other.budget_);
      std::swap(bytes_, other.bytes_);
      return *this;
    }

    /// Gives back all but so many bytes.
    void shrink_to(std::size_t bytes) {
      if (budget_ == nullptr || bytes >= bytes_) return;
      budget_->used_ -= bytes_ - bytes;
      bytes_ = bytes;
    }

   private:
    Budget* budget_{nullptr};
    std::size_t bytes_{0};
  };

  /// Has no value if the bytes would pass the bound.
  [[nodiscard]] std::optional<Share> take(std::size_t bytes) {
    if (used_.fetch_add(bytes) + bytes > limit_) {
      used_ -= bytes;
      return std::nullopt;
    }
    return Share(*this, bytes);
  }

  /// For bytes that exist already, so that they can only be counted.
  [[nodiscard]] Share count(std::size_t bytes) {
    used_ += bytes;
    return {*this, bytes};
  }

  [[nodiscard]] std::size_t used() const { return used_; }

 private:
  std::size_t limit_;
  std::atomic<std::size_t> used_{0};
};

}  // namespace qdot::server
