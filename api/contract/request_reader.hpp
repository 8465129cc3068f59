#pragma once
// A submission read by a FieldSet (record_reader.hpp), whichever way it was sent.
//
// A query is flat: `?system=cart_pendulum&k=19.62&theta=30deg&t_end=10`. Its names are, first of all, the
// fields of the endpoint; then the parameters of the system, its coordinates and velocities, and its inputs.
// Should a system have a parameter named like a field, `parameters.dt=3` says which is meant; so do
// `initial.` and `inputs.`.

#include "api/contract/field.hpp"
#include "api/contract/submission.hpp"
#include "api/contract/system_choice.hpp"

namespace qdot::api {

struct Reading {
  Json resolved = Json::object();        ///< the echo that an answer carries as `request`
  std::vector<std::string> defaulted{};  ///< fields that were left out and have a default
  ExactNumbers exact{};
  SystemChoice system{};
  Errors errors{};
};

[[nodiscard]] Reading read_request(const FieldSet& set, const Submission& submission,
                                   const FindSystem& find_system);

}  // namespace qdot::api
