#include "server/commands.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "api/about/examples.hpp"
#include "api/about/field_help.hpp"
#include "api/answers/check/answer_sheet.hpp"
#include "api/answers/endpoints.hpp"
#include "api/json/documents.hpp"
#include "api/json/text.hpp"
#include "api/scenes/catalogue.hpp"
#include "api/service.hpp"
#include "server/output.hpp"
#include "server/people.hpp"
#include "server/processors.hpp"
#include "server/progress.hpp"
#include "server/spread.hpp"
#include "server/usage_error.hpp"
#include "server/words.hpp"

namespace qdot::server {
namespace {

constexpr int digits_for_people = 8;  ///< what they read; their errors have the rounding in them

/// The request of a check, from its key and its answers.
std::string graded_body(const Arguments& arguments) {
  if (arguments.key.empty() || arguments.answers.empty() || !arguments.request_file.empty())
    throw UsageError("give --key and --answers together, and no other request");
  const auto request = api::graded_request(request_body(arguments.key),
                                           request_body(arguments.answers, api::limits::answers_bytes));
  if (const auto* error = std::get_if<api::SheetError>(&request)) throw UsageError(error->text);
  return api::dump_json(std::get<api::Json>(request));
}

std::string path_of(const Command& command) {
  const std::string name(command.name);
  return command.words == Words::none ? "/" + name + ".json" : "/v1/" + name;
}

/// How an answer is printed.
enum class Style { json, people };

Style style_of(const Arguments& arguments) {
  if (arguments.json || arguments.pretty) return Style::json;
  if (!arguments.format.empty()) return arguments.format == "table" ? Style::people : Style::json;
  const bool chooses_a_form = std::ranges::any_of(
      arguments.words, [](const std::string& word) { return word.starts_with("format="); });
  return ::isatty(STDOUT_FILENO) && !chooses_a_form ? Style::people : Style::json;
}

Colours colours_on(int descriptor) {
  const char* terminal = std::getenv("TERM");
  const bool is_dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
  return ::isatty(descriptor) && !is_dumb && std::getenv("NO_COLOR") == nullptr ? Colours::ansi
                                                                                : Colours::none;
}

bool has_field(const Command& command, const std::string& name) {
  return command.endpoint != nullptr && command.endpoint->question.fields->find(name) != nullptr;
}

bool gives(const Arguments& arguments, std::string_view name) {
  return std::ranges::any_of(arguments.words, [&](const std::string& word) {
    return word.starts_with(name) && word.substr(name.size()).starts_with('=');
  });
}

/// "-" alone is stdin, as without a word.
bool has_no_words(const Arguments& arguments) {
  return arguments.words.empty() || (arguments.words.size() == 1 && arguments.words.front() == "-");
}

void add_body(const Arguments& arguments, api::Request& request) {
  request.method = "POST";
  request.headers["content-type"] = "application/json";
  const bool has_sheets = !arguments.key.empty() || !arguments.answers.empty();
  if (has_sheets) {
    request.body = graded_body(arguments);
  } else {
    request.body = has_no_words(arguments) ? request_body(arguments.request_file) : arguments.words.front();
  }
}

api::Request request_of(const Command& command, const Arguments& arguments) {
  api::Request request{
      .method = "GET", .target = path_of(command), .headers = {}, .body = {}, .interrupted = {}};
  std::string query;
  if (command.words == Words::name) {
    if (arguments.words.size() > 1) throw UsageError("give one name");
    const bool is_query = !arguments.words.empty() && arguments.words.front().find('=') != std::string::npos;
    if (is_query) {
      query = query_of(arguments.words);
    } else if (!arguments.words.empty()) {
      request.target += "/" + percent_encoded(arguments.words.front());
    }
  } else if (command.words == Words::request) {
    if (!arguments.words.empty() && !arguments.request_file.empty())
      throw UsageError("give key=value or --request, not both");
    if (has_no_words(arguments) || is_body(arguments.words)) {
      add_body(arguments, request);
    } else if (command.endpoint != nullptr && command.endpoint->roads == api::Roads::body) {
      const auto& words = arguments.words;
      const bool are_files = words.size() == 2 && words[0].ends_with(".json");
      throw UsageError(are_files && command.name == std::string_view("check")
                           ? "files are given as --key " + api::printable(words[0]) + " --answers " +
                                 api::printable(words[1])
                           : "the request does not fit key=value; give JSON with --request FILE or on stdin");
    } else {
      query = query_of(arguments.words);
      if (style_of(arguments) == Style::people && has_field(command, "digits") && !gives(arguments, "digits"))
        query += "digits=" + std::to_string(digits_for_people) + "&";
    }
  }
  if (!arguments.format.empty() && command.endpoint != nullptr && !has_formats(command) &&
      arguments.format != "table" && arguments.format != "json")
    throw UsageError("--format is table or json here; csv and ndjson are for the rows of simulate and sweep");
  const bool is_ours = arguments.format == "table" || (arguments.format == "json" && !has_formats(command));
  if (!arguments.format.empty() && !is_ours) query += "format=" + percent_encoded(arguments.format) + "&";
  if (arguments.pretty) query += "pretty&";
  if (!query.empty()) request.target += "?" + query.substr(0, query.size() - 1);
  return request;
}

ExitCode meaning_of(const api::Response& response) {
  if (response.status < 400) return ExitCode::ok;
  const auto body = api::parse_json_or_discard(response.body);
  const auto type = body.is_object() ? body.value("type", "") : "";
  if (type == "/errors/integration-failed" || response.status == 503) return ExitCode::failed;
  return response.status < 500 ? ExitCode::invalid_request : ExitCode::internal;
}

/// Whether every item is right, in any of the formats.
bool is_all_right(const std::string& body) {
  const auto grades = api::parse_json_or_discard(body);
  const auto all = [](const auto& tests, auto is_right) {
    return std::all_of(tests.begin(), tests.end(), is_right);
  };
  if (grades.contains("items"))
    return all(grades["items"], [](const auto& item) { return item["correct"] == true; });
  if (grades.contains("fraction")) return grades["fraction"] == 1;
  return all(grades["tests"], [](const auto& test) {
    return test.contains("max_score") ? test["score"] == test["max_score"]
                                      : test["points"] == test["max_points"];
  });
}

/// In quotes where a shell would read it otherwise.
std::string for_a_shell(const std::string& word) {
  const bool is_plain = std::ranges::all_of(word, [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_-.,:/=+").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (is_plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string in_words(const api::Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return api::dump_json(value);
  std::string text;
  for (const api::Json& part : value) text += (text.empty() ? "" : ",") + in_words(part);
  return text;
}

/// The body as it came, or for people as text.
std::string printed(const api::Response& response, ExitCode code, const Arguments& arguments) {
  const bool is_answer = code == ExitCode::ok;
  const bool wants_text =
      is_answer ? style_of(arguments) == Style::people : !arguments.json && ::isatty(STDERR_FILENO) != 0;
  const auto body = wants_text ? api::parse_json_or_discard(response.body) : api::Json();
  if (!body.is_object()) return response.body;
  return is_answer ? answer_as_text(body, colours_on(STDOUT_FILENO))
                   : problem_as_text(body, colours_on(STDERR_FILENO));
}

}  // namespace

std::vector<Command> commands() {
  std::vector<Command> all;
  for (const api::Endpoint& endpoint : api::endpoints())
    if (endpoint.body_type == "application/json")
      all.push_back({endpoint.name, endpoint.help, Words::request, &endpoint});
  all.push_back({"systems", "The systems there are, or one of them", Words::name});
  all.push_back({"problems", "The practice sheet, or one of its problems with answers", Words::name});
  all.push_back({"openapi", "The description of the service in OpenAPI 3.1", Words::none});
  return all;
}

namespace {

/// Whether a request can be said in words: objects in it are symbols alone.
bool fits_words(const api::Endpoint& endpoint, const api::Json& request) {
  if (endpoint.roads == api::Roads::body) return false;
  for (const auto& [name, value] : request.items()) {
    const api::FieldInfo* field = endpoint.question.fields->find(name);
    if (value.is_object() && (field == nullptr || api::symbols_kind(*field) == nullptr)) return false;
  }
  return true;
}

}  // namespace

std::string example_of(const Command& command, const api::Catalogue& catalogue) {
  const api::Json more = api::description_of(*command.endpoint).value("examples", api::Json::array());
  const api::Json examples = api::request_examples(path_of(command), more, catalogue);
  if (examples.empty()) return "";
  std::string line = "qdot " + std::string(command.name);
  if (!fits_words(*command.endpoint, examples.begin()->at("value")))
    return line + " " + for_a_shell(api::dump_json(examples.begin()->at("value")));
  for (const auto& [name, value] : examples.begin()->at("value").items()) {
    if (name == "system") {
      line += " " + in_words(value);
    } else if (value.is_object()) {
      const std::string before = name == "at" || name == "equilibrium" ? name + "." : "";
      for (const auto& [symbol, given] : value.items())
        line += " " + for_a_shell(before + symbol + "=" + in_words(given));
    } else {
      line += " " + for_a_shell(name + "=" + in_words(value));
    }
  }
  return line;
}

std::string help_on_fields(const Command& command, const Arguments& arguments) {
  if (command.endpoint == nullptr) return "";
  const api::Catalogue catalogue = api::Catalogue::built_in();
  std::string text = api::fields_as_text(*command.endpoint->question.fields);
  const api::CatalogueEntry* named =
      arguments.words.empty() ? nullptr : catalogue.find(arguments.words.front());
  if (named != nullptr) {
    text += "\n\n" + api::symbols_as_text(named->scene);
  } else {
    text += "\n\nSystems: " + api::enumerated(catalogue.names()) + ".\nThe symbols of one: qdot " +
            std::string(command.name) + " cart_pendulum --help";
  }
  return text + "\n\nExample: " + example_of(command, catalogue);
}

bool grades(const Command& command) { return command.name == "check"; }

bool has_formats(const Command& command) {
  return command.endpoint != nullptr && command.endpoint->question.fields->find("format") != nullptr;
}

namespace {

ExitCode stopped_by(int signal) {
  return static_cast<ExitCode>(static_cast<int>(ExitCode::stopped) + signal);
}

}  // namespace

ExitCode run(const Command& command, const Arguments& arguments) {
  try {
    auto request = request_of(command, arguments);
    const api::Service service({.scenes_directory = arguments.scenes});
    api::Response response;
    int signal = 0;
    double seconds = 0;
    request.work = arguments.bounded ? api::Work::bounded : api::Work::unbounded;
    {
      Progress progress;
      request.interrupted = [&progress] { return progress.is_stopped(); };
      request.spread = progress.counting(spread_over(usable_processors()));
      response = service.handle(request);
      signal = Progress::signal();
      seconds = progress.passed().count();
    }
    auto code = meaning_of(response);
    if (signal != 0) {
      std::cerr << "Stopped after " << std::llround(seconds) << " s"
                << (code == ExitCode::ok ? "." : "; there is no answer.") << std::endl;
      if (code != ExitCode::ok) return stopped_by(signal);
    }
    auto& stream = code == ExitCode::ok ? std::cout : std::cerr;
    const std::string text = printed(response, code, arguments);
    if (code == ExitCode::ok && arguments.strict && !is_all_right(response.body))
      code = ExitCode::not_all_right;
    write_out(stream, text);
    return signal != 0 ? stopped_by(signal) : code;
  } catch (const UsageError& error) {
    std::cerr << "qdot " << command.name << ": " << error.what() << "\n";
    return ExitCode::usage;
  }
}

}  // namespace qdot::server
