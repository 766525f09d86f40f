#include "coupler/energy_audit.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "common/error.h"

namespace crosswalk::coupling {

void EnergyAudit::book(const WindowResult& result, const CouplingState& after) {
  exchanged_ += std::abs(result.fe.interface_work - work_fe_);
  work_mb_ = result.mb.interface_work;
  work_fe_ = result.fe.interface_work;
  const MbReply& mb = result.mb;
  const FeReply& fe = result.fe;
  // Held and lost on both sides; the interface works cancel but for the drift.
  total_ = mb.kinetic + mb.gravity + mb.joint_elastic + mb.joint_dissipated + mb.contact_absorbed +
           fe.kinetic + fe.internal + fe.hourglass + fe.contact + fe.damping;
  external_ = mb.car_work + fe.external_work;
  if (!has_start_) start_ = total_ - external_;
  has_start_ = true;
  peak_ = std::max(peak_, std::abs(total_));
  book_interface(result, after);
  last_ = result;
  if (std::abs(drift()) > limits_.drift_stop * std::max(peak_, 1.0)) {
    throw NumericalError(
        result.id.begin_s() + result.id.length_s(),
        fmt::format(
            "the interface has gained or lost {:.3g} J, more than {:.1f} % of the peak energy "
            "{:.4g} J: the coupling is unstable; use scheme = \"mic\" or a shorter window_us",
            drift(), 100 * limits_.drift_stop, peak_));
  }
}

void EnergyAudit::book_interface(const WindowResult& result, const CouplingState& after) {
  for (std::size_t k = 0; k < result.fe.loads.size() && k < std::size(gap_position_); ++k) {
    const BodyLoad& load = result.fe.loads[k];
    gap_position_[k] = static_cast<float>(load.gap_position.norm());
    gap_rotation_[k] = static_cast<float>(load.gap_rotation.norm());
    velocity_mismatch_[k] = static_cast<float>((after.motion[k].V_WB.v - load.twist_end.v).norm());
    gap_m_ = std::max(gap_m_, load.gap_position.norm());
    gap_rad_ = std::max(gap_rad_, load.gap_rotation.norm());
  }
}

std::optional<std::string> EnergyAudit::new_warning() {
  if (!warned_drift_ && std::abs(drift()) > limits_.drift_warn * std::max(peak_, 1.0)) {
    warned_drift_ = true;
    return fmt::format(
        "interface energy error {:.3g} J exceeds {:.1f} % of the peak energy {:.4g} J", drift(),
        100 * limits_.drift_warn, peak_);
  }
  if (!warned_gap_ && (gap_m_ > limits_.gap_warn_m || gap_rad_ > limits_.gap_warn_rad)) {
    warned_gap_ = true;
    return fmt::format("a finite-element block is {:.3f} mm and {:.3f} degree away from its body",
                       1e3 * gap_m_, gap_rad_ * 180 / EIGEN_PI);
  }
  return std::nullopt;
}

double EnergyAudit::balance_percent() const {
  return peak_ > 0 ? 100 * (total_ - external_ - start_) / peak_ : 0;
}

msg::coupling_audit EnergyAudit::message() const {
  msg::coupling_audit m{};
  m.window = last_.id.window;
  m.t_ns = (last_.id.window + 1) * last_.id.window_ns;
  m.iterations = last_.iterations;
  m.residual = last_.residual;
  m.work_mb = work_mb_;
  m.work_fe = work_fe_;
  m.exchanged = exchanged_;
  m.drift = drift();
  m.total_energy = total_;
  m.external_work = external_;
  m.balance_error = total_ - external_ - start_;
  std::memcpy(m.gap_position, gap_position_, sizeof gap_position_);
  std::memcpy(m.gap_rotation, gap_rotation_, sizeof gap_rotation_);
  std::memcpy(m.velocity_mismatch, velocity_mismatch_, sizeof velocity_mismatch_);
  return m;
}

}  // namespace crosswalk::coupling
