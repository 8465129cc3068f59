#include "api/about/signposts.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "api/answers/endpoints.hpp"
#include "api/contract/answering.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

using Segments = std::vector<std::string>;

/// What people type for the addresses that compute nothing. Endpoints have their own other_names.
struct OtherNames {
  std::string_view address;
  std::vector<std::string_view> names;
};

const auto& other_names_of_documents() {
  static const auto table = std::to_array<OtherNames>({
      {"/", {"index", "index.html", "home", "api"}},
      {"/docs", {"help", "doc", "documentation", "swagger", "swagger_ui", "redoc", "api_docs", "manual"}},
      {"/openapi.json", {"openapi", "openapi.yaml", "openapi.yml", "swagger.json", "swagger.yaml", "spec"}},
      {"/v1/systems", {"system", "list", "models", "model", "catalogue", "catalog", "scenes"}},
      {"/v1/problems", {"problem", "exercises", "exercise", "sheet", "practice"}},
      {"/v1/scene-schema", {"schema", "scene", "scene_schema.json", "scene.schema.json"}},
      {"/v1/limits", {"limit", "quota"}},
      {"/healthz", {"health", "status", "ping"}},
      {"/readyz", {"ready", "readiness"}},
      {"/livez", {"live", "liveness", "alive"}},
      {"/metrics", {"prometheus", "stats"}},
      {"/errors/invalid-request", {"errors", "error"}},
  });
  return table;
}

/// "/v1//Turning-Points/" as {"v1", "turning_points"}.
Segments segments_of(std::string_view path) {
  Segments result;
  while (!path.empty()) {
    const std::string_view segment = path.substr(0, path.find('/'));
    path.remove_prefix(std::min(segment.size() + 1, path.size()));
    if (segment.empty()) continue;
    std::string plain = lower_case(segment);
    std::ranges::replace(plain, '-', '_');
    result.push_back(std::move(plain));
  }
  return result;
}

/// "v1", "v2"
bool is_version(std::string_view segment) {
  return segment.size() == 2 && segment[0] == 'v' && segment[1] >= '0' && segment[1] <= '9';
}

Segments without_version(Segments segments) {
  if (!segments.empty() && segments.front() == "api") segments.erase(segments.begin());
  if (!segments.empty() && is_version(segments.front())) segments.erase(segments.begin());
  return segments;
}

class Finder {
 public:
  Finder(std::string_view path, const Routes& routes, const Catalogue& catalogue)
      : segments_(without_version(segments_of(path))), routes_(routes), catalogue_(catalogue) {}

  Signpost find() const {
    if (segments_.empty()) return {"/", true};
    if (segments_.size() > longest) return {};
    if (const std::string same = same_address(); !same.empty()) return {same, true};
    if (std::string found = with_system(); !found.empty()) return {std::move(found)};
    if (std::string found = endpoint_called(without_ending(segments_.back())); !found.empty())
      return {std::move(found)};
    std::string found = known_by_other_name(segments_.front());
    if (found.empty()) found = nearest(segments_.front());
    if (found.empty()) return {};
    return {with_the_rest(found)};
  }

 private:
  static constexpr std::size_t longest = 4;

  /// The pattern that the path fits if written otherwise; what a name in braces stands for is kept.
  [[nodiscard]] std::string same_address() const {
    for (const Route& route : routes_.all()) {
      const Segments pattern = without_version(segments_of(route.pattern));
      if (pattern.size() != segments_.size()) continue;
      const auto fits = [](const std::string& expected, const std::string& given) {
        return expected == given || expected.starts_with('{');
      };
      if (!std::ranges::equal(pattern, segments_, fits)) continue;
      std::string address = with_captures(route.pattern);
      if (!address.empty()) return address;
    }
    return {};
  }

  /// The pattern with the path's own segments in the place of names in braces.
  [[nodiscard]] std::string with_captures(const std::string& pattern) const {
    if (pattern.find('{') == std::string::npos) return pattern;
    const std::size_t first = segments_of(pattern).size() - segments_.size();  // /v1 may have been left out
    std::string address = pattern;
    const Segments names = segments_of(pattern);
    for (std::size_t i = first; i < names.size(); ++i) {
      const std::size_t brace = names[i].starts_with('{') ? address.find(names[i]) : std::string::npos;
      if (brace == std::string::npos) continue;
      if (!is_harmless(segments_[i - first])) return {};
      address.replace(brace, names[i].size(), segments_[i - first]);
    }
    return address;
  }

  /// What may stand in a Location without being encoded.
  static bool is_harmless(std::string_view name) {
    return std::ranges::all_of(name, [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
    });
  }

  /// "/v1/cart_pendulum/modes" and "/v1/modes/cart_pendulum" speak of a system and a question.
  [[nodiscard]] std::string with_system() const {
    std::string system, question;
    for (const std::string& segment : segments_) {
      const std::string name = same_letters(segment, catalogue_.names());
      if (!name.empty()) {
        system = name;
      } else if (const std::string address = endpoint_called(segment); !address.empty()) {
        question = address;
      } else if (known_by_other_name(segment) != "/v1/systems" && segment != "systems") {
        return {};
      }
    }
    if (system.empty()) return {};
    return question.empty() ? "/v1/systems/" + system : question + "?system=" + system;
  }

  /// "modes.json", as if the answer were a file, asks for "modes".
  static std::string without_ending(std::string_view segment) {
    for (const std::string_view ending : {".json", ".csv"})
      if (segment.ends_with(ending)) segment.remove_suffix(ending.size());
    return std::string(segment);
  }

  static std::string endpoint_called(const std::string& word) {
    const auto found =
        std::ranges::find_if(endpoints(), [&](const Endpoint& e) { return is_called(e, word); });
    return found == endpoints().end() ? "" : address_of(*found);
  }

  [[nodiscard]] std::string known_by_other_name(const std::string& word) const {
    if (const std::string address = endpoint_called(word); !address.empty()) return address;
    for (const auto& [address, names] : other_names_of_documents()) {
      if (std::ranges::find(names, word) != names.end() && exists(address)) return std::string(address);
    }
    return {};
  }

  /// The command line has no pages.
  [[nodiscard]] bool exists(std::string_view address) const {
    return address.starts_with("/errors/") ||
           std::ranges::any_of(routes_.all(), [&](const Route& route) { return route.pattern == address; });
  }

  [[nodiscard]] std::string nearest(const std::string& word) const {
    std::vector<std::string> names;
    for (const Route& route : routes_.all()) {
      if (route.pattern.find('{') == std::string::npos) names.push_back(route.pattern);
    }
    const auto last_part = [](const std::string& pattern) { return pattern.substr(pattern.rfind('/') + 1); };
    std::vector<std::string> words;
    for (const std::string& name : names) words.push_back(last_part(name));
    const std::string near = closest(word, words);
    const auto found = std::ranges::find(words, near);
    return near.empty() ? "" : names[static_cast<std::size_t>(found - words.begin())];
  }

  /// "/problem/8" is "/v1/problems/8".
  [[nodiscard]] std::string with_the_rest(const std::string& address) const {
    const bool lists = address == "/v1/systems" || address == "/v1/problems";
    if (!lists || segments_.size() < 2 || !is_harmless(segments_[1])) return address;
    return address + "/" + segments_[1];
  }

  Segments segments_;
  const Routes& routes_;
  const Catalogue& catalogue_;
};

/// A query as it may stand in a header.
std::string as_sent(std::string_view query) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string result;
  for (const char c : query) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > ' ' && byte < 0x7F) {
      result += c;
    } else {
      result += {'%', digits[byte >> 4U], digits[byte & 15U]};
    }
  }
  return result;
}

/// No path at all, slashes too many and capitals are reported and not followed: the message shows where a
/// path was put together wrongly.
bool is_tidy(std::string_view path) {
  return !path.empty() && path == lower_case(path) && path.find("//") == std::string_view::npos &&
         !path.ends_with('/');
}

}  // namespace

Signpost signpost_for(std::string_view path, const Routes& routes, const Catalogue& catalogue) {
  const std::size_t ampersand = std::min(path.find('&'), path.size());
  Signpost found = Finder(path.substr(0, ampersand), routes, catalogue).find();
  found.is_same = found.is_same && is_tidy(path);
  if (ampersand == path.size() || found.address.empty()) return found;
  // "/v1/modes&system=cart_pendulum": the query begins with a question mark.
  const char join = found.address.find('?') == std::string::npos ? '?' : '&';
  return {found.address + join + printable(path.substr(ampersand + 1), 100)};
}

Response moved_to(const std::string& address, const Call& call) {
  const std::string_view target = call.request.target;
  const std::size_t mark = target.find('?');
  const std::string location = address + (mark == target.npos ? "" : as_sent(target.substr(mark)));
  const Json body{{"location", printable(location, 200)},
                  {"detail", "This is at " + address + "; curl -L goes there by itself."}};
  Response response = json_response(body, call.layout);
  response.status = 308;
  response.headers["Location"] = location;
  return response;
}

}  // namespace qdot::api
