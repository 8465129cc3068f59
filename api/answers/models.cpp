#include "api/answers/models.hpp"

namespace qdot::api {
namespace {

Problem wrong_scene(const SceneError& error, const Place& whole) {
  std::vector<FieldError> errors;
  for (const Diagnostic& diagnostic : error.diagnostics()) {
    FieldError found = whole.below("system").error(diagnostic.code, diagnostic.message);
    if (!found.pointer.empty()) found.pointer += diagnostic.place;
    errors.push_back(std::move(found));
  }
  return invalid_request(std::move(errors));
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

}  // namespace

Models::Kept* Models::find(const Scene& scene) {
  const auto found = kept_.find(&scene);
  return found == kept_.end() ? nullptr : &found->second;
}

std::shared_ptr<const Dynamics> Models::of(const SystemChoice& choice) {
  const std::vector<std::string> inputs = inputs_in_order(choice);
  Kept* kept = find(*choice.scene);
  if (kept == nullptr) return std::make_shared<const Dynamics>(build_model(*choice.scene), inputs);
  const std::lock_guard lock(kept->mutex);
  if (!kept->dynamics) kept->dynamics = std::make_shared<const Dynamics>(build_model(*choice.scene));
  if (inputs.empty()) return kept->dynamics;
  return std::make_shared<const Dynamics>(kept->dynamics->shared_model(), inputs);
}

Json Models::remembered(const Scene& scene, const std::string& name, const std::function<Json()>& make) {
  Kept* kept = find(scene);
  if (kept == nullptr) return make();
  {
    const std::lock_guard lock(kept->mutex);
    const auto found = kept->documents.find(name);
    if (found != kept->documents.end()) return found->second;
  }
  Json document = make();
  const std::lock_guard lock(kept->mutex);
  return kept->documents.try_emplace(name, std::move(document)).first->second;
}

Problem problem_of(const Error& error, const Place& whole) {
  if (const auto* scene = dynamic_cast<const SceneError*>(&error)) return wrong_scene(*scene, whole);
  switch (error.code()) {
    case ErrorCode::syntax:
      return invalid_request({whole.error("syntax", error.what())});
    case ErrorCode::unknown_symbol:
      return invalid_request({whole.error("unknown_symbol", error.what())});
    case ErrorCode::invalid_state:
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
