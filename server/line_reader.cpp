#include "server/line_reader.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace qdot::server {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 16;

}  // namespace

std::optional<InputLine> LineReader::next() {
  InputLine line;
  while (at_ < block_.size() || refill()) {
    const std::size_t newline = block_.find('\n', at_);
    if (newline == std::string::npos) {
      take(block_.size() - at_, line);
      continue;
    }
    take(newline - at_, line);
    ++at_;
    ++line.bytes;
    line.is_ended = true;
    return line;
  }
  return line.bytes > 0 ? std::optional(std::move(line)) : std::nullopt;
}

void LineReader::take(std::size_t count, InputLine& line) {
  line.bytes += count;
  line.is_overlong = line.bytes > longest_;
  line.nuls +=
      static_cast<std::uint64_t>(std::ranges::count(block_.data() + at_, block_.data() + at_ + count, '\0'));
  line.text.append(block_, at_, std::min(count, longest_ - line.text.size()));
  at_ += count;
}

bool LineReader::refill() {
  block_.resize(block_bytes);
  at_ = 0;
  ssize_t count = 0;
  do count = ::read(descriptor_, block_.data(), block_.size());
  while (count < 0 && errno == EINTR);
  if (count < 0) {
    block_.clear();
    throw std::system_error(errno, std::generic_category(), "cannot read the lines");
  }
  block_.resize(static_cast<std::size_t>(count));
  return count > 0;
}

}  // namespace qdot::server
