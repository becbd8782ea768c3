// What every error code M_e is called, and what to do about it.
#pragma once

#include <span>

#include "host/verify/verdict.hpp"

namespace liana::verify {

struct RefusalRow {
  Refusal code;
  const char* name;    // of the class, for programs
  const char* remedy;  // for people
};

// A row for every code but kNone, in the order of their numbers.
std::span<const RefusalRow> refusal_table();

// The row of a code that is not kNone.
const RefusalRow& row_of(Refusal code);

}  // namespace liana::verify
