#include "server/batch.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "api/about/field_help.hpp"
#include "api/answers/batch/line.hpp"
#include "api/answers/endpoints.hpp"
#include "api/service.hpp"
#include "server/batch_output.hpp"
#include "server/batch_progress.hpp"
#include "server/descriptor.hpp"
#include "server/line_reader.hpp"
#include "server/ordered_work.hpp"
#include "server/processors.hpp"
#include "server/resumed.hpp"
#include "server/signals.hpp"
#include "server/usage_error.hpp"

namespace qdot::server {
namespace {

sigset_t stopping_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP})
    if (!is_ignored(signal)) sigaddset(&signals, signal);
  return signals;
}

/// In this thread and in those that it starts from now on: a thread that left them alone would be ended by
/// one, and all others with it.
void leave_signals_to_one_thread() {
  const sigset_t signals = stopping_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

/// Waits for a signal in a thread of its own, because the others may be computing, or waiting for a pipe.
/// Whichever comes first, the signal or the end of the batch, locks the mutex, and the other waits for the
/// end of the process: what the thread looks at may be gone.
class EndOnSignal {
 public:
  EndOnSignal(BatchOutput& output, const BatchProgress& progress) {
    std::thread([&output, &progress, ending = ending_, signals = stopping_signals()] {
      int signal = 0;
      sigwait(&signals, &signal);
      ending->lock();
      output.close();
      std::cerr << "\nStopped after " << progress.state().lines << " lines"
                << (output.can_be_resumed() ? "; --resume goes on there." : ".") << std::endl;
      _exit(static_cast<int>(ExitCode::stopped) + signal);
    }).detach();
  }
  ~EndOnSignal() { ending_->lock(); }
  EndOnSignal(const EndOnSignal&) = delete;
  EndOnSignal& operator=(const EndOnSignal&) = delete;

 private:
  std::shared_ptr<std::mutex> ending_{std::make_shared<std::mutex>()};
};

bool is_standard_stream(const std::string& file) { return file.empty() || file == "-"; }

Descriptor descriptor_of(const std::string& file) {
  if (is_standard_stream(file)) {
    if (::isatty(STDIN_FILENO) != 0)
      throw UsageError("name a file of requests, a line each, or give them on stdin");
    return Descriptor(::dup(STDIN_FILENO));
  }
  return Descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
}

Descriptor opened(const std::string& file) {
  const std::string name = is_standard_stream(file) ? "stdin" : file;
  Descriptor descriptor = descriptor_of(file);
  const bool can_be_read = ::read(descriptor.get(), nullptr, 0) == 0;
  if (!can_be_read && errno == EISDIR) throw UsageError(name + " is a directory, and no file of lines");
  if (!can_be_read) throw UsageError("cannot read " + name);
  return descriptor;
}

/// Of a file; a pipe does not tell.
std::optional<std::uint64_t> size_of(int descriptor) {
  struct stat status {};
  const bool is_file = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  return is_file ? std::optional(static_cast<std::uint64_t>(status.st_size)) : std::nullopt;
}

const api::FieldSet& line_fields() { return *api::endpoint_at("/v1/batch")->question.fields; }

std::string answer_to(const InputLine& line, const api::Service& service, api::Work work) {
  if (line.is_overlong) return api::answer_to_overlong_line();
  return api::answered_line(line.text, line_fields(), [&](const std::string& endpoint, std::string body) {
    return service.handle({.method = "POST",
                           .target = "/v1/" + endpoint,
                           .headers = {{"content-type", "application/json"}},
                           .body = std::move(body),
                           .work = work});
  });
}

std::string id_of(const InputLine& line) {
  return line.is_overlong ? "null" : api::id_of_line(line.text, line_fields());
}

/// All that could be refused has been looked at when the file is changed.
std::optional<InputLine> begin(BatchOutput& output, LineReader& lines, BatchProgress& progress,
                               const std::function<std::string(const InputLine&)>& answer) {
  Resumed found;
  if (auto answers = output.answers(beginning_of_answer)) found = resumed(*answers, lines, id_of);
  if (found.last && !output.ends_with(answer(*found.last), found.answer_bytes))
    throw UsageError("the answer to line " + std::to_string(found.lines) +
                     " is another now: the lines were changed, or these are answers of another version");
  progress.skip(found.lines, found.line_bytes);
  output.begin(found.answer_bytes);
  return std::move(found.next);
}

int threads_of(const BatchOptions& options) {
  if (options.jobs > 0) return options.jobs;
  return usable_processors();
}

}  // namespace

ExitCode run_batch(const BatchOptions& options) {
  const std::string path = is_standard_stream(options.output) ? "" : options.output;
  if (options.resume && path.empty()) throw UsageError("--resume needs --output FILE");
  ::mallopt(M_ARENA_MAX, 4);  // what one thread frees, others use
  const Descriptor input = opened(options.file);
  const api::Service service({.scenes_directory = options.scenes});
  const auto start = options.resume ? BatchOutput::Start::where_it_ended : BatchOutput::Start::anew;
  BatchOutput output(path, start, input.get());
  leave_signals_to_one_thread();  // until here, where it may wait for a reader, they simply end it
  BatchProgress progress(size_of(input.get()), output.is_terminal());
  const EndOnSignal end_on_signal(output, progress);
  LineReader reader(input.get(), api::longest_batch_line());
  const api::Work bounds = options.bounded ? api::Work::bounded : api::Work::unbounded;
  const auto answer = [&](const InputLine& line) { return answer_to(line, service, bounds); };
  auto line = begin(output, reader, progress, answer);
  if (!line) line = reader.next();
  OrderedWork work(threads_of(options), answer, [&](const OrderedWork::Piece& piece) {
    output.write(piece.text);
    progress.add(piece.lines, piece.input_bytes);
  });
  for (; line; line = reader.next()) work.add(std::move(*line));
  work.finish();
  output.finish();
  return ExitCode::ok;
}

std::string help_on_lines() {
  return api::fields_as_text(line_fields()) + R"(

Example: qdot batch
with lines on standard input such as {"id": 1, "modes": {"system": "cart_pendulum"}})";
}

}  // namespace qdot::server
