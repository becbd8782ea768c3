// What `liana calibrate` asks the person at a real arm.
#pragma once

#include <cstddef>
#include <istream>
#include <ostream>
#include <string>

namespace liana::calibration {

// Asks for the arm to be put into jig `pose`, number `number` of `count` from 1, and waits for Enter; throws
// std::runtime_error when the input ends without it.
void wait_for_fixture(std::istream& in, std::ostream& out, const std::string& pose, std::size_t number,
                      std::size_t count);

}  // namespace liana::calibration
