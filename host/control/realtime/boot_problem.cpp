#include "host/control/realtime/boot_problem.hpp"

namespace liana::realtime {

std::string text_of(const std::vector<BootProblem>& problems) {
  std::string text;
  for (const BootProblem& problem : problems) text += (text.empty() ? "" : "; ") + problem.text;
  return text.empty() ? "no drive named a reason" : text;
}

}  // namespace liana::realtime
