#pragma once
// What is wrong with a command line, and what to type instead.

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace qdot::server {

/// The command line cannot be followed as it is; what() says what to type.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The notation of equations that the word names, tex for latex; empty: none.
[[nodiscard]] std::string_view form_called(std::string_view word);

/// "help modes" is "modes --help", "turning-points" the command turning_points, "version" --version.
[[nodiscard]] std::vector<std::string> in_known_words(const CLI::App& app, std::vector<std::string> words);

/// Throws UsageError for a command or an option that is not known, with the one that was probably meant.
void check_words(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace qdot::server
