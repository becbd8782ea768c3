// What every error code M_e is called, what it says, what its margin is measured in, what lianad does about it and what
// people can.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "host/control/verification/verdict.hpp"

namespace liana::verification {

// Besides that the command is not released, which lets the arm come to rest along its path.
enum class RefusalAction : std::uint8_t {
  kHold,  // nothing: the next command may be better
  kStop,  // the same; an emergency stop, in force until it is cleared, where the stop along the path would collide too
};

struct RefusalRow {
  Refusal code = Refusal::kNone;
  const char* name = "";  // of the class, for programs
  const char* says = "";  // for people, one sentence
  const char* unit = "";  // of the margin; empty: it has none
  RefusalAction action = RefusalAction::kHold;
  const char* remedy = "";  // for people: what can be done next, here and now
};

// A row for every code but kNone, in the order of their numbers. A code without one does not compile.
std::span<const RefusalRow> refusal_table();

// The row of a code; of kNone one without a name.
const RefusalRow& row_of(Refusal code);

// Refused for how the arm would swing: beside the stop that follows a refusal it may pass (judge_simulated.hpp).
bool is_of_swing(Refusal code);
// Refused for how the arm would swing or stop: from rest, and more slowly, the same may pass.
bool may_pass_slower(Refusal code);
// It is about how the arm would move, not about verification itself, the time it took or the model.
bool is_of_motion(Refusal code);

const char* refusal_action_name(RefusalAction action);

// The table as it stands in docs/reference/refusals.md.
std::string markdown_of(std::span<const RefusalRow> rows);

}  // namespace liana::verification
