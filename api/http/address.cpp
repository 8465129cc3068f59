#include "api/http/address.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "api/json/text.hpp"

namespace qdot::api {
namespace {

enum class Plus { plus, space };

std::optional<std::string> percent_decoded(std::string_view text, Plus plus) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '+' && plus == Plus::space) {
      result += ' ';
    } else if (text[i] != '%') {
      result += text[i];
    } else {
      unsigned char byte{};
      const std::string_view digits = text.substr(i + 1, 2);
      const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
      if (error != std::errc{} || end != digits.data() + 2) return std::nullopt;
      result += static_cast<char>(byte);
      i += 2;
    }
  }
  return result.find('\0') == std::string::npos && is_utf8(result) ? std::optional(result) : std::nullopt;
}

/// Calls `use` with each part of a list, trimmed; empty parts are left out.
template <class Use>
void for_each_part(std::string_view list, char separator, Use use) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(separator), list.size());
    if (const std::string_view part = trimmed(list.substr(0, end)); !part.empty()) use(part);
    list.remove_prefix(std::min(end + 1, list.size()));
  }
}

/// "text/csv; q=0.5; header=present"
struct MediaRange {
  std::string type;
  double quality{1};
};

MediaRange parse_range(std::string_view text) {
  MediaRange range;
  for_each_part(text, ';', [&](std::string_view part) {
    if (range.type.empty()) {
      range.type = lower_case(part);
    } else if (part.starts_with("q=") || part.starts_with("Q=")) {
      const std::string_view digits = part.substr(2);
      double quality = 0;
      std::from_chars(digits.data(), digits.data() + digits.size(), quality);
      range.quality = quality >= 0 && quality <= 1 ? quality : 0;
    }
  });
  return range;
}

/// How specific a range is about a type: 0 when it says nothing of it.
int specificity(std::string_view range, std::string_view type) {
  if (range == type) return 3;
  if (range == "*/*") return 1;
  return range.ends_with("/*") && type.starts_with(range.substr(0, range.size() - 1)) ? 2 : 0;
}

double quality_of(std::string_view type, const std::vector<MediaRange>& ranges) {
  double quality = 0;
  int best = 0;
  for (const MediaRange& range : ranges) {
    if (const int specific = specificity(range.type, type); specific > best) {
      best = specific;
      quality = range.quality;
    }
  }
  return quality;
}

bool has_foreign_charset(std::string_view content_type) {
  bool foreign = false;
  for_each_part(content_type, ';', [&](std::string_view part) {
    const std::string parameter = lower_case(part);
    if (!parameter.starts_with("charset=")) return;
    foreign =
        parameter != "charset=utf-8" && parameter != "charset=\"utf-8\"" && parameter != "charset=us-ascii";
  });
  return foreign;
}

}  // namespace

std::optional<Target> parse_target(std::string_view target) {
  target = target.substr(0, target.find('#'));  // a fragment is the client's own business
  const std::size_t mark = std::min(target.find('?'), target.size());
  std::optional<std::string> path = percent_decoded(target.substr(0, mark), Plus::plus);
  if (!path) return std::nullopt;
  Target result{.path = std::move(*path)};
  std::string_view query = target.substr(std::min(mark + 1, target.size()));
  while (!query.empty()) {
    const std::size_t end = std::min(query.find('&'), query.size());
    const std::string_view pair = query.substr(0, end);
    query.remove_prefix(std::min(end + 1, query.size()));
    if (pair.empty()) continue;
    const std::size_t equals = std::min(pair.find('='), pair.size());
    auto name = percent_decoded(pair.substr(0, equals), Plus::space);
    auto value = percent_decoded(pair.substr(std::min(equals + 1, pair.size())), Plus::space);
    if (!name || !value) return std::nullopt;
    result.query.emplace_back(std::move(*name), std::move(*value));
  }
  return result;
}

const std::string* negotiated(std::string_view accept, std::span<const std::string> offered) {
  std::vector<MediaRange> ranges;
  for_each_part(accept, ',', [&](std::string_view part) { ranges.push_back(parse_range(part)); });
  if (ranges.empty()) ranges.push_back({"*/*"});
  const std::string* best = nullptr;
  double best_quality = 0;
  for (const std::string& type : offered) {
    if (const double quality = quality_of(type, ranges); quality > best_quality) {
      best = &type;
      best_quality = quality;
    }
  }
  return best;
}

BodyType body_type(std::string_view content_type, std::string_view body) {
  const std::string type = lower_case(trimmed(content_type.substr(0, content_type.find(';'))));
  if (has_foreign_charset(content_type)) return BodyType::unsupported;
  if (type.empty() || type == "application/json" || type == "text/json") return BodyType::json;
  if (type.starts_with("application/") && type.ends_with("+json")) return BodyType::json;
  const std::size_t first = body.find_first_not_of(" \t\r\n");
  const bool begins_object = first != std::string_view::npos && body[first] == '{';
  const bool form = type == "application/x-www-form-urlencoded";
  return form && begins_object ? BodyType::json : BodyType::unsupported;
}

std::string entity_tag(std::string_view body) {
  // http://www.isthe.com/chongo/tech/comp/fnv/
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : body) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  std::string digits(16, '0');
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, hash >>= 4U) {
    *digit = "0123456789abcdef"[hash & 15U];
  }
  return '"' + digits + '"';
}

bool matches_entity_tag(std::string_view if_none_match, std::string_view tag) {
  bool matches = false;
  for_each_part(if_none_match, ',', [&](std::string_view part) {
    if (part.starts_with("W/")) part.remove_prefix(2);  // comparison is weak here (13.1.2)
    matches = matches || part == tag || part == "*";
  });
  return matches;
}

}  // namespace qdot::api
