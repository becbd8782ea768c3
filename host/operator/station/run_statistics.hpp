// What only liana-operator can tell of a run: how far the tip is behind the hand, and what the hand felt. A file that
// the report of `liana run` takes in (docs/explanation/operator-model.md).
#pragma once

#include <optional>

#include "host/base/json/json_fwd.hpp"
#include "host/operator/simulated/operator_session.hpp"
#include "host/operator/station/human_session.hpp"
#include "host/operator/station/lag_meter.hpp"

namespace liana::station {

class RunStatistics {
 public:
  // These are sent to the arm: of samples the newest of the hand that moves the tip counts.
  void sent(const simulated::OperatorAnswer& answer);
  // A state of the arm, as it is now.
  void arm(const Json& state);
  // `hand`: nothing where no hand had a force.
  Json json(const std::optional<HandMotionParams>& hand) const;

 private:
  LagMeter lag_;
  double scale_ = 1.0;
};

}  // namespace liana::station
