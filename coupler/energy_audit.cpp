#include "coupler/energy_audit.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "common/error.h"

namespace crosswalk::coupling {

void EnergyAudit::book(const WindowResult& result, const CouplingState& after) {
  books_.exchanged += std::abs(result.fe.interface_work - books_.work_fe);
  books_.work_mb = result.mb.energy.interface_work;
  books_.work_fe = result.fe.interface_work;
  const MbEnergies& mb = result.mb.energy;
  const FeReply& fe = result.fe;
  // Held and lost on both sides; the interface works cancel but for the drift.
  books_.total = mb.held() + fe.kinetic + fe.internal + fe.hourglass + fe.contact + fe.damping;
  books_.external = mb.car_work + fe.external_work;
  if (!books_.has_start) books_.start = books_.total - books_.external;
  books_.has_start = true;
  books_.peak = std::max(books_.peak, std::abs(books_.total));
  books_.window = result.id.window;
  books_.t_ns = (result.id.window + 1) * result.id.window_ns;
  books_.iterations = result.iterations;
  books_.residual = result.residual;
  book_interface(result, after);
  if (std::abs(drift()) > limits_.drift_stop * std::max(books_.peak, 1.0)) {
    throw NumericalError(
        result.id.begin_s() + result.id.length_s(),
        fmt::format(
            "the interface has gained or lost {:.3g} J, more than {:.1f} % of the peak energy "
            "{:.4g} J: the coupling is unstable; use scheme = \"mic\" or a shorter window_us",
            drift(), 100 * limits_.drift_stop, books_.peak));
  }
}

void EnergyAudit::book_interface(const WindowResult& result, const CouplingState& after) {
  for (std::size_t k = 0; k < result.fe.loads.size() && k < std::size(books_.gap_position); ++k) {
    const BodyLoad& load = result.fe.loads[k];
    books_.gap_position[k] = static_cast<float>(load.gap_position.norm());
    books_.gap_rotation[k] = static_cast<float>(load.gap_rotation.norm());
    books_.velocity_mismatch[k] =
        static_cast<float>((after.motion[k].V_WB.v - load.twist_end.v).norm());
    const Vec6 owed = after.carry[k] / result.id.length_s();
    books_.owed_force[k] = static_cast<float>(owed.head<3>().norm());
    books_.owed_moment[k] = static_cast<float>(owed.tail<3>().norm());
    books_.largest_gap_m = std::max(books_.largest_gap_m, load.gap_position.norm());
    books_.largest_gap_rad = std::max(books_.largest_gap_rad, load.gap_rotation.norm());
  }
}

std::optional<std::string> EnergyAudit::new_warning() {
  if (!books_.warned_drift && std::abs(drift()) > limits_.drift_warn * std::max(books_.peak, 1.0)) {
    books_.warned_drift = true;
    return fmt::format(
        "interface energy error {:.3g} J exceeds {:.1f} % of the peak energy {:.4g} J", drift(),
        100 * limits_.drift_warn, books_.peak);
  }
  if (!books_.warned_gap && (books_.largest_gap_m > limits_.gap_warn_m ||
                             books_.largest_gap_rad > limits_.gap_warn_rad)) {
    books_.warned_gap = true;
    return fmt::format("a finite-element block is {:.3f} mm and {:.3f} degree away from its body",
                       1e3 * books_.largest_gap_m, books_.largest_gap_rad * 180 / EIGEN_PI);
  }
  return std::nullopt;
}

double EnergyAudit::balance_percent() const {
  return books_.peak > 0 ? 100 * (books_.total - books_.external - books_.start) / books_.peak : 0;
}

msg::coupling_audit EnergyAudit::message() const {
  msg::coupling_audit m{};
  m.window = books_.window;
  m.t_ns = books_.t_ns;
  m.iterations = books_.iterations;
  m.residual = books_.residual;
  m.work_mb = books_.work_mb;
  m.work_fe = books_.work_fe;
  m.exchanged = books_.exchanged;
  m.drift = drift();
  m.total_energy = books_.total;
  m.external_work = books_.external;
  m.balance_error = books_.total - books_.external - books_.start;
  std::memcpy(m.gap_position, books_.gap_position, sizeof books_.gap_position);
  std::memcpy(m.gap_rotation, books_.gap_rotation, sizeof books_.gap_rotation);
  std::memcpy(m.owed_force, books_.owed_force, sizeof books_.owed_force);
  std::memcpy(m.owed_moment, books_.owed_moment, sizeof books_.owed_moment);
  std::memcpy(m.velocity_mismatch, books_.velocity_mismatch, sizeof books_.velocity_mismatch);
  return m;
}

}  // namespace crosswalk::coupling
