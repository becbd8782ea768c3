// What a maker's dictionary has otherwise than the bench's own.
#pragma once

#include <vector>

#include "hil/config/dictionary_config.hpp"
#include "hil/drive/object_dictionary.hpp"

namespace liana::bench {

// Adds, hides, fixes and sets what `dictionary` says. An absent object stays the drive's own affair: it goes by its
// power-on value, and nobody can read, write or map it. Throws std::runtime_error naming drive type and object
// for one that is not there, or is added twice.
void change_objects(const DictionaryConfig& dictionary, std::vector<Object>& objects);

}  // namespace liana::bench
