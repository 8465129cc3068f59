#include "server/batch_output.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <vector>

#include "server/output.hpp"
#include "server/usage_error.hpp"

namespace qdot::server {
namespace {

constexpr std::string_view before_id = R"({"id":)";
constexpr std::string_view after_id = R"(,"status":)";
constexpr std::size_t longest_beginning = 4096;  ///< bytes in which the id of an answer stands

[[noreturn]] void throw_errno(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

std::size_t read_at(int file, std::vector<char>& block, off_t at) {
  const ssize_t count = ::pread(file, block.data(), block.size(), at);
  if (count < 0) throw_errno("cannot read the answers that are there");
  return static_cast<std::size_t>(count);
}

/// What the newlines in a file say of it.
struct Lines {
  std::uint64_t count{0};
  off_t end{0};         ///< of the last whole line
  off_t last_begin{0};  ///< of that line
};

Lines lines_in(int file) {
  Lines lines;
  std::vector<char> block(std::size_t{1} << 20);
  off_t at = 0;
  while (const std::size_t count = read_at(file, block, at)) {
    for (std::size_t i = 0; i < count; ++i) {
      if (block[i] != '\n') continue;
      ++lines.count;
      lines.last_begin = lines.end;
      lines.end = at + static_cast<off_t>(i) + 1;
    }
    at += static_cast<off_t>(count);
  }
  return lines;
}

std::string id_at(int file, off_t begin) {
  std::vector<char> block(longest_beginning);
  const std::string_view text(block.data(), read_at(file, block, begin));
  const std::size_t end = text.find(after_id);
  const bool is_answer = text.starts_with(before_id) && end != std::string_view::npos;
  return is_answer ? std::string(text.substr(before_id.size(), end - before_id.size())) : "";
}

/// Of links, too, and however it was opened.
bool are_one_file(int input, int output) {
  struct stat read {};
  struct stat written {};
  if (::fstat(input, &read) != 0 || ::fstat(output, &written) != 0) return false;
  return S_ISREG(read.st_mode) && read.st_dev == written.st_dev && read.st_ino == written.st_ino;
}

}  // namespace

BatchOutput::BatchOutput(const std::string& path, Start start, int input) : descriptor_(STDOUT_FILENO) {
  if (!path.empty()) {
    file_ = Descriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    descriptor_ = file_.get();
    if (descriptor_ < 0) throw UsageError("cannot write " + path);
  }
  if (are_one_file(input, descriptor_))
    throw UsageError(
        "the answers would be written over the lines that are read: give them a file of their own");
  if (path.empty()) return;
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) throw UsageError("another batch writes " + path);
  struct stat status {};
  const bool is_regular = ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  if (!is_regular && start == Start::where_it_ended)
    throw UsageError(path + " is no file that a batch could be resumed with");
  if (is_regular) end_ = start == Start::anew ? 0 : end_of_the_answers();
}

off_t BatchOutput::end_of_the_answers() {
  const Lines there = lines_in(descriptor_);
  lines_ = there.count;
  if (there.count > 0) last_id_ = id_at(descriptor_, there.last_begin);
  return there.end;
}

bool BatchOutput::is_terminal() const { return ::isatty(descriptor_) != 0; }

void BatchOutput::begin() {
  if (end_ && (::ftruncate(descriptor_, *end_) != 0 || ::lseek(descriptor_, *end_, SEEK_SET) < 0))
    throw_errno("cannot go to the end of the answers");
}

void BatchOutput::write(std::string_view text) {
  const std::lock_guard lock(writing_);
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor_, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse_to_lose("the answers");
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

void BatchOutput::close() {
  // It is never unlocked again.
  static_cast<void>(writing_.try_lock_for(std::chrono::seconds(1)));
}

}  // namespace qdot::server
