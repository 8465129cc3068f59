#include "api/answers/check/pointed_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "api/json/pointer.hpp"
#include "api/json/text.hpp"
#include "core/mechanics/units.hpp"

namespace qdot::api {
namespace {

constexpr std::size_t most_values = 10'000;

using Path = std::vector<std::string>;

/// The last part of a path that is no index, and what follows it.
std::pair<std::string, Path> name_and_indices(const Path& path) {
  std::size_t at = path.size();
  while (at > 0 && index_of(path[at - 1])) --at;
  if (at == 0) return {"", path};
  return {path[at - 1], Path(path.begin() + static_cast<std::ptrdiff_t>(at), path.end())};
}

/// A mode shape says how its coordinates compare, in any unit.
bool is_direction(const Path& path) {
  return std::ranges::any_of(
      path, [](const auto& key) { return key == "shape" || key == "shape_scaled" || key == "shape_error"; });
}

/// What `units` say of a name, or of one of the numbers in a list of that name.
std::optional<std::string> unit_of_name(const Json& units, const std::string& name, const Path& indices) {
  const Json* unit = child_at(units, name);
  for (const std::string& index : indices) {
    if (unit != nullptr && unit->is_array()) unit = child_at(*unit, index);
  }
  const bool is_known =
      unit != nullptr && unit->is_string() && parse_unit(unit->get_ref<const std::string&>());
  return is_known ? std::optional(unit->get<std::string>()) : std::nullopt;
}

/// An error without a name is that of the first of its neighbours with a unit: of an event's time, of a
/// mode's frequency, of both parts of an eigenvalue.
std::optional<std::string> unit_of_neighbours(const Json& units, const Json& object) {
  for (const char* name : {"t", "omega", "re"}) {
    if (object.contains(name)) return unit_of_name(units, name, {});
  }
  return std::nullopt;
}

/// What a number deep in an answer shares with others: the unit of its object, of its neighbours, of what it
/// is the error of, or of the time.
std::optional<std::string> shared_unit(const Json& units, const Json& object, const std::string& name) {
  if (const Json* own = child_at(object, "unit"); own != nullptr && own->is_string())
    return name == "max_rel_drift" ? "1" : own->get<std::string>();
  if (name == "error") return unit_of_neighbours(units, object);
  if (name == "t_reached" || name == "horizon") return unit_of_name(units, "t", {});
  constexpr std::string_view of_error = "_error";
  if (!name.ends_with(of_error)) return std::nullopt;
  return unit_of_name(units, name.substr(0, name.size() - of_error.size()), {});
}

std::string unit_of(const Json& answer, const Path& path) {
  const auto [name, indices] = name_and_indices(path);
  const auto units = answer.find("units");
  if (units == answer.end() || is_direction(path)) return "1";
  const Json* object = &answer;
  for (std::size_t i = 0; i + 1 + indices.size() < path.size(); ++i) object = child_at(*object, path[i]);
  const bool is_deep = object != &answer;
  if (is_deep || !child_at(*units, name)) {
    if (const auto shared = shared_unit(*units, *object, name)) return *shared;
  }
  return unit_of_name(*units, name, indices).value_or("1");
}

std::optional<double> number_in(const Json& object, const std::string& key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

/// What an object says of the error of the number `name` inside it.
std::optional<double> error_in(const Json& object, const std::string& name) {
  if (!object.is_object()) return std::nullopt;
  if (const auto own = number_in(object, name + "_error")) return own;
  for (const char* key : {"error", "max_abs_error"}) {
    if (const auto found = object.find(key); found != object.end() && found->is_object()) {
      if (const auto of_name = number_in(*found, name)) return of_name;
    }
  }
  if (const auto accuracy = object.find("accuracy"); accuracy != object.end()) {
    return error_in(*accuracy, name);
  }
  return std::nullopt;
}

/// The nearest statement of an error above a value; an `error` without names is that of its neighbours.
double error_of(const Json& answer, const Path& path, double value) {
  const std::string name = name_and_indices(path).first;
  std::vector<const Json*> above{&answer};
  for (const std::string& token : path) above.push_back(child_at(*above.back(), token));
  above.pop_back();
  if (const auto beside = number_in(*above.back(), "error")) return *beside;
  for (auto place = above.rbegin(); place != above.rend(); ++place) {
    if (const auto error = error_in(**place, name)) return *error;
  }
  return 2 * std::numeric_limits<double>::epsilon() * std::abs(value);
}

class Collector {
 public:
  explicit Collector(const Json& answer) : answer_(answer) {}

  /// Everything below `here` from token number `next` on; false where a token leads nowhere.
  bool follow(const Json& here, const Path& tokens, std::size_t next) {
    if (next == tokens.size()) return collect(here);
    if (tokens[next] == "*" && here.is_array()) {
      found_.is_list = true;
      return each(here, [&](const Json& element) { return follow(element, tokens, next + 1); });
    }
    const Json* below = child_at(here, tokens[next]);
    if (below == nullptr) {
      where_ = &here;
      return false;
    }
    path_.push_back(tokens[next]);
    const bool leads = follow(*below, tokens, next + 1);
    path_.pop_back();
    return leads;
  }

  [[nodiscard]] Pointed take() { return std::move(found_); }
  /// Where the pointer ended that leads nowhere.
  [[nodiscard]] const Json& where() const { return *where_; }
  [[nodiscard]] bool is_full() const { return found_.values.size() > most_values; }

 private:
  bool collect(const Json& here) {
    if (is_full()) return true;
    if (here.is_array()) {
      found_.is_list = true;
      return each(here, [&](const Json& element) { return collect(element); });
    }
    if (here.is_object()) {
      found_.is_list = true;
      for (const auto& [key, value] : here.items()) {
        path_.push_back(key);
        collect(value);
        path_.pop_back();
      }
      return true;
    }
    const double error = here.is_number() ? error_of(answer_, path_, here.get<double>()) : 0;
    const bool may_have_unit = here.is_number() || here.is_null();
    found_.values.push_back(
        {name_and_indices(path_).first, here, may_have_unit ? unit_of(answer_, path_) : "1", error});
    return true;
  }

  template <class Use>
  bool each(const Json& array, Use use) {
    bool leads = true;
    for (std::size_t i = 0; i < array.size() && leads; ++i) {
      path_.push_back(std::to_string(i));
      leads = use(array[i]);
      path_.pop_back();
    }
    return leads;
  }

  const Json& answer_;
  const Json* where_{&answer_};
  Path path_;
  Pointed found_;
};

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  if (!object.is_object()) return keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

}  // namespace

std::optional<Pointed> pointed(const Json& answer, const std::string& pointer, const Place& place,
                               Errors& errors) {
  const auto tokens = steps_of(pointer);
  if (!tokens) {
    report(errors, place.error("syntax", "A pointer looks like '/theta_max' or '/modes/0/omega'."));
    return std::nullopt;
  }
  Collector collector(answer);
  if (!collector.follow(answer, *tokens, 0)) {
    FieldError error = place.error("unknown_place", "The answer has nothing at " + in_quotes(pointer) + ".");
    error.allowed = keys_of(collector.where());
    report(errors, std::move(error));
    return std::nullopt;
  }
  if (collector.is_full()) {
    report(errors,
           place.error("too_many", "There are more than 10000 values at " + in_quotes(pointer) + "."));
    return std::nullopt;
  }
  return collector.take();
}

}  // namespace qdot::api
