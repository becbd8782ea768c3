// A drive type from an electronic data sheet: the table that a boot needs, and what the drive lacks, in words.
#pragma once

#include <string>
#include <vector>

#include "host/drives/commissioning/eds.hpp"

namespace liana::commissioning {

struct TypeFromEds {
  std::string name;                  // of the type: lower case letters, digits, '_', at most 40
  std::string table;                 // Lua, as a file of lua/drives; empty where `missing` is not
  std::vector<std::string> missing;  // what the mode needs and the drive has not: it cannot be driven so
  std::vector<std::string> notes;    // what nobody checks, what is assumed, what to look at
};

// `is_cst`: for cyclic synchronous torque, else position. `source`: the file, as the table names it.
TypeFromEds type_from_eds(const Eds& eds, bool is_cst, const std::string& source);

}  // namespace liana::commissioning
