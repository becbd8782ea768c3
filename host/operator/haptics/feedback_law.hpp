// What the hand feels of the arm: three laws by name (docs/explanation/force-feedback.md). All compare positions of the
// arm's tip, in the arm's base frame, and turn the difference into a force on the hand.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "host/control/virtual_fixtures/hand_motion.hpp"

namespace liana::haptics {

// Source C (patent CN103722554A) has two, the third is the second with its delays taken out.
enum class Law : std::uint8_t {
  kClaim,     // the arm as last received against what the hand asks for now: P_md - P_m
  kAbstract,  // the arm as last received against the arm as predicted for now
  kAligned,   // the arm as last received against the prediction of that same state, T_1 + T_2 ago
};

constexpr std::array<std::string_view, 3> kLawNames{"claim", "abstract", "aligned"};
constexpr std::string_view name_of(Law law) { return kLawNames[static_cast<std::size_t>(law)]; }
// The law of a name; nothing for any other word.
std::optional<Law> law_of(std::string_view name);

// F = (K (p_arm - p_other) + B (v_arm - v_other)) / a, the difference of places shortened by what is not sure.
struct LawGains {
  double stiffness_N_m = 200.0;  // K, at the hand; 0 .. 1000
  double damping_N_s_m = 5.0;    // B of claim and abstract; 0 .. 20
  double unsure_m = 0.0;  // of that difference, what the arm's own measurement may be wrong by: not felt; 0 .. 0.1
  double scale = 1.0;     // a: the tip's way for one of the hand (P_r = a P_m); > 0
};

// What the laws choose from.
struct LawInputs {
  Motion robot{};           // as last received
  Motion commanded{};       // what the hand asks for now
  Motion predicted_now{};   // what commands already sent make of the arm, without delay, without contact
  Motion predicted_then{};  // the same at the moment that `robot` answers
};

// Force [N] on the hand. A pure function; zero where both are the same. Aligned has no damping: its difference is
// contact, and its rate would be the noise of two delays.
Vec3 law_force(Law law, const LawGains& gains, const LawInputs& inputs) noexcept;

}  // namespace liana::haptics
