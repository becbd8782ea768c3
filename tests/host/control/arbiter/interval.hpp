// The command interval of these tests.
#pragma once

namespace liana::arbiter {

constexpr double kInterval_s = 0.02;

}  // namespace liana::arbiter
