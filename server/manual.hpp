#pragma once
// Documents about the command line, made from the tables that the program itself reads its words by.

#include <CLI/CLI.hpp>
#include <string>

namespace qdot::server {

/// qdot(1) in roff, man(7): every command with its options, fields and an example.
[[nodiscard]] std::string manual_page(const CLI::App& app);

/// A script for bash that completes commands, options, systems, fields, a system's symbols and the words that
/// a field may have.
[[nodiscard]] std::string bash_completion(const CLI::App& app);

}  // namespace qdot::server
