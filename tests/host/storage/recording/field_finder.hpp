// Images of a Controller with one field changed by name.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/image.hpp"

namespace liana::recording {

template <class Arm>
std::string state_of(const Controller<Arm>& controller) {
  std::string bytes;
  append_state(bytes, controller);
  return bytes;
}

// The state with `value` in place of a field, e.g. "faults.count"; std::logic_error when there is none of this name.
template <class Arm, class T>
std::string with_field(const Controller<Arm>& controller, const std::string& field, T value) {
  std::optional<std::size_t> found;
  std::size_t at = 0;
  FieldWalker walker([&](const std::string& path, std::size_t bytes) {
    if (path == "controller." + field) found = at;
    at += bytes;
  });
  walker("controller", controller);
  std::string bytes = state_of(controller), written;
  Writer writer(written);
  writer("", value);
  if (!found) throw std::logic_error("there is no field " + field);
  return bytes.replace(*found, written.size(), written);
}

}  // namespace liana::recording
