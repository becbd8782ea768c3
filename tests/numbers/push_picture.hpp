// One push, as a picture: what is set, what the adapter feels, and how the base gives way and swings on.
#pragma once

#include <string>
#include <vector>

namespace liana::numbers {

// Of a push, after it was asked for.
struct Instant {
  double time_s = 0.0;
  double set_N = 0.0;
  double axial_N = 0.0;    // of the contact, along the way in
  double contact_N = 0.0;  // in all axes
  double base_m = 0.0;     // the tip of the arm that carries, from where it began
  double depth_m = 0.0;    // of the pins' plane past the face
  bool captured = false;
};

// The same push on the soft base and on the stiff one, as SVG.
std::string push_picture(const std::vector<Instant>& soft, const std::vector<Instant>& stiff);

}  // namespace liana::numbers
