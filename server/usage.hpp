#pragma once
// What is wrong with a command line, and what to type instead.

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "server/usage_error.hpp"

namespace qdot::server {

/// "help modes" is "modes --help", "turning-points" the command turning_points, "version" --version.
[[nodiscard]] std::vector<std::string> in_known_words(const CLI::App& app, std::vector<std::string> words);

/// Throws UsageError for a command or an option that is not known, with the one that was probably meant, and
/// for one that is empty.
void check_words(const CLI::App& app, const std::vector<std::string>& words);

/// The variable of the environment that `complaint` of CLI11, "--port: Value x not in range 0 to 65535", is
/// about; empty where the option was typed.
[[nodiscard]] std::string variable_at_fault(const CLI::App& app, const std::vector<std::string>& words,
                                            std::string_view complaint);

}  // namespace qdot::server
