#include "host/drives/calibration/jig_prompt.hpp"

#include <stdexcept>

namespace liana::calibration {

void wait_for_fixture(std::istream& in, std::ostream& out, const std::string& pose, std::size_t number,
                      std::size_t count) {
  out << "pose " << number << " of " << count << ": put the arm into jig " << pose << ", then press Enter" << std::endl;
  std::string line;
  if (!std::getline(in, line) || in.eof())
    throw std::runtime_error("the input ended before the arm was in jig " + pose +
                             ": nothing was calibrated: begin again at a terminal, and press Enter at each jig");
}

}  // namespace liana::calibration
