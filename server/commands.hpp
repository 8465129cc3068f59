#pragma once
// The commands that answer without a server: a command line becomes the request that a client would send.
// There is one for each endpoint, and a few for documents.

#include <string>
#include <string_view>
#include <vector>

#include "api/answers/endpoint.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::server {

/// What `qdot` returns to its caller.
enum class ExitCode {
  ok = 0,
  not_all_right = 1,
  usage = 2,
  invalid_request = 3,
  failed = 4,
  internal = 5,
  unreachable = 6,
  unwritten = 7,  ///< the answer is there and could not be written: a disk is full
  stopped = 128   ///< by a signal, whose number is added as shells do: Ctrl-C makes it 130, SIGTERM 143
};

/// What the words after a command are.
enum class Words {
  request,  ///< key=value; without any, the request is a JSON body
  name,     ///< at most one name, the last part of the path
  none      ///< there are none
};

struct Command {
  std::string_view name;
  std::string_view help;
  Words words{Words::request};
  const api::Endpoint* endpoint{nullptr};  ///< nullptr: the command computes nothing
};

/// Every endpoint (api/answers/endpoints.hpp) that takes one request, then the commands that compute nothing.
/// A command asks for the path /v1/{name}; if it takes no words, for /{name}.json.
[[nodiscard]] std::vector<Command> commands();

/// Whether the answer of a command has several forms, which `--format` chooses from.
[[nodiscard]] bool has_formats(const Command& command);

/// Whether the command grades: it takes a key and answers, too.
[[nodiscard]] bool grades(const Command& command);

struct Arguments {
  std::vector<std::string> words;
  std::string request_file;  ///< "-" means stdin
  std::string format;        ///< table, or one of the answer's own: json, csv, ndjson
  bool json{false};          ///< as it is, on a terminal too
  bool pretty{false};
  std::string key, answers;  ///< files of a check
  bool strict{false};        ///< of a check: anything but right answers is a failure
  std::string scenes;        ///< a directory of more scenes
  bool bounded{false};       ///< no more work than a service would do
};

/// A command line that is answered: "qdot turning_points free_spin_pendulum".
[[nodiscard]] std::string example_of(const Command& command, const api::Catalogue& catalogue);

/// The fields of a command's request with their units, defaults and meaning, the symbols of the system that
/// the words name, and an example, for its --help.
[[nodiscard]] std::string help_on_fields(const Command& command, const Arguments& arguments);

/// Prints the answer on stdout, or the problem on stderr: as JSON, or on a terminal as text for people.
[[nodiscard]] ExitCode run(const Command& command, const Arguments& arguments);

}  // namespace qdot::server
