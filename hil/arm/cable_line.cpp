#include "hil/arm/cable_line.hpp"

#include <algorithm>
#include <cmath>

namespace liana::bench {

namespace {

constexpr int kMaxSweeps = 200;
constexpr double kToleranceN = 1e-7;

}  // namespace

CableLine::CableLine(const CablePaths& paths, std::size_t cable, double lead_m, double EA_N, double mu,
                     double tension_N)
    : cable_(cable),
      first_(paths.first_segment()),
      lumps_(paths.last_segment(cable) + 1 - first_),
      lead_m_(lead_m),
      EA_N_(EA_N),
      mu_(mu) {
  lay_out(paths);
  for (std::size_t i = 0; i <= lumps_; ++i) {
    material_m_[i] = length_m_[i] / (1.0 + tension_N / EA_N_);
    tension_N_[i] = tension_N;
  }
}

double CableLine::payout_m() const {
  double payout = 0.0;
  for (std::size_t i = 0; i <= lumps_; ++i) payout += material_m_[i];
  return payout;
}

void CableLine::lay_out(const CablePaths& paths) {
  length_m_.fill(0.0);
  length_m_[0] = lead_m_;
  for (std::size_t j = 0; j < lumps_; ++j) {
    const SegmentPath& path = paths.path(cable_, first_ + j);
    length_m_[j] += 0.5 * path.length_m;
    length_m_[j + 1] += 0.5 * path.length_m;
    ratio_[j] = std::exp(mu_ * path.wrap_rad);
  }
}

double CableLine::span_tension(std::size_t span) const {
  return std::max(0.0, EA_N_ * (length_m_[span] - material_m_[span]) / material_m_[span]);
}

void CableLine::spread_evenly() {
  double length = 0.0;
  for (std::size_t i = 0; i <= lumps_; ++i) length += length_m_[i];
  const double scale = payout_m() / length;
  for (std::size_t i = 0; i <= lumps_; ++i) material_m_[i] = length_m_[i] * scale;
}

// Moves just enough material through a lump that the larger tension is `ratio` times the smaller; false when the lump
// held.
bool CableLine::slip(std::size_t lump) {
  if (held_[lump]) return false;
  const double near = tension_N_[lump];
  const double far = tension_N_[lump + 1];
  const bool towards_near = near > ratio_[lump] * far + kToleranceN;
  if (!towards_near && far <= ratio_[lump] * near + kToleranceN) {
    held_[lump] = true;
    return false;
  }
  if (lump > 0) held_[lump - 1] = false;
  if (lump + 1 < lumps_) held_[lump + 1] = false;
  const std::size_t tight = towards_near ? lump : lump + 1;
  const std::size_t loose = towards_near ? lump + 1 : lump;
  const double stretch_tight = length_m_[tight] - material_m_[tight];
  const double stretch_loose = length_m_[loose] - material_m_[loose];
  const double k_tight = EA_N_ / material_m_[tight];
  const double k_loose = EA_N_ / material_m_[loose];
  const double balanced =
      (k_tight * stretch_tight - ratio_[lump] * k_loose * stretch_loose) / (k_tight + ratio_[lump] * k_loose);
  // Never more than makes the tight side slack: material is pulled, not pushed.
  const double moved = std::min(balanced, stretch_tight);
  material_m_[tight] += moved;
  material_m_[loose] -= moved;
  tension_N_[tight] = span_tension(tight);
  tension_N_[loose] = span_tension(loose);
  return true;
}

int CableLine::settle(const CablePaths& paths, double payout_m) {
  lay_out(paths);
  material_m_[0] += payout_m - this->payout_m();
  if (mu_ == 0.0) spread_evenly();
  for (std::size_t i = 0; i <= lumps_; ++i) tension_N_[i] = span_tension(i);
  if (mu_ == 0.0) return 0;
  held_.fill(false);
  for (int sweep = 1; sweep <= kMaxSweeps; ++sweep) {
    bool moved = false;
    for (std::size_t j = 0; j < lumps_; ++j) moved |= slip(j);
    for (std::size_t j = lumps_; j-- > 0;) moved |= slip(j);
    if (!moved) return sweep;
  }
  return kMaxSweeps;
}

double CableLine::least_tension_N() const {
  return *std::min_element(tension_N_.begin(), tension_N_.begin() + static_cast<std::ptrdiff_t>(lumps_ + 1));
}

void CableLine::add_stiffness(const CablePaths& paths, ThetaMatrix& stiffness) const {
  for (std::size_t i = 0; i <= lumps_; ++i) {
    Theta row{};  // d length / d theta of span i: half of the segment before it, half of its own
    for (const std::size_t j : {i, i + 1}) {
      if (j == 0 || j > lumps_) continue;
      const std::size_t segment = first_ + j - 1;
      row[2 * segment] = 0.5 * paths.path(cable_, segment).d_pitch_m;
      row[2 * segment + 1] = 0.5 * paths.path(cable_, segment).d_yaw_m;
    }
    for (std::size_t a = 0; a < row.size(); ++a)
      for (std::size_t b = 0; b < row.size(); ++b) stiffness[a][b] += EA_N_ / material_m_[i] * row[a] * row[b];
  }
}

double CableLine::energy_J() const {
  double energy = 0.0;
  for (std::size_t i = 0; i <= lumps_; ++i) energy += 0.5 * tension_N_[i] * tension_N_[i] * material_m_[i] / EA_N_;
  return energy;
}

}  // namespace liana::bench
