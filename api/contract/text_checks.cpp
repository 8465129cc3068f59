#include "api/contract/text_checks.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <variant>

#include "api/contract/units.hpp"
#include "core/expr/parse.hpp"

namespace qdot::api {
namespace {

std::vector<std::string> input_symbols(const Scene& scene) {
  std::vector<std::string> allowed{"t"};
  for (const Parameter& p : scene.parameters) allowed.push_back(p.name);
  return allowed;
}

std::vector<std::string> event_symbols(const Scene& scene) {
  std::vector<std::string> allowed = input_symbols(scene);
  for (const Symbol& symbol : symbols(scene, SymbolRole::initial)) allowed.push_back(symbol.name);
  for (const Constraint& constraint : scene.constraints) allowed.push_back(multiplier_name(constraint));
  return allowed;
}

std::string as_sentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ".";
}

std::string unit_of_input(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.inputs, name, &Input::name);
  return found == scene.inputs.end() ? "1" : found->unit;
}

/// "5 N", "5N": a number and a unit, not a number alone.
bool has_unit(const std::string& text, const std::string& unit) {
  const bool ends_with_letter = !text.empty() && std::isalpha(static_cast<unsigned char>(text.back())) != 0;
  return ends_with_letter && std::holds_alternative<Real>(parse_quantity(text, unit));
}

/// What `read` throws, as an error at its place.
void check_text(const Place& place, const std::vector<std::string>& allowed, Findings& findings,
                const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& error) {
    const bool unknown = error.code() == ErrorCode::unknown_symbol;
    FieldError found = place.error(unknown                                ? "unknown_symbol"
                                   : error.code() == ErrorCode::too_large ? "too_large"
                                                                          : "syntax",
                                   as_sentence(error.what()));
    if (unknown) found.allowed = allowed;
    findings.add(std::move(found));
  }
}

}  // namespace

void check_events(const Scene& scene, const std::vector<std::string>& events, Findings& findings) {
  const std::vector<std::string> allowed = event_symbols(scene);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const bool named = std::any_of(scene.events.begin(), scene.events.end(),
                                   [&](const SceneEvent& event) { return event.name == events[i]; });
    if (named) continue;
    check_text(findings.root().below("events").below(i), allowed, findings, [&] {
      Graph graph;
      (void)parse_event(events[i], graph, allowed);
    });
  }
}

void check_inputs(const SystemChoice& choice, Findings& findings) {
  if (!choice.scene || findings.has_error_at({"inputs"})) return;
  const std::vector<std::string> allowed = input_symbols(*choice.scene);
  for (const auto& [name, text] : choice.inputs) {
    check_text(findings.root().below("inputs").below(name), allowed, findings,
               [&, &name = name, &text = text] {
                 Graph graph;
                 const std::string unit = unit_of_input(*choice.scene, name);
                 if (has_unit(text, unit))
                   throw Error(ErrorCode::syntax,
                               "an input is an expression in " + unit + ", without a unit behind it");
                 (void)parse(text, graph, allowed);
               });
  }
}

}  // namespace qdot::api
