#include "api/about/documents.hpp"

#include "api/contract/version.hpp"
#include "api/json/limits.hpp"
#include "core/integrate/events.hpp"
#include "core/integrate/run.hpp"

namespace qdot::api {
namespace {

/// Text as HTML.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else {
      result += c;
    }
  }
  return result;
}

/// What stands between backticks as code.
std::string with_code(std::string_view text) {
  std::string result;
  bool is_code = false;
  for (const char c : text) {
    if (c == '`') {
      result += is_code ? "</code>" : "<code>";
      is_code = !is_code;
    } else {
      result += c;
    }
  }
  return result;
}

/// A whole page, with the header that all pages have.
std::string page_around(std::string_view title, const std::string& body) {
  const std::string shown = escaped(title);
  return R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>)" +
         shown + R"(</title>
<link rel="icon" href="/page/icon.svg" type="image/svg+xml">
<link rel="stylesheet" href="/page/style.css">
</head>
<body>
<header class="head">
<a class="name" href="/">qdot</a>
<nav aria-label="Pages">
<a href="/#/">Systems</a>
<a href="/#/problems">Problems</a>
<a href="/#/scene">Your scene</a>
<a href="/docs">Docs</a>
</nav>
</header>
<main>
<h1>)" + shown +
         "</h1>\n" + body + "</main>\n</body>\n</html>\n";
}

}  // namespace

Json limits_json() {
  return {{"body_bytes", limits::body_bytes},
          {"large_body_bytes", limits::large_body_bytes},
          {"json_depth", limits::json_depth},
          {"json_nodes", limits::json_nodes},
          {"name_bytes", limits::name_bytes},
          {"expression_bytes", limits::expression_bytes},
          {"check_items", limits::check_items},
          {"check_algebra", limits::check_algebra},
          {"batch_lines", limits::batch_lines},
          {"batch_answer_bytes", limits::batch_answer_bytes},
          {"sweep_rows", limits::sweep_rows},
          {"sweep_variables", limits::sweep_variables},
          {"sweep_columns", limits::sweep_columns},
          {"sweep_answer_bytes", limits::sweep_answer_bytes},
          {"algebra", limits::algebra},
          {"rows", limits::rows},
          {"numbers", limits::numbers},
          {"events", limits::events},
          {"event_occurrences", most_occurrences},
          {"strides", limits::impacts},
          {"integration_steps", Limits{}.max_steps},
          {"evaluations", limits::evaluations},
          {"time", {-limits::largest_time, limits::largest_time}},
          {"rtol", {limits::least_rtol, limits::largest_rtol}},
          {"atol", {{"above", 0}, {"at_most", limits::largest_atol}}},
          {"max_error", {limits::least_error, 1}}};
}

Json index_json(const Routes& routes) {
  Json addresses = Json::object();
  for (const Route& route : routes.all()) addresses[route.pattern].push_back(route.method);
  return {{"service", "qdot"},
          {"service_version", service_version()},
          {"endpoints", std::move(addresses)},
          {"examples",
           {"curl 'localhost:8080/v1/simulate?system=cart_pendulum&theta=30deg&t_end=10&pretty'",
            R"(curl -d '{"system": "spring_pendulum", "initial": {"l": "50cm"}, "t_end": 10}' )"
            "localhost:8080/v1/simulate"}}};
}

Json problem_type_json(const ProblemType& type) {
  return {{"type", "/errors/" + std::string(type.name)},
          {"status", type.status},
          {"title", type.title},
          {"explanation", type.explanation}};
}

Response problem_page(const ProblemType& type, std::string_view detail) {
  std::string body = "<p>Status " + std::to_string(type.status) + ", <code>/errors/" +
                     std::string(type.name) + "</code></p>\n";
  if (!detail.empty()) body += "<p>" + escaped(detail) + "</p>\n";
  body += "<p>" + with_code(escaped(type.explanation)) + "</p>\n";
  return {.content_type = "text/html; charset=utf-8", .body = page_around(type.title, body)};
}

Response answer_page(const Page& page) {
  return {.content_type = std::string(page.content_type) + "; charset=utf-8", .body = std::string(page.text)};
}

}  // namespace qdot::api
