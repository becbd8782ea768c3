// The table of all kinds of faults: what each is called, what it happens to, whether it can end, what it can be told
// (docs/how-to/run-hil.md).
#pragma once

#include <vector>

#include "hil/config/fault_config.hpp"

namespace liana::bench {

// A value that a kind can be told.
struct FaultValue {
  const char* name = nullptr;
  double FaultParameters::*value = nullptr;
  double low = 0.0;
  double high = 0.0;
  bool whole = false;
  bool required = false;
};

struct KindOfFault {
  const char* name;
  FaultKind kind;
  FaultOf of;
  bool can_end;  // the others leave something behind that no time takes back
  std::vector<FaultValue> values;
};

const std::vector<KindOfFault>& kinds_of_faults();

// The row of a kind.
const KindOfFault& row_of(FaultKind kind);

}  // namespace liana::bench
