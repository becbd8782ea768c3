// What the two verification ends say about a candidate command (mission figure C).
#pragma once

#include <cstdint>
#include <string>

namespace liana::verify {

// Error codes M_e: 1xx execution capability (the controller's own outputs), 2xx simulation (the motion). Numbers never
// change meaning.
enum class Refusal : std::uint16_t {
  kNone = 0,
  kTwinFault = 101,    // the controller would latch a fault
  kGate = 102,         // the gate would refuse an output
  kTension = 103,      // the tension plan would leave its limits
  kCableSpeed = 104,   // a cable would move too fast
  kNotAccepted = 105,  // the controller would not take the command
  kTooSlow = 106,      // the verdict came after the command interval (real time only)
  kJointTravel = 107,  // a serial arm's joint would be told to go further in a tick than its rate allows
  kModel = 108,        // the arm is not where the model has it: no prediction holds
  kJointAngle = 201,   // a joint angle would pass its limit
  kJointRate = 202,    // a joint would turn too fast
  kTipSpeed = 203,     // the tip would move or turn too fast
  kNoRest = 204,       // the stop after the command would take too long
  kNotFinite = 205,    // a predicted number is not finite
  kUnreachable = 206,  // the arm cannot take the tip there: the servo IK would fall behind its target
  kPath = 207,         // the whole of a path was looked at, and it is not begun
};

// One end's judgement of one candidate.
struct Verdict {
  std::uint64_t sequence = 0;
  Refusal code = Refusal::kNone;
  std::string text;    // why it was refused; empty when passed
  std::string margin;  // where the motion comes nearest to a limit, e.g. "theta 3: 0.8 of the rate limit"
  double share = 0.0;  // of that limit; over 1 refuses
  bool passed() const { return code == Refusal::kNone; }
};

struct ExecutionVerdict : Verdict {};
struct SimulationVerdict : Verdict {};

}  // namespace liana::verify
