#include "recorder/scoring/neck_injury.h"

#include <algorithm>
#include <cmath>

#include "recorder/channel.h"

namespace crosswalk::recording {

NeckResult neck_injury(const NeckLoads& loads, const NeckParameters& p) {
  require_valid(loads.t, loads.fx, "neck force x");
  require_valid(loads.t, loads.fz, "neck force z");
  require_valid(loads.t, loads.my, "neck moment y");
  for (const double value : {p.Fzt, p.Fzc, p.Mf, p.Me, p.nkm_F, p.nkm_Mf, p.nkm_Me}) {
    if (!(value > 0)) {
      throw SignalError(SignalFault::BadParameter, "neck: a critical value is not positive");
    }
  }
  NeckResult r;
  for (std::size_t i = 0; i < loads.t.size(); ++i) {
    const double moment = loads.my[i] - p.e_m * loads.fx[i];
    const bool is_flexion = moment >= 0;
    const double axial = std::abs(loads.fz[i]) / (loads.fz[i] >= 0 ? p.Fzt : p.Fzc);
    const double nij = axial + std::abs(moment) / (is_flexion ? p.Mf : p.Me);
    double& nij_mode =
        loads.fz[i] >= 0 ? (is_flexion ? r.NTF : r.NTE) : (is_flexion ? r.NCF : r.NCE);
    nij_mode = std::max(nij_mode, nij);
    const double nkm =
        std::abs(loads.fx[i]) / p.nkm_F + std::abs(moment) / (is_flexion ? p.nkm_Mf : p.nkm_Me);
    double& nkm_mode =
        loads.fx[i] >= 0 ? (is_flexion ? r.NFA : r.NEA) : (is_flexion ? r.NFP : r.NEP);
    nkm_mode = std::max(nkm_mode, nkm);
  }
  r.Nij = std::max({r.NTF, r.NTE, r.NCF, r.NCE});
  r.Nkm = std::max({r.NFA, r.NEA, r.NFP, r.NEP});
  return r;
}

}  // namespace crosswalk::recording
