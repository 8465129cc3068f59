#include "api/answers/models.hpp"

#include "api/json/suggest.hpp"
#include "core/dynamics/consistent_state.hpp"
#include "core/expr/parse.hpp"
#include "core/expr/print/print.hpp"

namespace qdot::api {
namespace {

Problem wrong_scene(const SceneError& error, const Place& whole) {
  std::vector<FieldError> errors;
  for (const Diagnostic& diagnostic : error.diagnostics()) {
    FieldError found = whole.below("system").error(diagnostic.code, diagnostic.message);
    if (!found.pointer.empty()) found.pointer += diagnostic.place;
    found.allowed = diagnostic.allowed;
    found.did_you_mean = diagnostic.meant;
    if (found.did_you_mean.empty() && !diagnostic.symbol.empty())
      found.did_you_mean = closest(diagnostic.symbol, diagnostic.allowed);
    errors.push_back(std::move(found));
  }
  return invalid_request(std::move(errors));
}

/// The nearest state stands in the problem as a request would give it.
Problem inconsistent(const InconsistentState& error, const Place& whole) {
  const bool is_found = !error.nearest().empty();
  const std::string advice =
      is_found ? " A state near it that does is in 'nearest'." : " No state near it was found that does.";
  Problem problem =
      invalid_request({whole.below("initial").error("inconsistent_state", error.what() + advice)});
  if (!is_found) return problem;
  Json& nearest = problem.members["nearest"] = Json::object();
  for (const auto& [name, value] : error.nearest()) nearest[name] = value;
  return problem;
}

std::vector<std::string> inputs_in_order(const SystemChoice& choice) {
  std::vector<std::string> texts;
  for (const Input& input : choice.scene->inputs) {
    texts.emplace_back();
    for (const auto& [name, text] : choice.inputs) {
      if (name == input.name) texts.back() = text;
    }
  }
  return choice.inputs.empty() ? std::vector<std::string>{} : texts;
}

/// An input in which what follows has been put in; as it is where it does not parse, which Dynamics reports.
std::string with_followers(const std::string& input, const Scene& scene, const Followers& followers) {
  Graph graph;
  std::vector<std::string> parameters;
  for (const Parameter& p : scene.parameters) parameters.push_back(p.name);
  std::vector<std::string> names = parameters;
  names.emplace_back("t");
  const auto parsed = parse_all(input, graph, names).expression;
  if (!parsed) return input;
  return print(substitute(*parsed, follower_replacements(graph, followers, parameters)), Form::text);
}

}  // namespace

std::shared_ptr<const Dynamics> Models::of(const SystemChoice& choice) {
  const Scene& scene = *choice.scene;
  const std::vector<std::string> inputs = inputs_in_order(choice);
  if (shared_ != nullptr) {
    if (inputs.empty()) return shared_->of(choice);
    return driven_.get({&scene, inputs}, [&] { return shared_->of(choice); });
  }
  if (!is_kept(scene)) return std::make_shared<const Dynamics>(build_model(scene), inputs);
  const std::shared_ptr<const Dynamics>& plain =
      systems_.get(&scene, [&] { return std::make_shared<const Dynamics>(build_model(scene)); });
  if (inputs.empty()) return plain;
  return std::make_shared<const Dynamics>(plain->shared_model(), inputs);
}

std::shared_ptr<const Dynamics> Models::of(const SystemChoice& choice, const Scene& scene,
                                           const ExponentValues& exponents, const Followers& followers) {
  std::vector<std::string> inputs = inputs_in_order(choice);
  for (std::string& input : inputs) {
    if (!input.empty() && !followers.empty()) input = with_followers(input, scene, followers);
  }
  return std::make_shared<const Dynamics>(build_model(scene, exponents, followers), std::move(inputs));
}

std::shared_ptr<const Dynamics> Models::with_exponents(const Dynamics& dynamics, const SystemChoice& choice,
                                                       ExponentValues exponents) {
  return std::make_shared<const Dynamics>(dynamics.shared_model(), inputs_in_order(choice),
                                          std::move(exponents));
}

Json Models::remembered(const Scene& scene, const std::string& name, const std::function<Json()>& make) {
  if (shared_ != nullptr) return shared_->remembered(scene, name, make);
  return is_kept(scene) ? documents_.get({&scene, name}, make) : make();
}

Problem problem_of(const Error& error, const Place& whole) {
  if (const auto* scene = dynamic_cast<const SceneError*>(&error)) return wrong_scene(*scene, whole);
  switch (error.code()) {
    case ErrorCode::syntax:
      return invalid_request({whole.error("syntax", error.what())});
    case ErrorCode::unknown_symbol:
      return invalid_request({whole.error("unknown_symbol", error.what())});
    case ErrorCode::invalid_parameters:
      return invalid_request({whole.below("parameters").error("domain", error.what())});
    case ErrorCode::invalid_state:
      if (const auto* state = dynamic_cast<const InconsistentState*>(&error))
        return inconsistent(*state, whole);
      return invalid_request({whole.below("initial").error("invalid_state", error.what())});
    case ErrorCode::too_large:
      return {.kind = ProblemKind::limit_exceeded, .detail = error.what()};
    case ErrorCode::invalid_scene:
    case ErrorCode::not_applicable:
      break;
  }
  return {.kind = ProblemKind::not_applicable, .detail = error.what()};
}

}  // namespace qdot::api
