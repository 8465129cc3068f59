#include "server/manual.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "api/about/field_help.hpp"
#include "api/contract/version.hpp"
#include "api/scenes/catalogue.hpp"
#include "server/commands.hpp"

namespace qdot::server {
namespace {

constexpr auto exit_codes = std::to_array<std::pair<int, std::string_view>>({
    {0, "answered"},
    {2, "the command line is wrong"},
    {3, "the request is wrong"},
    {4, "the computation failed"},
    {5, "our own mistake"},
    {6, "no server answers"},
    {7, "the answer could not be written: a disk is full, say"},
    {129, "stopped by SIGHUP, as by a terminal that is closed"},
    {130, "stopped by Ctrl-C"},
    {143, "stopped by SIGTERM: 128 and the number of the signal"},
});

/// Text for roff: a point or a quotation mark at the start of a line would be a command.
std::string roff(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool starts_line = result.empty() || result.back() == '\n';
    if (starts_line && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

/// Lines as they are.
std::string verbatim(std::string_view text) { return ".nf\n" + roff(text) + "\n.fi\n"; }

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  std::vector<const CLI::Option*> options;
  for (const CLI::Option* option : command.get_options())
    if (option->nonpositional()) options.push_back(option);
  return options;
}

const Command* find_command(const std::vector<Command>& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &Command::name);
  return found == all.end() ? nullptr : &*found;
}

void write_command(const CLI::App& app, const Command* command, const api::Catalogue& catalogue,
                   std::ostream& out) {
  out << ".SS qdot " << roff(app.get_name()) << "\n" << roff(app.get_description()) << ".\n";
  for (const CLI::Option* option : options_of(app)) {
    const std::string value = option->get_items_expected_max() > 0 ? " VALUE" : "";
    out << ".TP\n.B " << roff(option->get_name() + value) << "\n" << roff(option->get_description()) << "\n";
    if (!option->get_envname().empty()) out << "In the environment: " << option->get_envname() << ".\n";
  }
  if (command == nullptr || command->endpoint == nullptr) return;
  out << ".PP\n" << verbatim(api::fields_as_text(*command->endpoint->question.fields));
  out << ".PP\nExample:\n" << verbatim("    " + example_of(*command, catalogue));
}

/// "a b c"
std::string in_a_row(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(command)) names.push_back("--" + option->get_single_name());
  return names;
}

/// The words that fields may have: "simulate.method" "auto taylor ...".
void write_choices(const Command& command, std::ostream& out) {
  for (const api::FieldInfo& field : command.endpoint->question.fields->fields) {
    const api::Kind* kind = &field.kind;
    if (const auto* list = std::get_if<api::ListKind>(kind)) kind = list->element.get();
    const auto* choice = std::get_if<api::ChoiceKind>(kind);
    std::string words = choice != nullptr ? in_a_row(choice->options) : "";
    if (std::holds_alternative<api::BooleanKind>(*kind)) words = "true false";
    if (!words.empty())
      out << "    " << command.name << "." << field.name << ") values=\"" << words << "\" ;;\n";
  }
}

std::vector<std::string> plain_fields(const Command& command) {
  std::vector<std::string> names;
  for (const api::FieldInfo& field : command.endpoint->question.fields->fields)
    if (symbols_kind(field) == nullptr && field.name != "system") names.push_back(field.name + "=");
  return names;
}

std::vector<std::string> symbols_of(const Scene& scene) {
  std::vector<std::string> names;
  for (const api::SymbolRole role :
       {api::SymbolRole::parameter, api::SymbolRole::initial, api::SymbolRole::input})
    for (const api::Symbol& symbol : symbols(scene, role)) names.push_back(symbol.name + "=");
  return names;
}

constexpr std::string_view end_of_completion = R"(
  # Bash parts words at =: "method=ta" arrives as three of them.
  if [ "$previous" = "=" ] || [ "$current" = "=" ]; then
    [ "$current" = "=" ] && current="" && name=${COMP_WORDS[COMP_CWORD-1]} || name=${COMP_WORDS[COMP_CWORD-2]}
    _qdot_values "$command.$name"
    [ "$name" = system ] && values=$systems
    COMPREPLY=($(compgen -W "$values" -- "$current"))
    return
  fi
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "$commands" -- "$current"))
  elif [ "${current#-}" != "$current" ]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
  elif [ "$command" = systems ] || { [ "$COMP_CWORD" -eq 2 ] && [ -n "$fields" ]; }; then
    COMPREPLY=($(compgen -W "$systems" -- "$current"))
  else
    COMPREPLY=($(compgen -W "$fields $symbols" -- "$current"))
    compopt -o nospace
  fi
}
complete -o default -F _qdot qdot
)";

}  // namespace

std::string manual_page(const CLI::App& app) {
  const api::Catalogue catalogue = api::Catalogue::built_in();
  const std::vector<Command> all = commands();
  std::ostringstream out;
  out << ".TH QDOT 1 \"\" \"qdot " << api::service_version() << "\" \"User Commands\"\n"
      << ".SH NAME\nqdot \\- Lagrangian mechanics, each number with its error\n"
      << ".SH SYNOPSIS\n.B qdot\nCOMMAND [SYSTEM] [NAME=VALUE ...] [OPTIONS]\n"
      << ".SH DESCRIPTION\n"
      << roff(app.get_description()) << ".\n"
      << "The words after a command are a system's name and then fields of the request and symbols of the system, "
         "each as NAME=VALUE. A number is in SI units and radians; it may carry its unit, 'theta=30 deg', or be an "
         "expression of parameters, 'k=2*m*g/l'. Without words the request is JSON, from a file or from standard "
         "input. The answer goes to standard output, a problem to standard error: as text on a terminal, as "
         "JSON otherwise.\n"
      << ".SH COMMANDS\n";
  for (const CLI::App* command : app.get_subcommands({}))
    write_command(*command, find_command(all, command->get_name()), catalogue, out);
  out << ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : exit_codes) out << ".TP\n" << code << "\n" << meaning << "\n";
  return out.str();
}

std::string bash_completion(const CLI::App& app) {
  const api::Catalogue catalogue = api::Catalogue::built_in();
  std::ostringstream out;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  out << "# Completion of qdot for bash.\n_qdot_values() {\n  case $1 in\n";
  for (const Command& command : commands())
    if (command.endpoint != nullptr) write_choices(command, out);
  out << "    *) values=\"\" ;;\n  esac\n}\n_qdot() {\n"
      << "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]}\n"
      << "  local name values fields=\"\" symbols=\"\" options=\"\"\n"
      << "  local commands=\"" << in_a_row(names) << "\"\n  local systems=\"" << in_a_row(catalogue.names())
      << "\"\n  case $command in\n";
  for (const CLI::App* command : app.get_subcommands({}))
    out << "    " << command->get_name() << ") options=\"" << in_a_row(option_names(*command)) << "\" ;;\n";
  out << "  esac\n  case $command in\n";
  for (const Command& command : commands())
    if (command.endpoint != nullptr)
      out << "    " << command.name << ") fields=\"" << in_a_row(plain_fields(command)) << "\" ;;\n";
  out << "  esac\n  case ${COMP_WORDS[2]} in\n";
  for (const api::CatalogueEntry& entry : catalogue.entries())
    out << "    " << entry.scene.name << ") symbols=\"" << in_a_row(symbols_of(entry.scene)) << "\" ;;\n";
  out << "  esac\n" << end_of_completion;
  return out.str();
}

}  // namespace qdot::server
