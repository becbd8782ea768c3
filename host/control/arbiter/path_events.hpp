// What is told of paths.
#pragma once

#include <string>

#include "host/base/event/event.hpp"

namespace liana::arbiter {

// A path under way: share of its time, 0 while it is looked at.
struct PathProgress {
  std::string hash;
  double share = 0.0;
};

// What has become of a path.
struct PathEvents {
  event::PathEvent what = event::PathEvent::kBegins;
  PathProgress path{};
  double duration_s = 0.0;  // of the whole path; 0 when it does not begin
  std::string text;         // one sentence for people
};

}  // namespace liana::arbiter
