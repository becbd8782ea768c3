// The shipped tables of the payload installation, as the bench reads them.
#pragma once

#include "hil/config/scene_config.hpp"
#include "tests/serial/both_tables.hpp"
#include "tests/temporary_folder.hpp"

namespace liana::test {

inline Json torque_arm_table() {
  Json table = config::good_table("robot", "macro_micro");
  table["drives"]["mode"] = "torque";
  return table;
}

inline std::string written(const Json& table, const char* name) {
  return program_folder().write(std::string(name) + ".json", table.dump());
}

inline bench::SceneConfig bench_scene(const Json& table) { return bench::load_scene(written(table, "scene")); }

inline bench::BusesConfig bench_buses() {
  return bench::load_buses(written(config::good_table("buses", "embedded_micro"), "buses"));
}

inline Json scene_table(const char* name) { return config::good_table("scene", name); }

}  // namespace liana::test
