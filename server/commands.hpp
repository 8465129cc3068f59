#pragma once
// The commands that answer without a server: a command line becomes the request that a client would send.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace qdot::server {

/// What `qdot` returns to its caller.
enum class ExitCode { ok = 0, usage = 2, invalid_request = 3, failed = 4, internal = 5, unreachable = 6 };

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
};

/// A command asks for the path /v1/{name}; if it takes no words, for /{name}.json.
inline constexpr std::array commands{
    Command{"simulate", "The trajectory of a system"},
    Command{"equations", "Lagrangian, equations of motion and what is conserved"},
    Command{"energy", "Energies, momenta and accelerations at a state"},
    Command{"modes", "Equilibrium, natural frequencies and mode shapes"},
    Command{"turning_points", "The largest and the least value of a coordinate"},
    Command{"equilibria", "All equilibria, or the parameter that makes a position one"},
    Command{"bifurcations", "Critical values of a parameter"},
    Command{"gait", "Periodic gaits of a walker"},
    Command{"accuracy", "The measured trade of error against work"},
    Command{"systems", "The systems there are, or one of them", Words::name},
    Command{"problems", "The practice sheet, or one of its problems with answers", Words::name},
    Command{"openapi", "The description of the service in OpenAPI 3.1", Words::none},
};

struct Arguments {
  std::vector<std::string> words;
  std::string request_file;  ///< "-" means stdin
  std::string format;        ///< json, csv
  bool pretty{false};
  std::string scenes;  ///< a directory of more scenes
};

/// Prints the answer on stdout, or the problem on stderr.
[[nodiscard]] ExitCode run(const Command& command, const Arguments& arguments);

}  // namespace qdot::server
