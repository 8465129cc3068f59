#include "server/framing.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "api/json/text.hpp"

namespace qdot::server {
namespace {

using api::lower_case;
using api::ProblemKind;
using api::trimmed;

// Thrown and caught in this file only, because most rules are checked two calls deep.
struct Refused : std::runtime_error {
  Refused(ProblemKind kind, const std::string& detail) : std::runtime_error(detail), kind(kind) {}
  ProblemKind kind;
};

[[noreturn]] void malformed(const std::string& detail) { throw Refused(ProblemKind::invalid_target, detail); }

bool is_token(std::string_view text) {
  constexpr std::string_view marks = "!#$%&'*+-.^_`|~";
  return !text.empty() && std::ranges::all_of(text, [&](unsigned char c) {
    return (c < 128 && std::isalnum(c)) || marks.find(static_cast<char>(c)) != marks.npos;
  });
}

bool is_control(unsigned char c) { return (c < 0x20 && c != '\t') || c == 0x7f; }

std::string_view take_line(std::string_view& rest) {
  const auto end = rest.find('\n');
  if (end == rest.npos || end == 0 || rest[end - 1] != '\r') malformed("Each line of a head ends in CR LF.");
  const auto line = rest.substr(0, end - 1);
  rest.remove_prefix(end + 1);
  return line;
}

// A proxy's form "http://host/path" means "/path" here.
std::string origin_form(std::string_view target) {
  constexpr std::string_view scheme = "http://";
  if (lower_case(target.substr(0, scheme.size())) != scheme) return std::string(target);
  const auto path = target.find_first_of("/?", scheme.size());
  if (path == target.npos) return "/";
  std::string result(target.substr(path));
  if (target[path] == '?') result.insert(result.begin(), '/');
  return result;
}

void read_request_line(std::string_view line, Head& head) {
  const auto first = line.find(' ');
  const auto last = line.rfind(' ');
  if (first == line.npos || first == last) malformed("A request line is: method, target, HTTP version.");
  const auto method = line.substr(0, first);
  const auto target = line.substr(first + 1, last - first - 1);
  const auto version = line.substr(last + 1);
  if (!is_token(method)) malformed("The method is not a name.");
  head.method = method;
  if (version != "HTTP/1.1" && version != "HTTP/1.0")
    malformed("The version is neither HTTP/1.1 nor HTTP/1.0.");
  head.keep_alive = version == "HTTP/1.1";
  if (target.size() > max_target_bytes) {
    throw Refused(ProblemKind::target_too_long,
                  "The target is longer than 8192 bytes; send the request as a POST.");
  }
  const auto illegal = [](unsigned char c) { return c <= 0x20 || c == 0x7f; };
  if (target.empty() || std::ranges::any_of(target, illegal)) malformed("The target has a blank; write %20.");
  head.target = origin_form(target);
}

void read_field(std::string_view line, Head& head) {
  const auto colon = line.find(':');
  if (colon == line.npos || !is_token(line.substr(0, colon)))
    malformed("A header field is: name, colon, value.");
  const auto name = lower_case(line.substr(0, colon));
  const auto value = trimmed(line.substr(colon + 1));
  if (std::ranges::any_of(value, is_control)) malformed("A header field holds a control character.");
  const auto [place, fresh] = head.fields.emplace(name, value);
  if (fresh) return;
  if (name == "content-length" || name == "host" || name == "content-type") {
    malformed("The header field " + name + " is sent twice.");
  }
  place->second.append(", ").append(value);
}

std::string_view field(const Head& head, const std::string& name) {
  const auto found = head.fields.find(name);
  return found == head.fields.end() ? std::string_view{} : std::string_view(found->second);
}

std::size_t content_length(std::string_view text) {
  std::size_t length = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
  const bool too_large = error == std::errc::result_out_of_range;
  if (text.empty() || (error != std::errc{} && !too_large) || end != text.data() + text.size()) {
    malformed("Content-Length is not a number of bytes.");
  }
  if (too_large || length > max_body_bytes) {
    throw Refused(ProblemKind::payload_too_large, "The body is longer than 1048576 bytes.");
  }
  return length;
}

bool lists(std::string_view values, std::string_view wanted) {
  while (!values.empty()) {
    const auto comma = std::min(values.find(','), values.size());
    if (lower_case(trimmed(values.substr(0, comma))) == wanted) return true;
    values.remove_prefix(std::min(comma + 1, values.size()));
  }
  return false;
}

// The rules that decide where this request ends and whether another follows.
void settle(Head& head) {
  if (head.keep_alive && !head.fields.contains("host")) malformed("HTTP/1.1 wants a Host header field.");
  if (head.fields.contains("transfer-encoding")) {
    throw Refused(ProblemKind::length_required,
                  "Send the body with Content-Length, not with Transfer-Encoding.");
  }
  if (head.fields.contains("content-length"))
    head.content_length = content_length(field(head, "content-length"));
  if (head.fields.contains("content-encoding") && lower_case(field(head, "content-encoding")) != "identity") {
    throw Refused(ProblemKind::unsupported_media_type, "Send the body without Content-Encoding.");
  }
  if (head.fields.contains("expect")) {
    head.expects_continue = lower_case(field(head, "expect")) == "100-continue";
    if (!head.expects_continue)
      throw Refused(ProblemKind::expectation_failed, "Expect can only be 100-continue.");
  }
  if (head.method == "POST" && !head.fields.contains("content-length"))
    throw Refused(
        ProblemKind::length_required,
        "There is no Content-Length, and so no body: send JSON, curl -d '{\"system\": ...}', or ask with GET and a query.");
  const auto connection = field(head, "connection");
  head.keep_alive = head.keep_alive ? !lists(connection, "close") : lists(connection, "keep-alive");
}

}  // namespace

std::size_t head_end(std::string_view bytes) {
  for (auto line = bytes.find('\n'); line != bytes.npos; line = bytes.find('\n', line + 1)) {
    const auto rest = bytes.substr(line + 1);
    // A bare LF ends the head, too: read_head then refuses it.
    if (rest.starts_with("\r\n")) return line + 3;
    if (rest.starts_with("\n")) return line + 2;
  }
  return std::string_view::npos;
}

std::variant<Head, Refusal> read_head(std::string_view bytes) {
  Head head;
  try {
    read_request_line(take_line(bytes), head);
    std::size_t count = 0;
    for (auto line = take_line(bytes); !line.empty(); line = take_line(bytes)) {
      if (++count > max_fields)
        throw Refused(ProblemKind::headers_too_large, "There are more than 64 header fields.");
      read_field(line, head);
    }
    settle(head);
    return head;
  } catch (const Refused& refused) {
    return Refusal{refused.kind, refused.what(), head.method, head.target};
  }
}

Refusal oversized_head(std::string_view bytes) {
  if (bytes.substr(0, bytes.find('\n')).size() > max_target_bytes) {
    return {ProblemKind::target_too_long, "The request line is longer than 8192 bytes.", {}, {}};
  }
  return {ProblemKind::headers_too_large, "The head is longer than 16384 bytes.", {}, {}};
}

}  // namespace qdot::server
