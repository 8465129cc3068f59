#include "server/commands.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "api/about/field_help.hpp"
#include "api/answers/check/answer_sheet.hpp"
#include "api/answers/endpoints.hpp"
#include "api/service.hpp"

namespace qdot::server {
namespace {

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string percent_encoded(std::string_view text) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string result;
  for (const unsigned char c : text) {
    if ((c < 128 && std::isalnum(c)) ||
        std::string_view("-._~").find(static_cast<char>(c)) != std::string::npos) {
      result += static_cast<char>(c);
    } else {
      result += {'%', digits[c >> 4], digits[c & 15]};
    }
  }
  return result;
}

std::string all_of(std::istream& stream) {
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string text_of_file(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw UsageError("cannot read " + file);
  return all_of(stream);
}

/// The request of a check, from its key and its answers.
std::string graded_body(const Arguments& arguments) {
  if (arguments.key.empty() || arguments.answers.empty() || !arguments.request_file.empty())
    throw UsageError("give --key and --answers together, and no other request");
  const auto request = api::graded_request(text_of_file(arguments.key), text_of_file(arguments.answers));
  if (const auto* error = std::get_if<api::SheetError>(&request)) throw UsageError(error->text);
  return std::get<api::Json>(request).dump();
}

std::string request_body(const std::string& file) {
  if (!file.empty() && file != "-") return text_of_file(file);
  if (file.empty() && ::isatty(STDIN_FILENO)) {
    throw UsageError("give the request as key=value, with --request FILE or on stdin");
  }
  return all_of(std::cin);
}

// "t_end=10" -> "t_end=10&" with both sides encoded.
std::string query_of(const std::vector<std::string>& words) {
  std::string query;
  for (const auto& word : words) {
    const auto equals = word.find('=');
    if (equals == word.npos || equals == 0) throw UsageError("'" + word + "' is not of the form key=value");
    query += percent_encoded(word.substr(0, equals)) + "=" + percent_encoded(word.substr(equals + 1)) + "&";
  }
  return query;
}

std::string path_of(const Command& command) {
  const std::string name(command.name);
  return command.words == Words::none ? "/" + name + ".json" : "/v1/" + name;
}

api::Request request_of(const Command& command, const Arguments& arguments) {
  api::Request request{
      .method = "GET", .target = path_of(command), .headers = {}, .body = {}, .interrupted = {}};
  std::string query;
  if (command.words == Words::name) {
    if (arguments.words.size() > 1) throw UsageError("give one name");
    if (!arguments.words.empty()) request.target += "/" + percent_encoded(arguments.words.front());
  } else if (!arguments.words.empty()) {
    if (!arguments.request_file.empty()) throw UsageError("give key=value or --request, not both");
    if (command.endpoint != nullptr && command.endpoint->roads == api::Roads::body)
      throw UsageError("the request does not fit key=value; give JSON with --request FILE or on stdin");
    query = query_of(arguments.words);
  } else if (command.words == Words::request) {
    request.method = "POST";
    request.headers["content-type"] = "application/json";
    const bool has_sheets = !arguments.key.empty() || !arguments.answers.empty();
    request.body = has_sheets ? graded_body(arguments) : request_body(arguments.request_file);
  }
  if (!arguments.format.empty()) query += "format=" + percent_encoded(arguments.format) + "&";
  if (arguments.pretty) query += "pretty&";
  if (!query.empty()) request.target += "?" + query.substr(0, query.size() - 1);
  return request;
}

ExitCode meaning_of(const api::Response& response) {
  if (response.status < 400) return ExitCode::ok;
  const auto body = nlohmann::json::parse(response.body, nullptr, false);
  const auto type = body.is_object() ? body.value("type", "") : "";
  if (type == "/errors/integration-failed" || response.status == 503) return ExitCode::failed;
  return response.status < 500 ? ExitCode::invalid_request : ExitCode::internal;
}

/// Whether every item is right, in any of the formats.
bool is_all_right(const std::string& body) {
  const auto grades = nlohmann::json::parse(body, nullptr, false);
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

}  // namespace

std::vector<Command> commands() {
  std::vector<Command> all;
  for (const api::Endpoint& endpoint : api::endpoints())
    all.push_back({endpoint.name, endpoint.help, Words::request, &endpoint});
  all.push_back({"systems", "The systems there are, or one of them", Words::name});
  all.push_back({"problems", "The practice sheet, or one of its problems with answers", Words::name});
  all.push_back({"openapi", "The description of the service in OpenAPI 3.1", Words::none});
  return all;
}

std::string help_on_fields(const Command& command) {
  return command.endpoint == nullptr ? "" : api::fields_as_text(*command.endpoint->question.fields);
}

bool grades(const Command& command) { return command.name == "check"; }

bool has_formats(const Command& command) {
  return command.endpoint != nullptr && command.endpoint->question.fields->find("format") != nullptr;
}

ExitCode run(const Command& command, const Arguments& arguments) {
  try {
    const auto request = request_of(command, arguments);
    const api::Service service({.scenes_directory = arguments.scenes});
    const auto response = service.handle(request);
    auto code = meaning_of(response);
    auto& stream = code == ExitCode::ok ? std::cout : std::cerr;
    if (code == ExitCode::ok && arguments.strict && !is_all_right(response.body))
      code = ExitCode::not_all_right;
    stream << response.body << std::flush;
    if (!stream) throw std::runtime_error("cannot write the answer");
    return code;
  } catch (const UsageError& error) {
    std::cerr << "qdot " << command.name << ": " << error.what() << "\n";
    return ExitCode::usage;
  }
}

}  // namespace qdot::server
