// What CiA 301 and CiA 402 call the objects of a drive; people find an object of a data sheet by its name.
#pragma once

#include <cstdint>
#include <string>

namespace liana::bench {

enum class ObjectCode : std::uint8_t { kVariable = 0x7, kArray = 0x8, kRecord = 0x9 };  // CiA 301, 7.4.3

// Whether an index stands for one value, or for several of one kind (array) or of different kinds (record).
ObjectCode code_of(std::uint16_t index);
// Name of an index, e.g. "Controlword"; "Object 3001" where it has none.
std::string name_of_index(std::uint16_t index);
// Name of an entry of an array or record, e.g. "COB-ID used by RPDO"; "Entry 7" where it has none.
std::string name_of_entry(std::uint16_t index, std::uint8_t sub);

}  // namespace liana::bench
