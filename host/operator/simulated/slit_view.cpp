#include "host/operator/simulated/slit_view.hpp"

namespace liana::simulated {

SlitModel slit_drawing(const Pose& slit_in_base, const Pose& rod_in_base) {
  return {slit_in_base, compose(inverse(slit_in_base), rod_in_base)};
}

std::optional<Pose> tip_in_slit(const SlitModel& drawing, const TipObservation& sighting, bool by_rod) {
  if (by_rod && sighting.rod) return compose(drawing.rod_in_slit, inverse(*sighting.rod));
  if (sighting.slit) return inverse(*sighting.slit);
  return std::nullopt;
}

PoseStep step_between(const Pose& from, const Pose& to) {
  return {subtract(to.position_m, from.position_m),
          rotation_vector(normalize(multiply(to.quaternion, conjugate(from.quaternion))))};
}

Pose moved(const Pose& pose, const PoseStep& step) {
  return {add(pose.position_m, step.shift_m), normalize(multiply(quaternion_of(step.turn_rad), pose.quaternion))};
}

}  // namespace liana::simulated
