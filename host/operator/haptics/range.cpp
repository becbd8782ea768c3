#include "host/operator/haptics/range.hpp"

#include <sstream>
#include <stdexcept>

namespace liana::haptics {

void check_range(const char* table, const char* field, double value, double least, double most) {
  if (value >= least && value <= most) return;
  std::ostringstream text;
  text << table << ": " << field << ": " << value << ": allowed: " << least << " to " << most;
  throw std::invalid_argument(text.str());
}

}  // namespace liana::haptics
