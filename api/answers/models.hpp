#pragma once
// Compiled systems. Those of the catalogue and the classics are compiled once, on first use; a scene that a
// request carries is compiled for that request.

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "api/contract/system_choice.hpp"
#include "api/http/problem.hpp"
#include "api/scenes/catalogue.hpp"
#include "core/base/made_once.hpp"
#include "core/dynamics/dynamics.hpp"

namespace qdot::api {

class Models {
 public:
  Models() = default;
  /// Those of `shared`, which has to live as long, for one request that asks the same scenes and inputs many
  /// times: what is driven by inputs is kept too.
  explicit Models(Models& shared) : shared_(&shared) {}

  /// `scene` belongs to the catalogue and stays where it is.
  void add(const Scene& scene) { catalogue_.insert(&scene); }
  /// Classics stay, too, once they are read.
  void add(std::shared_ptr<Classics> classics) { classics_ = std::move(classics); }

  /// Throws SceneError for a wrong scene, and Error for an input that does not parse.
  [[nodiscard]] std::shared_ptr<const Dynamics> of(const SystemChoice& choice);
  /// With values of parameters that are exponents put in, and `followers` for parameters that follow others,
  /// for this request.
  [[nodiscard]] static std::shared_ptr<const Dynamics> of(const SystemChoice& choice, const Scene& scene,
                                                          const ExponentValues& exponents,
                                                          const Followers& followers = {});

  /// The same system, whose typed events have these exponents.
  [[nodiscard]] static std::shared_ptr<const Dynamics> with_exponents(const Dynamics& dynamics,
                                                                      const SystemChoice& choice,
                                                                      ExponentValues exponents);

  /// A document about one of the catalogue's systems, made once.
  [[nodiscard]] Json remembered(const Scene& scene, const std::string& name,
                                const std::function<Json()>& make);

 private:
  [[nodiscard]] bool is_kept(const Scene& scene) const {
    return catalogue_.contains(&scene) || (classics_ && classics_->owns(scene));
  }

  Models* shared_{};
  std::set<const Scene*> catalogue_;
  std::shared_ptr<Classics> classics_;
  MadeOnce<const Scene*, std::shared_ptr<const Dynamics>> systems_;
  MadeOnce<std::pair<const Scene*, std::vector<std::string>>, std::shared_ptr<const Dynamics>> driven_;
  MadeOnce<std::pair<const Scene*, std::string>, Json> documents_;
};

/// What core throws, as a problem of the request `whole`. Core's errors are translated here and nowhere else.
[[nodiscard]] Problem problem_of(const Error& error, const Place& whole);

}  // namespace qdot::api
