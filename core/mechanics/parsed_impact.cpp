#include "core/mechanics/parsed_impact.hpp"

#include <algorithm>
#include <set>

#include "core/mechanics/scene_text.hpp"

namespace qdot {
namespace {

class ImpactParser {
 public:
  ImpactParser(const Scene& scene, const Symbols& symbols, SceneText& text, const Impact& impact,
               std::string place)
      : scene_(scene), symbols_(symbols), text_(text), impact_(impact), place_(std::move(place)) {}

  ParsedImpact parse(const std::vector<ParsedSceneEvent>& events) {
    ParsedImpact parsed{impact_.event, place_, read_map(impact_.map, "/map", Context::state), {}};
    const auto event = std::ranges::find(scene_.events, impact_.event, &SceneEvent::name);
    if (event == scene_.events.end()) {
      complain("/event", "unknown_event", "There is no event '" + impact_.event + "' in this scene.");
    } else if (!impact_.restitution.empty()) {
      parsed.contact =
          with_restitution(events[static_cast<std::size_t>(event - scene_.events.begin())].value);
    } else if (!impact_.contact_made.empty()) {
      const Expression& distance = events[static_cast<std::size_t>(event - scene_.events.begin())].value;
      parsed.contact = of_contacts(distance);
    }
    return parsed;
  }

 private:
  void complain(const std::string& at, const std::string& code, const std::string& message) {
    text_.complain(place_ + at, code, message);
  }

  ParsedContact with_restitution(const Expression& distance) {
    const Expression e =
        text_.read(impact_.restitution, Context::parameters, place_ + "/restitution", Dimension{});
    const Number* number = e.number();
    if (number != nullptr && (number->is_negative() || (Number(1) - *number).is_negative()))
      complain("/restitution", "domain", "A restitution is between 0 and 1.");
    check_distance(distance);
    return {e, distance, distance, {}, {}, {}};
  }

  /// What is touched with restitution is a place: its distance has a gradient, and nothing else moves it.
  void check_distance(const Expression& distance) {
    if (depends_on(distance, symbols_.coordinates.rate) ||
        !depends_on(distance, symbols_.coordinates.value)) {
      complain(
          "/restitution", "not_applicable",
          "The expression of '" + impact_.event +
              "' must be a distance, an expression of the coordinates without velocities: its slope is the "
              "direction of the impulse.");
    }
  }

  std::optional<ParsedContact> of_contacts(const Expression& distance) {
    if (!scene_.constraints.empty()) {
      complain("/contact_made", "not_applicable",
               "An impact that moves all positions on to another contact takes the place of the constraints, "
               "which do not move with it: with constraints give a restitution.");
      return std::nullopt;
    }
    if (impact_.contact_left.empty()) {
      complain("", "missing",
               "'contact_left' is missing: the point that rested until the impact, and leaves.");
      return std::nullopt;
    }
    ParsedContact contact{{},
                          distance,
                          distance,
                          text_.read_position({impact_.contact_made, {}}, place_ + "/contact_made"),
                          text_.read_position({impact_.contact_left, {}}, place_ + "/contact_left"),
                          read_map(impact_.renamed, "/renamed", Context::configuration)};
    check_contacts(contact);
    return contact;
  }

  void check_contacts(const ParsedContact& contact) {
    if (scene_.lagrangian.empty() && scene_.bodies.empty()) return;  // told elsewhere
    if (!scene_.lagrangian.empty()) {
      complain("/contact_made", "not_applicable",
               "This impact is derived from bodies, and the scene has a lagrangian.");
    }
    for (const Expression& component : contact.left) {
      if (!depends_on(component, symbols_.coordinates.value) && !depends_on(component, symbols_.t)) continue;
      complain("/contact_left", "not_applicable",
               "'" + impact_.contact_left + "' moves: the contact that is left must rest until then.");
      return;
    }
  }

  std::vector<Replacement> read_map(const std::vector<std::pair<std::string, std::string>>& map,
                                    const std::string& at, Context context) {
    std::vector<Replacement> result;
    const Symbols::Varying& q = symbols_.coordinates;
    for (const auto& [name, text] : map) {
      const std::string place = place_ + at + "/" + name;
      const Expression symbol = symbols_.t.graph().symbol(name);
      const bool is_coordinate = std::ranges::find(q.value, symbol) != q.value.end();
      const bool is_state =
          is_coordinate || (context == Context::state && std::ranges::find(q.rate, symbol) != q.rate.end());
      if (!is_state) {
        text_.complain(
            place, "unknown_symbol",
            "'" + name + "' is " +
                (context == Context::state ? "neither a coordinate nor a velocity." : "no coordinate."));
      }
      const auto expected = is_state ? text_.dimension_of_symbol(symbol) : std::nullopt;
      result.emplace_back(symbol, text_.read(text, context, place, expected));
    }
    return result;
  }

  const Scene& scene_;
  const Symbols& symbols_;
  SceneText& text_;
  const Impact& impact_;
  std::string place_;
};

}  // namespace

std::vector<ParsedImpact> parse_impacts(const Scene& scene, const Symbols& symbols,
                                        const std::vector<ParsedSceneEvent>& events, SceneText& text) {
  std::vector<ParsedImpact> parsed;
  if (scene.impact)
    parsed.push_back(ImpactParser(scene, symbols, text, *scene.impact, "/impact").parse(events));
  std::set<std::string> seen;
  for (std::size_t i = 0; i < scene.impacts.size(); ++i) {
    const std::string place = "/impacts/" + std::to_string(i), &event = scene.impacts[i].event;
    parsed.push_back(ImpactParser(scene, symbols, text, scene.impacts[i], place).parse(events));
    if (seen.insert(event).second) continue;
    text.complain(place + "/event", "duplicate_name",
                  "There is an impact at '" + event + "' already: an event has one impact.");
  }
  return parsed;
}

}  // namespace qdot
