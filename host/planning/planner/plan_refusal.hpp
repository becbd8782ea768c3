// What the independent check says against a plan.
#pragma once

#include <optional>
#include <string>

#include "host/planning/planner/plan.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

struct PlanRefusal {
  PlanOutcome outcome = PlanOutcome::limit;
  const char* constraint = "";
  std::string reason;
};

// The first limit of the request that a checked plan does not keep; none: the plan is good.
std::optional<PlanRefusal> refusal_of(const PlanRequest& request, const PlanCheck& check);

}  // namespace liana::planner
