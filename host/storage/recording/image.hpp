// The state of a Controller as bytes: field by field, never its memory.
#pragma once

#include <string>
#include <string_view>

#include "firmware_like/controller.hpp"

namespace liana::recording {

// Appends every field that the table does not give, little-endian, in the order of visit_state().
template <class Arm>
void append_state(std::string& out, const Controller<Arm>& controller);

// A Controller of this table that goes on from the state. Throws std::runtime_error that names file (`source`), field,
// value and what is allowed, when the bytes are not what append_state made of a Controller with such a table.
template <class Arm>
Controller<Arm> controller_from(std::string_view state, const typename Arm::Table& table, const std::string& source);

// A table from the front of `bytes`, checked likewise for what sizes and divides in the core; `used` is its length.
template <class Table>
Table checked_table(std::string_view bytes, const std::string& source, std::size_t& used);

}  // namespace liana::recording
