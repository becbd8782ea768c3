// What is told of paths.
#pragma once

#include <string>

namespace liana {

// A path under way: share of its time, 0 while it is looked at.
struct PathProgress {
  std::string hash;
  double share = 0.0;
};

// What has become of a path, for events.
struct PathNews {
  bool is_refusal = false;  // it does not start
  std::string text;
};

}  // namespace liana
