// An electronic data sheet (EDS) or device configuration (DCF) of a CANopen device, as CiA 306-1 has it and as makers
// write it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/model/config/drive_type.hpp"

namespace liana::commissioning {

struct EdsObject {
  std::string name;                       // ParameterName, printable ASCII
  std::uint16_t data_type = 0;            // of CiA 301, e.g. 7 for UNSIGNED32; 0: not said
  std::string access;                     // "ro", "wo", "rw", "rwr", "rww", "const"; empty: not said
  bool is_mappable = false;               // PDOMapping
  std::optional<std::int64_t> value;      // ParameterValue of a DCF, else DefaultValue; with $NODEID taken as 0
  bool has_node_id = false;               // the value is relative to the node id
  std::optional<std::int64_t> low, high;  // LowLimit, HighLimit

  // Bytes of the data type; 0: a text, a domain, or not said.
  std::size_t bytes() const;
  bool is_writable() const { return access.empty() || access == "wo" || access.starts_with("rw"); }
};

struct Eds {
  std::string vendor, product, version;           // VendorName, ProductName, FileVersion with FileRevision
  std::optional<std::int64_t> vendor_number;      // VendorNumber
  std::map<config::ObjectId, EdsObject> objects;  // of arrays and records: their sub-indices
  std::vector<std::string> remarks;               // what could not be read as it stands, in words, at most 20
  const EdsObject* find(std::uint16_t index, std::uint8_t sub) const;
};

// Reads the text of a file: any line ends, comments, keys in any case, Latin-1, decimal, octal and hexadecimal numbers,
// CompactSubObj and CompactPDO. A line or number that means nothing is a remark. Throws std::runtime_error "FILE: why:
// what to do" where no object of a CANopen device is found.
Eds parse_eds(std::string_view text, const std::string& file);

}  // namespace liana::commissioning
