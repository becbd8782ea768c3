// Messages as Foxglove's published schemas have them (foxglove.SceneUpdate, FrameTransforms, JointStates, Log), as
// JSON.
#pragma once

#include <string>
#include <vector>

#include "firmware_like/math/pose.hpp"
#include "host/base/event/event.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"

namespace liana::archive::foxglove {

// JSON Schema of a message: one of the four names above, with "foxglove." before it.
std::string schema_of(const std::string& name);

// {"sec","nsec"}, to a microsecond.
Json time(double time_s);

// What does not move (frame "base"), and each link as a cylinder fixed in a frame of its own, link_1, link_2, ...;
// `points` as ArmPoints has them.
Json scene_update(double time_s, const config::SceneConfig& scene, const std::vector<Vec3>& points, double radius_m);

// From the base link by link: the frame of each begins where the link does, with z along it.
Json frame_transforms(double time_s, const std::vector<Vec3>& points);

// Named theta_1, theta_2, ...; rad, of a slide m.
Json joint_states(double time_s, const std::vector<double>& values);

// How serious an event is, as foxglove.Log has it: kInfo, kInfo + 1 a warning, kInfo + 2 an error.
constexpr int kInfo = 2;
int level_of(const event::Event& event);

// Faults and stops are errors, refusals warnings, all else is information.
Json log(double time_s, const event::Event& event);

}  // namespace liana::archive::foxglove
