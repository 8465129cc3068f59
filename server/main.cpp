// The command line of qdot: what may be typed. What a command does is in serve, commands and probe.

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "api/contract/version.hpp"
#include "api/scenes/catalogue.hpp"
#include "api/service.hpp"
#include "server/batch.hpp"
#include "server/commands.hpp"
#include "server/listener.hpp"
#include "server/manual.hpp"
#include "server/output.hpp"
#include "server/probe.hpp"
#include "server/serve.hpp"
#include "server/standard_streams.hpp"
#include "server/usage.hpp"
#include "server/variant.hpp"

namespace {

using namespace qdot::server;

/// What the typed command does. The callback of the command sets it, and it runs once all options are known
/// to be right.
using Action = std::function<ExitCode()>;

constexpr int max_port = 65535;
constexpr int max_threads = 1024;

void add_scenes(CLI::App& command, std::string& scenes) {
  command.add_option("--scenes", scenes, "Directory of more scenes, one JSON file each")
      ->envname("QDOT_SCENES");
}

template <class Port>
void add_address(CLI::App& command, std::string& host, Port& port, int lowest_port,
                 std::string& unix_socket) {
  command.add_option("--host", host, "Address")->envname("QDOT_HOST")->capture_default_str();
  command.add_option("--port", port, "Port (default: 8080)")
      ->envname("QDOT_PORT")
      ->check(CLI::Range(lowest_port, max_port));
  command.add_option("--unix-socket", unix_socket, "Unix socket instead of a port; with --port, beside it")
      ->envname("QDOT_UNIX_SOCKET");
}

/// Only the environment can give the token, because other users see the words of a command line.
std::string token_of_environment() {
  const char* token = std::getenv("QDOT_TOKEN");
  return token == nullptr ? "" : token;
}

void add_bounded(CLI::App& command, bool& bounded) {
  command.add_flag("--bounded", bounded, "No more work and rows than a service would do (/v1/limits)");
}

void add_serve(CLI::App& app, ServeOptions& options, Action& action) {
  auto& command = *app.add_subcommand("serve", "Serve HTTP until SIGTERM; port 0 picks a free one");
  add_address(command, options.host, options.port, 0, options.unix_socket);
  command.add_option("--threads", options.threads, "Requests that compute at a time (default: cores)")
      ->envname("QDOT_THREADS")
      ->check(CLI::Range(1, max_threads));
  command.add_option("--deadline", options.deadline, "Seconds after which an answer is given up")
      ->envname("QDOT_DEADLINE")
      ->check(CLI::Range(0.01, 3600.0))
      ->capture_default_str();
  command.add_option("--allowed-hosts", options.allowed_hosts, "More names that Host may have, with commas")
      ->envname("QDOT_ALLOWED_HOSTS")
      ->delimiter(',');
  add_scenes(command, options.scenes);
  command.footer("QDOT_TOKEN in the environment: the bearer token that clients have to bring.");
  command.callback([&] {
    action = [&] {
      options.token = token_of_environment();
      serve(options);
      return ExitCode::ok;
    };
  });
}

void add_commands(CLI::App& app, Arguments& arguments, Action& action) {
  for (const Command& entry : commands()) {
    auto& command = *app.add_subcommand(std::string(entry.name), std::string(entry.help));
    if (entry.words == Words::name) command.add_option("name", arguments.words, "One of them");
    if (entry.words == Words::request) {
      command.add_option("system key=value", arguments.words,
                         "The request: a system's name, then fields and symbols; without any, JSON from "
                         "--request or stdin");
      command.add_option("--request", arguments.request_file, "File with the JSON request; - is stdin");
      command.footer([entry, &arguments] { return help_on_fields(entry, arguments); });
    }
    command.add_option("--format", arguments.format,
                       has_formats(entry) ? "The field format, or table; on a terminal table, else json"
                                          : "table or json; on a terminal table, else json");
    if (grades(entry)) {
      command.add_option("--key", arguments.key, "File with the request without what was submitted");
      command.add_option("--answers", arguments.answers,
                         "File with the answers: {\"id\": ...}, or CSV id,submitted");
      command.add_flag("--strict", arguments.strict, "Exit 1 unless every answer is right");
    }
    command.add_flag("--json", arguments.json, "The answer as JSON, on a terminal too");
    command.add_flag("--pretty", arguments.pretty, "The answer as JSON with indents");
    add_scenes(command, arguments.scenes);
    if (entry.endpoint != nullptr) add_bounded(command, arguments.bounded);
    command.callback([&, entry] { action = [&, entry] { return run(entry, arguments); }; });
  }
}

void add_batch(CLI::App& app, BatchOptions& options, Action& action) {
  auto& command = *app.add_subcommand("batch", "Answer many requests, a line of JSON each");
  command.add_option("file", options.file, "File with the lines; without it or as -, stdin");
  command.add_option("--jobs", options.jobs, "Lines that are answered at a time (default: cores)")
      ->check(CLI::Range(1, max_threads));
  command.add_option("--output", options.output, "File for the answers; without it or as -, stdout");
  command.add_flag(
      "--resume", options.resume,
      "Go on behind the answers that the output has already; the ids of the lines are compared, and the last answer");
  add_scenes(command, options.scenes);
  add_bounded(command, options.bounded);
  command.footer([] { return help_on_lines(); });
  command.callback([&] { action = [&] { return run_batch(options); }; });
}

void add_variant(CLI::App& app, VariantOptions& options, Action& action) {
  auto& command =
      *app.add_subcommand("variant", "One student's numbers and key, drawn from the ranges of a key");
  command.add_option("key", options.key, "File with the key; - is stdin")->required();
  command.add_option("--seed", options.seed, "Chooses the variant: 0, 1, 2, ...")->required();
  command.add_flag("--pretty", options.pretty, "With indents");
  add_scenes(command, options.scenes);
  command.footer(
      "Example: qdot variant key.json --seed 7 > variant.json\n"
      "         qdot check --key variant.json --answers answers.csv");
  command.callback([&] { action = [&] { return print_variant(options); }; });
}

ExitCode code_of(bool reached, const ProbeOptions& options) {
  if (reached) return ExitCode::ok;
  const std::string where = options.unix_socket.empty()
                                ? options.host + " port " + std::to_string(options.port)
                                : options.unix_socket;
  std::cerr << "No qdot answers at " << where << "; start one with: qdot serve\n";
  return ExitCode::unreachable;
}

void add_probes(CLI::App& app, ProbeOptions& options, double& patience, Action& action) {
  auto& health = *app.add_subcommand("health", "Exit 0 if a server answers, 6 if not");
  add_address(health, options.host, options.port, 1, options.unix_socket);
  health.callback([&] { action = [&] { return code_of(healthy(options), options); }; });

  auto& wait = *app.add_subcommand("wait", "Wait until a server answers; exit 6 if none does in time");
  add_address(wait, options.host, options.port, 1, options.unix_socket);
  wait.add_option("--timeout", patience, "Seconds")->check(CLI::Range(0.0, 86400.0))->capture_default_str();
  wait.callback([&] {
    action = [&] {
      const auto limit = std::chrono::duration<double>(patience);
      return code_of(wait_until_healthy(options, std::chrono::ceil<std::chrono::milliseconds>(limit)),
                     options);
    };
  });
}

/// What `cmake --install` puts beside the program.
void add_documents(CLI::App& app, Action& action) {
  const auto add = [&](const char* name, const char* help, std::string (*text)(const CLI::App&)) {
    app.add_subcommand(name, help)->callback([&app, &action, text] {
      action = [&app, text] {
        write_out(std::cout, text(app));
        return ExitCode::ok;
      };
    });
  };
  add("manual", "This program's manual page, in roff", manual_page);
  add("completion", "Completion for bash: source <(qdot completion)", bash_completion);
}

/// The help that was asked for, or what CLI11 finds wrong.
ExitCode print_usage(const CLI::App& app, const CLI::ParseError& error) {
  if (app.exit(error) != 0) return ExitCode::usage;
  write_out(std::cout, "");
  return ExitCode::ok;
}

ExitCode run_words(CLI::App& app, std::vector<std::string> words, const Action& action) {
  words = in_known_words(app, std::move(words));
  check_words(app, words);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // the order in which CLI11 wants them
  } catch (const CLI::ParseError& error) {
    if (const std::string variable = variable_at_fault(app, words, error.what()); !variable.empty())
      throw UsageError(variable + " in the environment is wrong; " + error.what());
    return print_usage(app, error);
  }
  return action();
}

int report(const std::exception& error, ExitCode code) {
  std::cerr << "qdot: " << error.what() << "\n";
  return static_cast<int>(code);
}

}  // namespace

int main(int argc, char** argv) {
  keep_closed_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing
  CLI::App app("Lagrangian mechanics: trajectories and equations with errors that can be believed", "qdot");
  app.set_version_flag("--version", "qdot " + std::string(qdot::api::service_version()));
  app.require_subcommand(1);
  app.immediate_callback();  // else QDOT_PORT would be read, and be wrong, for commands that have no port
  ServeOptions serve_options;
  Arguments arguments;
  BatchOptions batch_options;
  VariantOptions variant_options;
  ProbeOptions probe_options;
  double patience = 30;
  Action action;
  add_serve(app, serve_options, action);
  add_commands(app, arguments, action);
  add_batch(app, batch_options, action);
  add_variant(app, variant_options, action);
  add_probes(app, probe_options, patience, action);
  add_documents(app, action);
  try {
    return static_cast<int>(run_words(app, {argv + 1, argv + argc}, action));
  } catch (const UsageError& error) {
    return report(error, ExitCode::usage);
  } catch (const CannotListen& error) {
    return report(error, ExitCode::usage);
  } catch (const qdot::api::BadScenes& error) {
    return report(error, ExitCode::usage);
  } catch (const CannotWrite& error) {
    return report(error, ExitCode::unwritten);
  } catch (const std::exception& error) {
    return report(error, ExitCode::internal);
  }
}
