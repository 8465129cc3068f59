#pragma once
// What is wrong with a command line, and what to type instead.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "server/usage_error.hpp"

namespace qdot::server {

/// "help modes" is "modes --help", "turning-points" the command turning_points, "version" --version.
[[nodiscard]] std::vector<std::string> in_known_words(const CLI::App& app, std::vector<std::string> words);

/// Throws UsageError for a command or an option that is not known, with the one that was probably meant, and
/// for one that is empty.
void check_words(const CLI::App& app, const std::vector<std::string>& words);

/// Throws UsageError where what CLI11 has found wrong was not typed: it came from the environment.
void blame_environment(const CLI::App& command, const CLI::ParseError& error,
                       const std::vector<std::string>& words);

}  // namespace qdot::server
