#include "server/batch_output.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>

#include "server/output.hpp"
#include "server/usage_error.hpp"

namespace qdot::server {
namespace {

[[noreturn]] void throw_errno(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// Whoever could read a pipe of answers would be its reader: nobody else would be waited for, or missed.
int way_of_opening(BatchOutput::Start start) {
  return start == BatchOutput::Start::where_it_ended ? O_RDWR : O_WRONLY;
}

bool is_file(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

/// Of links, too, and however it was opened.
bool are_one_file(int input, int output) {
  struct stat read {};
  struct stat written {};
  if (::fstat(input, &read) != 0 || ::fstat(output, &written) != 0) return false;
  return S_ISREG(read.st_mode) && read.st_dev == written.st_dev && read.st_ino == written.st_ino;
}

}  // namespace

BatchOutput::BatchOutput(const std::string& path, Start start, int input)
    : start_(start), descriptor_(STDOUT_FILENO) {
  if (!path.empty()) {
    file_ = Descriptor(::open(path.c_str(), way_of_opening(start) | O_CREAT | O_CLOEXEC, 0666));
    descriptor_ = file_.get();
    if (descriptor_ < 0) throw UsageError("cannot write " + path);
  }
  if (are_one_file(input, descriptor_))
    throw UsageError(
        "the answers would be written over the lines that are read: give them a file of their own");
  if (path.empty()) return;
  is_named_file_ = is_file(descriptor_);
  if (is_named_file_ && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
    throw UsageError("another batch writes " + path);
  if (!is_named_file_ && start == Start::where_it_ended)
    throw UsageError(path + " is no file that a batch could be resumed with");
}

std::optional<LineReader> BatchOutput::answers(std::size_t longest) const {
  return start_ == Start::anew ? std::nullopt
                               : std::optional<LineReader>(std::in_place, descriptor_, longest);
}

bool BatchOutput::is_terminal() const { return ::isatty(descriptor_) != 0; }

bool BatchOutput::ends_with(std::string_view text, std::uint64_t kept) const {
  std::string there(text.size(), ' ');
  const auto from = static_cast<off_t>(kept) - static_cast<off_t>(text.size());
  const auto count = from < 0 ? 0 : ::pread(descriptor_, there.data(), there.size(), from);
  return count == static_cast<ssize_t>(text.size()) && there == text;
}

void BatchOutput::begin(std::uint64_t kept) {
  const auto end = static_cast<off_t>(kept);
  if (is_named_file_ && (::ftruncate(descriptor_, end) != 0 || ::lseek(descriptor_, end, SEEK_SET) < 0))
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

void BatchOutput::finish() {
  if (is_named_file_ && ::fsync(descriptor_) != 0) refuse_to_lose("the answers");
}

void BatchOutput::close() {
  // It is never unlocked again.
  static_cast<void>(writing_.try_lock_for(std::chrono::seconds(1)));
}

}  // namespace qdot::server
