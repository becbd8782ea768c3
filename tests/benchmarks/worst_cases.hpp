// Inputs that are made to cost: any bytes are a case, a controller in closed loop with ideal drives that is told and
// shown what they say.
//
// A case is a start pose, two commands of any kind (motion of tip or joints, shape, held variables, hold, stop; once,
// or every few ticks), two faults of tests/bits/what_ifs.hpp, noise on what the drives report, and a request. Bytes
// make cases small to store, and easy to change a little: tests/benchmarks/worst.cpp hunts with them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <istream>
#include <string>
#include <vector>

#include "tests/firmware_like/ideal_drives.hpp"

namespace liana::worst {

using namespace cable;

constexpr std::size_t kGenes = 140;
using Case = std::array<std::uint8_t, kGenes>;

// A case out of random bytes, many of them at the ends and in the middle of their range.
Case random_case(zhu2022::Random& random);

// The same with a few bytes changed; or a part of it from `other`.
Case mutated(const Case& from, const Case& other, zhu2022::Random& random);

// One line of hexadecimal digits.
std::string text_of(const Case& one);

// Lines as text_of writes them; empty ones and those that begin with # are left out. Throws std::runtime_error with
// line and reason.
std::vector<Case> read_cases(std::istream& lines);

// Carries out one tick of a case: controller.tick(inputs), and whatever is to be counted of it.
using Tick = std::function<cable::Outputs(cable::Controller& controller, const cable::Inputs& inputs)>;

// From power-up to an enabled arm at the case's start pose: about 1060 ticks. At some poses the arm cannot be enabled:
// that is no error.
Rig started(const Case& one, const Tick& tick);

// What follows then: 2 to 512 ticks.
void play(const Case& one, Rig rig, const Tick& tick);

}  // namespace liana::worst
