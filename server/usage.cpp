#include "server/usage.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>

#include "api/answers/endpoints.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"
#include "api/scenes/catalogue.hpp"
#include "server/words.hpp"

namespace qdot::server {
namespace {

using WordSpan = std::span<const std::string>;

/// What people type for the commands that are no endpoints (those have their own other_names).
constexpr auto other_commands = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"start", "serve"},      {"server", "serve"},      {"listen", "serve"},        {"up", "serve"},
    {"list", "systems"},     {"ls", "systems"},        {"system", "systems"},      {"models", "systems"},
    {"problem", "problems"}, {"exercise", "problems"}, {"sheet", "problems"},      {"status", "health"},
    {"ping", "health"},      {"api", "openapi"},       {"spec", "openapi"},        {"man", "manual"},
    {"docs", "--help"},      {"usage", "--help"},      {"complete", "completion"}, {"plot", "serve"},
    {"show", "systems"},     {"gui", "serve"},         {"draw", "serve"},          {"info", "systems"},
    {"describe", "systems"}, {"scenes", "systems"},    {"classics", "systems"},    {"catalogue", "systems"},
    {"catalog", "systems"},
});

/// Options of other programs, and what does it here.
constexpr auto other_options = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"--csv", "--format csv"},
    {"--ndjson", "--format ndjson"},
    {"--table", "--format table"},
    {"--output", "> FILE"},
    {"-o", "> FILE"},
    {"--out", "> FILE"},
    {"-p", "--pretty"},
    {"-v", "--version"},
    {"-V", "--version"},
    {"--indent", "--pretty"},
    {"--file", "--request FILE"},
    {"-f", "--request FILE"},
    {"--input", "--request FILE"},
    {"-d", "--request FILE"},
    {"--bind", "--host"},
});

constexpr std::array commands_of_a_server{"serve", "health", "wait"};

const CLI::App* command_called(const CLI::App& app, const std::string& name) {
  const auto all = app.get_subcommands({});
  const auto found = std::ranges::find(all, name, &CLI::App::get_name);
  return found == all.end() ? nullptr : *found;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::string command_meant(const CLI::App& app, const std::string& word) {
  const std::string plain = api::lower_case(word);
  for (const api::Endpoint& endpoint : api::endpoints())
    if (api::is_called(endpoint, plain)) return std::string(endpoint.name);
  const auto other = std::ranges::find(other_commands, plain, [](const auto& pair) { return pair.first; });
  if (other != other_commands.end()) return std::string(other->second);
  return api::closest(word, command_names(app));
}

/// "qdot cart_pendulum modes" has the system before the question.
std::string turned_round(const CLI::App& app, WordSpan words) {
  const std::string system = api::same_letters(words[0], api::Catalogue::built_in().names());
  if (system.empty()) return {};
  const bool has_question = words.size() > 1 && command_called(app, words[1]) != nullptr;
  return has_question ? words[1] + " " + system : "modes " + system;
}

[[noreturn]] void refuse_command(const CLI::App& app, WordSpan words) {
  std::string meant = turned_round(app, words);
  if (meant.empty()) meant = command_meant(app, words[0]);
  const std::string what = "there is no command " + api::in_quotes(words[0]);
  throw UsageError(what + (meant.empty() ? "; " : "; did you mean qdot " + meant + "? ") +
                   "qdot --help lists the commands");
}

bool is_field_of(const std::string& command, const std::string& name) {
  const auto& all = api::endpoints();
  const auto found = std::ranges::find(all, command, &api::Endpoint::name);
  return found != all.end() && found->question.fields->find(name) != nullptr;
}

/// -p is of a port where there is one.
std::string_view option_of_others(const CLI::App& command, std::string_view name) {
  if (name == "-p" && command.get_option_no_throw("--port") != nullptr) return "--port";
  const auto other = std::ranges::find(other_options, name, [](const auto& pair) { return pair.first; });
  return other == other_options.end() ? std::string_view() : other->second;
}

bool serves_with(std::string_view option) {
  constexpr std::array all{"--port", "--host", "--threads", "--scenes", "--allowed-hosts", "--unix-socket"};
  return std::ranges::find(all, option) != all.end();
}

/// "--k=10", or "--k" before "10".
[[noreturn]] void refuse_option(const CLI::App& command, WordSpan words) {
  const std::string& word = words[0];
  const std::string name = word.substr(0, word.find('='));
  const std::string field = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  if (field.empty()) throw UsageError("the word " + api::in_quotes(word) + " has no name behind its dashes");
  std::string what = "there is no option " + api::in_quotes(name);
  if (const std::string_view other = option_of_others(command, name); !other.empty())
    throw UsageError(what + "; type " + std::string(other));
  if (command.get_parent() == nullptr && serves_with(name))
    throw UsageError(what + " before a command: type qdot serve " +
                     api::printable(words.size() > 1 ? word + " " + words[1] : word));
  if (const std::string_view form = form_called(field); !form.empty())
    throw UsageError(what + "; type form=" + std::string(form));
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options())
    if (option->nonpositional()) known.push_back("--" + option->get_single_name());
  const bool is_field = is_field_of(command.get_name(), field);
  if (const std::string near = api::closest(name, known); !is_field && !near.empty() && near.size() > 4)
    throw UsageError(what + "; did you mean " + near + "?");
  if (command.get_parent() == nullptr)
    throw UsageError(what + "; there are " + api::enumerated(known) + ", and each command has its own");
  if (std::ranges::find(commands_of_a_server, command.get_name()) != commands_of_a_server.end())
    throw UsageError(what + "; there are " + api::enumerated(known));
  std::string value = word.find('=') == std::string::npos ? "" : word.substr(word.find('=') + 1);
  if (value.empty() && words.size() > 1 && !words[1].starts_with('-')) value = words[1];
  throw UsageError(
      what + "; fields have no dashes: " + api::printable(field + "=" + (value.empty() ? "VALUE" : value)));
}

/// "qdot serve 9000", "qdot serve port=9000"
void check_server_word(const std::string& word) {
  const std::size_t equals = word.find('=');
  const bool is_port = !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
  if (is_port) throw UsageError("a port has its name before it: --port " + api::printable(word));
  if (equals != std::string::npos && equals > 0)
    throw UsageError("options have dashes here: --" +
                     api::printable(word.substr(0, equals) + " " + word.substr(equals + 1)));
  if (const std::size_t colon = word.rfind(':'); colon != std::string::npos && colon > 0)
    throw UsageError("an address is given in two parts: --host " + api::printable(word.substr(0, colon)) +
                     " --port " + api::printable(word.substr(colon + 1)));
  throw UsageError("the word " + api::in_quotes(word) + " means nothing here; --help lists the options");
}

/// The shell has put it for "$FILE" where there is no FILE: what is done without it was not meant.
[[noreturn]] void refuse_empty(const std::string& what) {
  throw UsageError(what + " is empty; is it a variable of the shell that is not set?");
}

/// `words` begin with the option.
void check_value(const CLI::Option& option, WordSpan words) {
  if (option.get_items_expected_max() == 0) return;
  const std::size_t equals = words[0].find('=');
  const bool is_next = equals == std::string::npos && words.size() > 1;
  if (is_next ? words[1].empty() : equals + 1 == words[0].size()) refuse_empty(words[0].substr(0, equals));
}

}  // namespace

std::vector<std::string> in_known_words(const CLI::App& app, std::vector<std::string> words) {
  if (words.empty()) return words;
  if (words[0] == "help") {
    words.erase(words.begin());
    words.insert(words.begin() + (words.empty() ? 0 : 1), "--help");
  } else if (words[0] == "version") {
    words[0] = "--version";
  }
  if (command_called(app, words[0]) == nullptr && words[0].find('-') != 0) {
    std::string plain = words[0];
    std::ranges::replace(plain, '-', '_');
    if (command_called(app, plain) != nullptr) words[0] = plain;
  }
  return words;
}

void check_words(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.empty()) throw UsageError("a command is missing\n\n" + app.help());
  const bool is_option = words[0].starts_with('-');
  const CLI::App* command = is_option ? &app : command_called(app, words[0]);
  if (command == nullptr) refuse_command(app, words);
  const bool is_server = std::ranges::find(commands_of_a_server, words[0]) != commands_of_a_server.end();
  for (std::size_t i = is_option ? 0 : 1; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--") return;
    if (word.empty()) refuse_empty("a word of the command line");
    if (word.size() < 2 || word[0] != '-') {
      if (is_server) check_server_word(word);
      continue;
    }
    const CLI::Option* option = command->get_option_no_throw(word.substr(0, word.find('=')));
    if (option == nullptr) refuse_option(*command, WordSpan(words).subspan(i));
    check_value(*option, WordSpan(words).subspan(i));
    const bool takes_next = option->get_items_expected_max() > 0 && word.find('=') == std::string::npos;
    if (takes_next) ++i;
  }
}

std::string variable_at_fault(const CLI::App& app, const std::vector<std::string>& words,
                              std::string_view complaint) {
  const CLI::App* command = words.empty() ? nullptr : command_called(app, words[0]);
  if (command == nullptr) return {};
  const std::string name(complaint.substr(0, complaint.find(':')));
  const CLI::Option* option = name.empty() ? nullptr : command->get_option_no_throw(name);
  if (option == nullptr || option->get_envname().empty()) return {};
  const bool is_typed = std::ranges::any_of(
      words, [&](const std::string& word) { return word.substr(0, word.find('=')) == name; });
  return is_typed ? std::string() : option->get_envname();
}

}  // namespace qdot::server
