#pragma once
// The compiled systems: each of the catalogue once, on first use; a scene that a request carries, for that
// request.

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "api/contract/system_choice.hpp"
#include "api/http/problem.hpp"
#include "core/dynamics/dynamics.hpp"

namespace qdot::api {

class Models {
 public:
  /// `scene` belongs to the catalogue and stays where it is.
  void add(const Scene& scene) { kept_.try_emplace(&scene); }

  /// Throws SceneError for a wrong scene, and Error for an input that does not parse.
  [[nodiscard]] std::shared_ptr<const Dynamics> of(const SystemChoice& choice);

  /// A document about one of the catalogue's systems, made once.
  [[nodiscard]] Json remembered(const Scene& scene, const std::string& name,
                                const std::function<Json()>& make);

 private:
  struct Kept {
    std::mutex mutex;
    std::shared_ptr<const Dynamics> dynamics;
    std::map<std::string, Json> documents;
  };
  [[nodiscard]] Kept* find(const Scene& scene);

  std::map<const Scene*, Kept> kept_;
};

/// What core throws, as a problem of the request `whole`; the one place where it is translated.
[[nodiscard]] Problem problem_of(const Error& error, const Place& whole);

}  // namespace qdot::api
