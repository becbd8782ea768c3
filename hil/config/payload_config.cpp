#include "hil/config/payload_config.hpp"

#include <algorithm>

#include "hil/config/fields.hpp"

namespace liana::bench {

namespace {

double number_or_none(const JsonFile& file, const std::string& field, double high) {
  return file.has(field) ? file.number(field, 0.0, high) : 0.0;
}

// "mechanism" or "arm".
bool begins_on_arm(const JsonFile& file, const std::string& field) {
  const std::string where = file.text(field);
  if (where != "mechanism" && where != "arm")
    file.fail(field, "is \"" + where + "\"; allowed are \"mechanism\" and \"arm\"");
  return where == "arm";
}

}  // namespace

std::optional<PayloadConfig> read_payload(const JsonFile& file) {
  if (!file.has("/payload")) return std::nullopt;
  PayloadConfig payload;
  payload.body.mass_kg = file.number("/payload/mass_kg", 1.0, 1e5);
  payload.body.center_m = file.vector("/payload/center_m");
  const auto inertia = file.numbers("/payload/inertia_kgm2", 6, -1e6, 1e6);
  std::copy(inertia.begin(), inertia.end(), payload.body.inertia_kgm2.begin());
  payload.length_m = file.number("/payload/length_m", 0.05, 20.0);
  payload.radius_m = file.number("/payload/radius_m", 0.01, 10.0);
  payload.pose = file.pose("/payload");
  payload.on_arm = begins_on_arm(file, "/payload/start");
  if (file.has("/payload/fetch_pose")) payload.fetch_pose = file.text("/payload/fetch_pose");
  payload.start_lateral_m = number_or_none(file, "/payload/start_lateral_m", 0.02);
  payload.start_tilt_rad = kRadPerDeg * number_or_none(file, "/payload/start_tilt_deg", 5.0);
  if (!file.has("/adapter")) file.fail("/adapter", "is missing beside payload: say where it goes");
  return payload;
}

std::optional<AdapterConfig> read_adapter(const JsonFile& file) {
  if (!file.has("/adapter")) return std::nullopt;
  if (!file.has("/payload")) file.fail("/payload", "is missing beside adapter: say what goes into it");
  return AdapterConfig{file.pose("/adapter")};
}

}  // namespace liana::bench
