// What the two verification ends say about a candidate command (mission, C).
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace liana::verification {

// Error codes M_e: 1xx what only the controller can fail at, 2xx the motion, whichever end sees it. Numbers never
// change meaning; refusal_table.hpp says what each of them is called.
enum class Refusal : std::uint16_t {
  kNone = 0,
  kTwinFault = 101,     // the controller would latch a fault
  kGate = 102,          // the gate would refuse an output
  kTension = 103,       // the tension plan would leave its limits
  kCableSpeed = 104,    // a cable would move too fast
  kNotAccepted = 105,   // the controller would not take the command
  kTooSlow = 106,       // the verdict came after the command interval (real time only)
  kJointTravel = 107,   // a serial arm's joint would be told to go further in a tick than its rate allows
  kTickTime = 108,      // the predicted ticks would take longer than the machine has for them
  kModel = 109,         // the arm is not where the model has it: no prediction holds
  kJointAngle = 201,    // a joint angle would pass its limit
  kJointRate = 202,     // a joint would turn too fast
  kTipSpeed = 203,      // the tip would move or turn too fast
  kNoRest = 204,        // the stop after the command would take too long
  kNotFinite = 205,     // a predicted number is not finite
  kUnreachable = 206,   // the arm cannot take the tip there: the servo IK would fall behind its target
  kPath = 207,          // the whole of a path or joint move was looked at, and it is not begun
  kSceneContact = 208,  // the arm could touch the scene, on the way or while it stops
  kSelfContact = 209,   // the arm would touch itself
  kNodeSpeed = 210,     // the arm's body would move too fast
  kSwingTension = 211,  // with what inertia adds a cable would go slack or be overloaded
  kNoVerdict = 212,     // the simulation had no verdict in time
  kFixture = 213,       // the tip would pass a virtual wall of the scene
  kPushTube = 214,      // a push would leave its tube: too far along its axis or beside it, or with too much force
};

// What a motion leaves of its limits, at its tightest; negative: by so much it is outside.
struct Margins {
  double clearance_m = 0.0;  // of what is claimed: the least distance less its bound and what has to be left
  double joint_deg = 0.0;
  double rate_deg_s = 0.0;
  double tension_N = 0.0;
  double time_us = 0.0;  // of the time that the machine has for a tick
};

// Where nobody looked at what is left.
constexpr Margins margins_unknown() {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  return {kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
}

// What comes first: of a refusal what made it, else where the arm comes nearest to the scene.
struct First {
  std::string body;
  double time_s = 0.0;  // from when the command is given
};

// One end's judgement of one candidate.
struct Verdict {
  std::uint64_t sequence = 0;
  std::uint32_t trial = 0;  // of what was tried under this sequence
  Refusal code = Refusal::kNone;
  std::string text;    // why it was refused; empty when passed
  std::string margin;  // where the motion comes nearest to a limit, e.g. "theta 3: 0.8 of the rate limit"
  double share = 0.0;  // of that limit; over 1 refuses
  Margins margins;     // with First and slowly: the simulation's alone
  First first;
  std::string touches_itself;  // what of the arm touches what at the start, where that is let go; else empty
  bool slowly = false;         // nearer to the scene than where it says to go slowly
  bool passed() const { return code == Refusal::kNone; }
};

struct ExecutionVerdict : Verdict {};
struct SimulationVerdict : Verdict {};

}  // namespace liana::verification
